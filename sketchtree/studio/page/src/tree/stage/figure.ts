// How tall is it? A person of 1.8 m stands beside the tree: a flat shape that turns to whoever looks.

import { DoubleSide, Group, Mesh, MeshBasicMaterial, Shape, ShapeGeometry, type Box3, type Camera, type Scene } from "three";

export const TALL = 1.8; // metres
const HALF = 0.45; // metres: half the width that a person needs
const ROOM = 1.2; // metres behind
const STEP = 0.2; // metres
const SIDES = [0, 24].map((degrees) => [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)] as const);

export class Figure {
  readonly group = new Group();
  private asked = true;
  private isBeside = false;
  private readonly material = new MeshBasicMaterial({ side: DoubleSide, toneMapped: false });

  constructor(scene: Scene) {
    const body = new Mesh(new ShapeGeometry([head(), ...clothed()], 24), this.material);
    body.castShadow = false;
    this.group.add(body);
    scene.add(this.group);
    this.stands = false;
    this.wear("light");
  }

  wear(theme: "light" | "dark"): void {
    this.material.color.set(theme === "light" ? "#5c6663" : "#aab4b2");
  }

  /** Somebody wants to see it. */
  set wanted(is: boolean) {
    this.asked = is;
    this.group.visible = this.asked && this.isBeside;
  }

  /** There is a tree to stand beside: alone it would say nothing, and of the wrong size. */
  set stands(is: boolean) {
    this.isBeside = is;
    this.wanted = this.asked;
  }

  /** Beside this tree, to its left and a little in front: under its crown where there is room to stand, else clear of what hangs down. */
  beside(box: Box3, spots: ArrayLike<number>): void {
    const z = Math.min(0.35 * box.max.z, 2);
    this.group.position.set(clear(spots, Math.max(box.min.x * 0.62, box.min.x + 0.3) - 0.4, z), 0, z);
  }

  /** Head and feet, so that who frames the tree frames the person too. */
  get ends(): number[] {
    const { x, z } = this.group.position;
    return this.group.visible ? [x - HALF, TALL, z, x - HALF, 0, z] : [];
  }

  face(camera: Camera): void {
    this.group.rotation.y = Math.atan2(camera.matrixWorld.elements[8]!, camera.matrixWorld.elements[10]!);
    this.group.updateMatrixWorld();
  }
}

/** The place nearest to `x`, to its left, around and before which nothing of the tree hangs low: seen from the front, and from where one looks at first. */
export function clear(spots: ArrayLike<number>, x: number, z: number): number {
  const low: [number, number][] = [];
  let least = x;
  for (let k = 0; k + 2 < spots.length; k += 3) {
    if (spots[k + 1]! > TALL + HALF) continue;
    low.push([spots[k]!, spots[k + 2]!]);
    least = Math.min(least, spots[k]!);
  }
  const hides = (at: number, [sx, sz]: readonly [number, number]): boolean => SIDES.some(([cos, sin]) =>
    Math.abs((sx - at) * cos - (sz - z) * sin) < HALF && (sx - at) * sin + (sz - z) * cos > -ROOM);
  let at = x;
  for (const end = least - HALF; at > end && low.some((spot) => hides(at, spot)); ) at = Math.max(end, at - STEP);
  return at;
}

function head(): Shape {
  const shape = new Shape();
  shape.absellipse(0, 1.675, 0.092, 0.125, 0, 2 * Math.PI, false, 0);
  return shape;
}

/** Someone at ease, in a coat: torso with arms, two legs. */
function clothed(): Shape[] {
  const torso = new Shape();
  torso.moveTo(-0.045, 1.56);
  torso.bezierCurveTo(-0.06, 1.5, -0.19, 1.5, -0.215, 1.42);
  torso.bezierCurveTo(-0.255, 1.28, -0.275, 1.05, -0.262, 0.84);
  torso.bezierCurveTo(-0.258, 0.79, -0.205, 0.79, -0.2, 0.84);
  torso.bezierCurveTo(-0.195, 1.0, -0.18, 1.12, -0.165, 1.2);
  torso.bezierCurveTo(-0.165, 1.05, -0.195, 0.92, -0.19, 0.74);
  torso.lineTo(0.19, 0.74);
  torso.bezierCurveTo(0.195, 0.92, 0.165, 1.05, 0.165, 1.2);
  torso.bezierCurveTo(0.18, 1.12, 0.195, 1.0, 0.2, 0.84);
  torso.bezierCurveTo(0.205, 0.79, 0.258, 0.79, 0.262, 0.84);
  torso.bezierCurveTo(0.275, 1.05, 0.255, 1.28, 0.215, 1.42);
  torso.bezierCurveTo(0.19, 1.5, 0.06, 1.5, 0.045, 1.56);
  torso.closePath();
  return [torso, leg(-1), leg(1)];
}

function leg(side: number): Shape {
  const shape = new Shape();
  shape.moveTo(side * 0.188, 0.76);
  shape.bezierCurveTo(side * 0.19, 0.5, side * 0.165, 0.25, side * 0.15, 0.06);
  shape.bezierCurveTo(side * 0.2, 0.04, side * 0.215, 0.0, side * 0.21, 0.0);
  shape.lineTo(side * 0.07, 0.0);
  shape.bezierCurveTo(side * 0.075, 0.2, side * 0.05, 0.5, side * 0.008, 0.76);
  shape.closePath();
  return shape;
}
