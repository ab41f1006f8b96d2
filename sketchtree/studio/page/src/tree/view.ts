// What ties the tree's view together? One stage, one eye, and the two ways between pixels and places; all else in this folder stands on it.

import { Vector3, type Box3, type Camera } from "three";
import { Cameras, type PageOnScreen } from "./eye/camera";
import { axes, framed, metres, type Eye, type Point } from "./eye/eye";
import { Flight } from "./eye/flight";
import type { Ray } from "./hand/pick";
import type { PagePlane } from "./page/plane";
import { Stage } from "./stage/stage";

const SLACK = 0.03; // of the distance, before the eye follows a tree that grows
const NEAR_ENOUGH = 7; // pixels from a limb that still hit it

export class View {
  readonly stage: Stage;
  readonly flight = new Flight();
  eye: Eye = { azimuth: 24, elevation: 6, distance: 20, target: [0, 4, 0] };
  box: Box3 | null = null; // of what there is to see
  spots: () => ArrayLike<number> = () => []; // x, y, z of places that are to be seen when all is
  overPage: (() => { page: PageOnScreen; plane: PagePlane; azimuth: number } | null) = () => null; // while the page lies over the tree
  top: () => Point = () => [0, 0, 0]; // of the tree
  foot = 0; // pixels at the lower end over which buttons stand
  grows = false; // what is seen is the tree while it grows: there are no limbs to take
  private seesAll = true;
  private readonly cameras = new Cameras();
  private camera: Camera | null = null;
  private readonly spot = new Vector3();

  constructor(readonly root: HTMLElement) {
    this.stage = new Stage(root);
    this.stage.camera = (wide, high) => (this.camera = this.cameraFor(wide, high));
    this.stage.beforeDraw.push((now) => {
      const eye = this.flight.tick(now);
      if (eye) this.eye = eye;
      return this.flight.moving;
    });
  }

  get reach(): number {
    return this.box && !this.box.isEmpty() ? Math.max(this.box.max.y, this.box.max.x - this.box.min.x, 1) : 10;
  }

  look(eye: Eye, seesAll = false): void {
    this.flight.stop();
    this.seesAll &&= seesAll;
    this.eye = eye;
    this.stage.draw(true);
  }

  /** The same drawing is a tree of other metres now: it looks as large as before. */
  rescale(by: number): void {
    const { target } = this.eye;
    this.flight.stop();
    this.eye = { ...this.eye, distance: this.eye.distance * by, target: [target[0] * by, target[1] * by, target[2] * by] };
  }

  fly(to: Eye): void {
    this.flight.to(this.eye, to, performance.now());
    this.stage.draw(true);
  }

  /** See the whole tree, from here or from another side; and go on seeing it as it grows, until a hand moves the eye. */
  showAll(azimuth = this.eye.azimuth, elevation = this.eye.elevation, atOnce = false): void {
    const eye = this.whole(azimuth, elevation);
    if (atOnce) this.look(eye);
    else this.fly(eye);
    this.seesAll = true;
  }

  /** Look from there; where the whole tree was seen, it still is: from another side it may be wider. */
  turnTo(azimuth: number, elevation: number): void {
    if (this.seesAll) this.showAll(azimuth, elevation);
    else this.fly({ ...this.eye, azimuth, elevation });
  }

  /** The tree is another: where the whole of it was seen, it still is. */
  follow(atOnce: boolean): void {
    if (!this.seesAll) return;
    const { distance, target } = this.whole();
    const nearer = distance / this.eye.distance;
    const aside = Math.hypot(...target.map((at, k) => at - this.eye.target[k]!)) / this.eye.distance;
    if (atOnce || (!this.flight.moving && (nearer > 1 + SLACK || nearer < 1 - 3 * SLACK || aside > SLACK))) this.showAll(undefined, undefined, atOnce);
  }

  /** The eye in its direction, or another, that sees the whole tree. */
  whole(azimuth = this.eye.azimuth, elevation = this.eye.elevation): Eye {
    const eye = { ...this.eye, azimuth, elevation };
    if (!this.box || this.box.isEmpty()) return eye;
    return framed(eye, this.spots(), this.stage.wide / this.stage.high, Math.min(0.3, this.foot / this.stage.high));
  }

  /** CSS pixels from the view's top left corner. */
  readonly project = (at: Point): readonly [number, number] => {
    this.spot.set(...at).project(this.camera ?? this.cameraFor(this.stage.wide, this.stage.high));
    return [((this.spot.x + 1) / 2) * this.stage.wide, ((1 - this.spot.y) / 2) * this.stage.high];
  };

  /** Pixels of a metre at this place, seen from its side. */
  metre(at: Point): number {
    const over = this.overPage();
    if (over) return over.page.scale / over.plane.scale;
    const { back } = axes(this.eye);
    const away = this.eye.distance - (at[0] - this.eye.target[0]) * back[0] - (at[1] - this.eye.target[1]) * back[1] - (at[2] - this.eye.target[2]) * back[2];
    return 1 / metres({ ...this.eye, distance: Math.max(away, 0.05) }, this.stage.high);
  }

  /** From the eye through a pixel of the view. */
  ray(x: number, y: number): Ray {
    const camera = this.camera ?? this.cameraFor(this.stage.wide, this.stage.high);
    const [right, up] = [(2 * x) / this.stage.wide - 1, 1 - (2 * y) / this.stage.high];
    const from = new Vector3(right, up, -1).unproject(camera);
    const way = new Vector3(right, up, 1).unproject(camera).sub(from).normalize();
    const over = this.overPage();
    const start = NEAR_ENOUGH / this.metre(from.toArray());
    return { from: from.toArray(), way: way.toArray(), start, spread: over ? 0 : (NEAR_ENOUGH * metres(this.eye, this.stage.high)) / this.eye.distance };
  }

  private cameraFor(wide: number, high: number): Camera {
    const over = this.overPage();
    if (over) return this.cameras.overPage(over.azimuth, over.page, over.plane.root, over.plane.scale, wide, high, this.reach);
    return this.cameras.perspective(this.eye, wide, high, this.reach);
  }
}
