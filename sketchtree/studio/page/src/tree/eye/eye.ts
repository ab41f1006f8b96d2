// From where is the tree seen? An eye on a ball around a target: azimuth 0 looks from the front (+z), 90 from the tree's right (+x). Numbers only.

export type Point = readonly [x: number, y: number, z: number];

export interface Eye {
  azimuth: number; // degrees
  elevation: number; // degrees, 0 level, 90 from above
  distance: number; // metres
  target: Point; // metres
}

export const FIELD = 28; // degrees, vertical
const LOWEST = -20; // degrees: from below the ground one sees little
const HIGHEST = 89.5;
const MARGIN = 1.14; // room for the height's label

const radians = (degrees: number): number => (degrees * Math.PI) / 180;

/** Unit vectors to the right, up and back to the eye. */
export function axes({ azimuth, elevation }: Eye): { right: Point; up: Point; back: Point } {
  const [sa, ca, se, ce] = [Math.sin(radians(azimuth)), Math.cos(radians(azimuth)), Math.sin(radians(elevation)), Math.cos(radians(elevation))];
  return { right: [ca, 0, -sa], up: [-sa * se, ce, -ca * se], back: [sa * ce, se, ca * ce] };
}

export function place(eye: Eye): Point {
  return along(eye.target, axes(eye).back, eye.distance);
}

/** Metres a CSS pixel at the target, in a view so many pixels high. */
export function metres(eye: Eye, high: number): number {
  return (2 * eye.distance * Math.tan(radians(FIELD / 2))) / Math.max(high, 1);
}

export function turned(eye: Eye, azimuth: number, elevation: number): Eye {
  return { ...eye, azimuth: eye.azimuth + azimuth, elevation: Math.min(HIGHEST, Math.max(LOWEST, eye.elevation + elevation)) };
}

/** The scene follows a hand that moves so many pixels. */
export function panned(eye: Eye, right: number, down: number, high: number): Eye {
  const at = axes(eye);
  const step = metres(eye, high);
  return { ...eye, target: along(along(eye.target, at.right, -right * step), at.up, down * step) };
}

/** Nearer by a factor, while what is under the pointer stays there: `x`, `y` in pixels from the middle, y down. */
export function zoomed(eye: Eye, factor: number, x: number, y: number, high: number): Eye {
  const distance = Math.min(5000, Math.max(0.05, eye.distance / factor));
  const moved = 1 - distance / eye.distance;
  return { ...panned(eye, -x * moved, -y * moved, high), distance };
}

/** The nearest eye in the same direction that sees all of a tree in this box, with a margin: crowns are round, so their box's corners are empty. `foot`: the share
 *  of the view's height over whose lower end buttons stand. */
export function framed(eye: Eye, low: Point, high: Point, aspect: number, foot = 0): Eye {
  const { right, up, back } = axes(eye);
  const middle: Point = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
  const half = Math.tan(radians(FIELD / 2));
  const [tall, broad] = [(half * (1 - foot)) / MARGIN, (half * aspect) / MARGIN];
  let distance = 0.1;
  for (const [level, wide] of [[-1, 0.5], [0, 1], [1, 0.5]] as const)
    for (let side = 0; side < 8; side++) {
      const turn = (side * Math.PI) / 4;
      const at: Point = [((high[0] - low[0]) / 2) * wide * Math.cos(turn), ((high[1] - low[1]) / 2) * level, ((high[2] - low[2]) / 2) * wide * Math.sin(turn)];
      distance = Math.max(distance, dot(at, back) + Math.max(Math.abs(dot(at, up)) / tall, Math.abs(dot(at, right)) / broad));
    }
  return { ...eye, target: along(middle, up, -foot * half * distance), distance };
}

/** On the way from one to another; azimuths go the short way round, distances by their ratio. */
export function between(from: Eye, to: Eye, share: number): Eye {
  const mix = (a: number, b: number): number => a + (b - a) * share;
  return {
    azimuth: from.azimuth + shortest(to.azimuth - from.azimuth) * share,
    elevation: mix(from.elevation, to.elevation),
    distance: from.distance * (to.distance / from.distance) ** share,
    target: [mix(from.target[0], to.target[0]), mix(from.target[1], to.target[1]), mix(from.target[2], to.target[2])],
  };
}

/** The same turn, -180 to 180. */
export function shortest(degrees: number): number {
  return degrees - 360 * Math.round(degrees / 360);
}

/** The nearest multiple of `step`. */
export function snapped(degrees: number, step: number): number {
  return Math.round(degrees / step) * step;
}

export function dot(a: Point, b: Point): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function along(from: Point, way: Point, far: number): Point {
  return [from[0] + way[0] * far, from[1] + way[1] * far, from[2] + way[2] * far];
}
