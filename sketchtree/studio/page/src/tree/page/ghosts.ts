// What will the stroke in hand become? The paths that the program sends while it is drawn or dragged, as thin glowing tubes over everything.

import { AdditiveBlending, BufferAttribute, BufferGeometry, Group, Mesh, MeshBasicMaterial, NormalBlending, Vector3, type Scene } from "three";

const SIDES = 6;

export interface GhostPath {
  points: Float32Array; // 3 a point, metres
  radius: number; // at the foot, metres
}

export type GhostColours = Record<"light" | "dark", readonly [body: string, glow: string]>;

const COMING: GhostColours = { light: ["#1f8a5b", "#49c98d"], dark: ["#9be7bd", "#7fe0ae"] };

export class Ghosts {
  private readonly group = new Group();
  private readonly body = new MeshBasicMaterial({ transparent: true, opacity: 0.85, depthTest: false, depthWrite: false, toneMapped: false });
  private readonly glow = new MeshBasicMaterial({ transparent: true, opacity: 0.28, depthTest: false, depthWrite: false, toneMapped: false });

  constructor(scene: Scene, private readonly colours: GhostColours = COMING) {
    scene.add(this.group);
    this.wear("light");
  }

  wear(theme: "light" | "dark"): void {
    this.body.color.set(this.colours[theme][0]);
    this.glow.color.set(this.colours[theme][1]);
    this.glow.blending = theme === "light" ? NormalBlending : AdditiveBlending;
  }

  /** `least`: metres that a line must be thick to be seen. None: away with them. */
  show(paths: readonly GhostPath[], least: number): void {
    this.group.children.forEach((mesh) => (mesh as Mesh).geometry.dispose());
    this.group.clear();
    for (const { points, radius } of paths) {
      if (points.length < 6) continue;
      const foot = Math.max(radius, least);
      for (const [wider, material, order] of [[2.6, this.glow, 6], [1, this.body, 7]] as const) {
        const mesh = new Mesh(tube(points, foot * wider, Math.max(0.35 * foot, 0.6 * least) * wider), material);
        mesh.renderOrder = order;
        this.group.add(mesh);
      }
    }
  }

  get any(): boolean {
    return this.group.children.length > 0;
  }
}

/** A tube along a path, thinner towards its tip. */
export function tube(points: Float32Array, foot: number, tip: number): BufferGeometry {
  const count = points.length / 3;
  const position = new Float32Array(3 * count * SIDES);
  const index: number[] = [];
  const [here, way, side, other] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
  for (let k = 0; k < count; k++) {
    const [before, after] = [3 * Math.max(0, k - 1), 3 * Math.min(count - 1, k + 1)];
    here.fromArray(points, 3 * k);
    way.fromArray(points, after).sub(other.fromArray(points, before)).normalize();
    if (k === 0) side.set(Math.abs(way.x) < 0.9 ? 1 : 0, 0, Math.abs(way.x) < 0.9 ? 0 : 1);
    side.addScaledVector(way, -side.dot(way)).normalize(); // carried along, so that the tube does not twist
    other.crossVectors(way, side);
    const radius = foot + ((tip - foot) * k) / Math.max(1, count - 1);
    for (let s = 0; s < SIDES; s++) {
      const angle = (2 * Math.PI * s) / SIDES;
      new Vector3().copy(here).addScaledVector(side, radius * Math.cos(angle)).addScaledVector(other, radius * Math.sin(angle)).toArray(position, 3 * (k * SIDES + s));
      if (k + 1 < count) {
        const [a, b] = [k * SIDES + s, k * SIDES + ((s + 1) % SIDES)];
        index.push(a, b, a + SIDES, b, b + SIDES, a + SIDES);
      }
    }
  }
  const made = new BufferGeometry();
  made.setAttribute("position", new BufferAttribute(position, 3));
  made.setIndex(index);
  return made;
}
