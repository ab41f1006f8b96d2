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
const ASIDE = 1.1; // room at both sides
const ABOVE = 1.18; // and above and below: for the height's label, and a little sky

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

/** The nearest eye in the same direction that sees all of these places (x, y, z …), with a margin. `foot`: the share of the view's height over whose lower end
 *  buttons stand.
 *
 *      |r − c| ≤ B (d − b)   for each place       r, b   its way to the right and back, from the middle       B   half the view's width at distance 1
 *      B d = (max(r + B b) − min(r − B b)) / 2,   c = (max(r + B b) + min(r − B b)) / 2;   the same upwards; the larger d holds
 */
export function framed(eye: Eye, spots: ArrayLike<number>, aspect: number, foot = 0): Eye {
  if (spots.length < 3) return eye;
  const { right, up, back } = axes(eye);
  const half = Math.tan(radians(FIELD / 2));
  const [broad, tall] = [(half * aspect) / ASIDE, (half * (1 - foot)) / ABOVE];
  const middle = middleOf(spots);
  const [r, u] = [{ most: -Infinity, least: Infinity }, { most: -Infinity, least: Infinity }];
  for (let k = 0; k + 2 < spots.length; k += 3) {
    const at: Point = [spots[k]! - middle[0], spots[k + 1]! - middle[1], spots[k + 2]! - middle[2]];
    const near = dot(at, back);
    const [x, y] = [dot(at, right), dot(at, up)];
    r.most = Math.max(r.most, x + broad * near);
    r.least = Math.min(r.least, x - broad * near);
    u.most = Math.max(u.most, y + tall * near);
    u.least = Math.min(u.least, y - tall * near);
  }
  const distance = Math.max(0.1, (r.most - r.least) / (2 * broad), (u.most - u.least) / (2 * tall));
  const target = along(along(middle, right, (r.most + r.least) / 2), up, (u.most + u.least) / 2 - foot * half * distance);
  return { ...eye, target, distance };
}

function middleOf(spots: ArrayLike<number>): Point {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let k = 0; k < spots.length; k++) {
    low[k % 3] = Math.min(low[k % 3]!, spots[k]!);
    high[k % 3] = Math.max(high[k % 3]!, spots[k]!);
  }
  return [0, 1, 2].map((k) => (low[k]! + high[k]!) / 2) as unknown as Point;
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
