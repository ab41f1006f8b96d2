// Which camera draws the eye's view? In perspective beside the page; without it, and pixel for pixel on the drawing, while the page lies over the tree.

import { OrthographicCamera, PerspectiveCamera } from "three";
import { axes, FIELD, place, type Eye, type Point } from "./eye";

/** Where the page is on the screen: pixel = page unit × scale + shift, from the view's top left corner. */
export interface PageOnScreen {
  scale: number;
  x: number;
  y: number;
}

export class Cameras {
  private readonly deep = new PerspectiveCamera(FIELD);
  private readonly flat = new OrthographicCamera();

  /** The camera of this eye for a view of this size. */
  perspective(eye: Eye, wide: number, high: number, reach: number): PerspectiveCamera {
    this.deep.aspect = wide / high;
    this.deep.near = Math.max(0.01, 0.02 * eye.distance);
    this.deep.far = eye.distance + 60 * reach;
    aim(this.deep, eye);
    this.deep.updateProjectionMatrix();
    return this.deep;
  }

  /** The camera under which the world lies on the page. `root`: the world's origin on the page; `unit`: metres a page unit. */
  overPage(azimuth: number, page: PageOnScreen, root: readonly number[], unit: number, wide: number, high: number, reach: number): OrthographicCamera {
    const metre = page.scale / unit; // pixels
    const [left, up] = [root[0]! * page.scale + page.x, root[1]! * page.scale + page.y]; // pixel of the origin
    this.flat.left = -left / metre;
    this.flat.right = (wide - left) / metre;
    this.flat.top = up / metre;
    this.flat.bottom = (up - high) / metre;
    this.flat.near = 0.01;
    this.flat.far = 40 * reach;
    aim(this.flat, { azimuth, elevation: 0, distance: 20 * reach, target: [0, 0, 0] });
    this.flat.updateProjectionMatrix();
    return this.flat;
  }
}

function aim(camera: PerspectiveCamera | OrthographicCamera, eye: Eye): void {
  const at: Point = place(eye);
  camera.up.set(...axes(eye).up);
  camera.position.set(...at);
  camera.lookAt(...eye.target);
  camera.updateMatrixWorld();
}
