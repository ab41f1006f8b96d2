// Along which line does a handle slide? A thin line through it, out of the page that the limb was drawn on.

import { BufferGeometry, Line, LineDashedMaterial, Vector3, type Scene } from "three";
import { along, type Point } from "../eye/eye";
import type { View } from "../view";

export class Guide {
  private readonly line: Line<BufferGeometry, LineDashedMaterial>;

  constructor(private readonly view: View, scene: Scene) {
    this.line = new Line(new BufferGeometry(), new LineDashedMaterial({ color: "#e07b00", dashSize: 0.1, gapSize: 0.07, depthTest: false, transparent: true, toneMapped: false }));
    this.line.visible = false;
    this.line.renderOrder = 8;
    this.line.frustumCulled = false;
    scene.add(this.line);
  }

  /** From as far away as the place at `at` may go to as near. */
  show(at: Point, out: Point, [farther, nearer]: readonly [number, number]): void {
    const reach = this.view.reach;
    this.line.geometry.setFromPoints([new Vector3(...along(at, out, farther)), new Vector3(...along(at, out, nearer))]);
    this.line.computeLineDistances();
    this.line.material.dashSize = 0.012 * reach;
    this.line.material.gapSize = 0.0085 * reach;
    this.line.visible = true;
    this.view.stage.draw();
  }

  hide(): void {
    this.line.visible = false;
    this.view.stage.draw();
  }
}
