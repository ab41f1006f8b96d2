// How do the points of a scan stand beside the tree? Where they lie on the page, as small squares of so many pixels.

import { Box3, BufferAttribute, BufferGeometry, Points, PointsMaterial, Vector3, type Scene } from "three";
import type { Stand } from "../../draw/cloud/seen";
import type { Scan } from "../../draw/cloud/scan";
import type { Cloud } from "../../messages";

const SPOTS = 240; // points by which all of them are kept in sight

export class ScanPoints {
  private readonly material = new PointsMaterial({ sizeAttenuation: false, toneMapped: false });
  private readonly points = new Points(new BufferGeometry(), this.material);
  private digest = "";
  private theme: "light" | "dark" = "light";

  constructor(scene: Scene) {
    this.points.visible = false;
    this.points.castShadow = this.points.receiveShadow = false;
    scene.add(this.points);
  }

  /** These, or none. */
  show(scan: Scan | null, cloud: Cloud | null, at: Stand, shown: boolean, size: number): void {
    this.points.visible = scan !== null && cloud !== null && shown;
    if (!scan || !cloud) return;
    if (scan.digest !== this.digest) this.make(scan);
    this.digest = scan.digest;
    this.points.position.set((cloud.x - (at.root[0] ?? 0)) * at.scale, ((at.root[1] ?? 0) - cloud.y) * at.scale, 0);
    this.points.scale.setScalar(cloud.unit * at.scale);
    this.points.updateMatrixWorld();
    this.material.size = size;
  }

  wear(theme: "light" | "dark"): void {
    this.theme = theme;
    this.material.color.set(this.material.vertexColors ? "#ffffff" : theme === "light" ? "#746c60" : "#a9a49a");
  }

  get visible(): boolean {
    return this.points.visible;
  }

  /** Of all of them, in the world; null: there are none to see. */
  get box(): Box3 | null {
    if (!this.points.visible) return null;
    this.points.geometry.boundingBox ?? this.points.geometry.computeBoundingBox();
    return this.points.geometry.boundingBox!.clone().applyMatrix4(this.points.matrixWorld);
  }

  /** x, y, z of some of them, in the world. */
  get spots(): number[] {
    if (!this.points.visible) return [];
    const places = this.points.geometry.getAttribute("position");
    const step = Math.max(1, Math.floor(places.count / SPOTS));
    const [found, one] = [[] as number[], new Vector3()];
    for (let k = 0; k < places.count; k += step) found.push(...one.fromBufferAttribute(places, k).applyMatrix4(this.points.matrixWorld).toArray());
    return found;
  }

  private make({ xyz, rgb }: Scan): void {
    this.points.geometry.dispose();
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(xyz, 3));
    if (rgb) geometry.setAttribute("color", new BufferAttribute(linear(rgb), 3, true));
    this.points.geometry = geometry;
    this.material.vertexColors = rgb !== null;
    this.material.needsUpdate = true;
    this.wear(this.theme);
  }
}

/** Colours as a file has them, in the light's own measure. */
function linear(rgb: Uint8Array): Uint8Array {
  const table = Uint8Array.from({ length: 256 }, (_, value) => {
    const part = value / 255;
    return Math.round(255 * (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
  });
  return rgb.map((value) => table[value]!);
}
