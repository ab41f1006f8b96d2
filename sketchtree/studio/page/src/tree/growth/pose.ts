// Where are all joints at a moment? The matrix of each that takes its vertices from rest to there, in the order and form that the shader reads: 16 numbers, columns first.

import { sample, type Tracks } from "./tracks";

export interface Joints {
  parent: Int32Array; // of each joint; parents come first; -1: none
  translation: Float32Array; // at rest, to the parent
  rotation: Float32Array;
  scale: Float32Array;
  inverse: Float32Array; // 16 a joint: from the tree at rest into the joint's frame
}

export interface Moves {
  translation: Tracks;
  rotation: Tracks;
  scale: Tracks;
}

export class Pose {
  private readonly translation: Float32Array;
  private readonly rotation: Float32Array;
  private readonly scale: Float32Array;
  private readonly world: Float32Array;
  private readonly local = new Float64Array(16);

  constructor(private readonly joints: Joints, private readonly moves: Moves) {
    [this.translation, this.rotation, this.scale] = [joints.translation.slice(), joints.rotation.slice(), joints.scale.slice()];
    this.world = new Float32Array(16 * joints.parent.length);
  }

  /** Writes the matrices of that second into `into`. */
  at(second: number, into: Float32Array): void {
    sample(this.moves.translation, second, this.translation);
    sample(this.moves.rotation, second, this.rotation);
    sample(this.moves.scale, second, this.scale);
    const { parent, inverse } = this.joints;
    for (let joint = 0; joint < parent.length; joint++) {
      this.compose(joint);
      if (parent[joint]! < 0) this.world.set(this.local, 16 * joint);
      else multiply(this.world, 16 * parent[joint]!, this.local, 0, this.world, 16 * joint);
      multiply(this.world, 16 * joint, inverse, 16 * joint, into, 16 * joint);
    }
  }

  /** T R S of a joint, into `local`. */
  private compose(joint: number): void {
    const [m, q, s, t] = [this.local, this.rotation, this.scale, this.translation];
    const x = q[4 * joint]!;
    const y = q[4 * joint + 1]!;
    const z = q[4 * joint + 2]!;
    const w = q[4 * joint + 3]!;
    const sx = s[3 * joint]!;
    const sy = s[3 * joint + 1]!;
    const sz = s[3 * joint + 2]!;
    m[0] = (1 - 2 * (y * y + z * z)) * sx;
    m[1] = 2 * (x * y + z * w) * sx;
    m[2] = 2 * (x * z - y * w) * sx;
    m[4] = 2 * (x * y - z * w) * sy;
    m[5] = (1 - 2 * (x * x + z * z)) * sy;
    m[6] = 2 * (y * z + x * w) * sy;
    m[8] = 2 * (x * z + y * w) * sz;
    m[9] = 2 * (y * z - x * w) * sz;
    m[10] = (1 - 2 * (x * x + y * y)) * sz;
    m[12] = t[3 * joint]!;
    m[13] = t[3 * joint + 1]!;
    m[14] = t[3 * joint + 2]!;
    m[15] = 1;
  }
}

/** a b, of frames whose last row is 0 0 0 1. */
function multiply(a: Float32Array, i: number, b: Float32Array | Float64Array, j: number, into: Float32Array, at: number): void {
  for (let column = 0; column < 16; column += 4) {
    const x = b[j + column]!;
    const y = b[j + column + 1]!;
    const z = b[j + column + 2]!;
    const last = column === 12 ? 1 : 0;
    for (let row = 0; row < 3; row++) into[at + column + row] = a[i + row]! * x + a[i + 4 + row]! * y + a[i + 8 + row]! * z + last * a[i + 12 + row]!;
    into[at + column + 3] = last;
  }
}
