// A tree that grows, as the program's file has it: parts at rest, joints that move them, and leaves that unfold.

import { Glb, type Channel, type Primitive } from "./glb";
import type { Joints, Moves } from "./pose";
import { before, tracksOf, type Tracks } from "./tracks";

/** Leaves that unfold: those of the tree are drawn back to their feet before, those that only a young tree bears are so at rest. */
export interface Fold {
  way: Float32Array; // 3 a vertex, metres: from where it is at rest
  time: Float32Array; // seconds
  share: Float32Array; // of that way, at each
  restsOut: boolean; // at rest they are unfolded
}

export interface GrowthPart {
  material: string;
  position: Float32Array;
  normal: Float32Array;
  uv: Float32Array;
  tint: Uint8Array | null; // 4 a vertex, linear, of 255
  joint: Uint8Array | Uint16Array; // 4 a vertex
  weight: Uint8Array | Float32Array; // 4 a vertex; bytes of 255
  index: Uint8Array | Uint16Array | Uint32Array;
  fold: Fold | null; // null: wood
}

export interface Growth {
  seconds: number;
  joints: Joints;
  moves: Moves;
  parts: GrowthPart[];
}

/** Throws where the bytes hold no such tree. */
export function growthOf(bytes: ArrayBuffer): Growth {
  const glb = new Glb(bytes);
  const { nodes, skins, animations } = glb.json;
  const [skin, moving] = [skins?.[0], animations?.[0]];
  if (!skin || !moving) throw new Error("The growth that came does not move.");
  const number = new Map(skin.joints.map((node, k) => [node, k]));
  const curve = ({ sampler }: Channel) => ({ time: glb.floats(moving.samplers[sampler]!.input), value: glb.floats(moving.samplers[sampler]!.output) });
  const tracks = (path: keyof Moves, width: 3 | 4): Tracks =>
    tracksOf(width, moving.channels.filter(({ target }) => target.path === path && number.has(target.node)).map((channel) => ({ target: number.get(channel.target.node)!, ...curve(channel) })));
  const moves: Moves = { translation: tracks("translation", 3), rotation: tracks("rotation", 4), scale: tracks("scale", 3) };
  const folds = new Map(moving.channels.filter(({ target }) => target.path === "weights").map((channel) => [channel.target.node, curve(channel)]));
  const parts = nodes.flatMap((node, k) => (node.mesh === undefined ? [] : glb.json.meshes[node.mesh]!.primitives.map((one) => partOf(glb, one, folds.get(k)))));
  const seconds = Math.max(0.1, ...Object.values(moves).map((one) => latest(one.time)), ...[...folds.values()].map(({ time }) => latest(time)));
  return { seconds, joints: jointsOf(glb, skin.joints, number, glb.floats(skin.inverseBindMatrices)), moves, parts };
}

/** The share of that way at that second. */
export function moved({ time, share }: Fold, second: number): number {
  const key = before(time, 0, time.length - 1, second);
  const next = Math.min(key + 1, time.length - 1);
  const span = time[next]! - time[key]!;
  return share[key]! + (span > 0 ? Math.min(1, Math.max(0, (second - time[key]!) / span)) : 0) * (share[next]! - share[key]!);
}

function latest(time: Float32Array): number {
  return time.reduce((most, one) => Math.max(most, one), 0);
}

function jointsOf(glb: Glb, joints: number[], number: Map<number, number>, inverse: Float32Array): Joints {
  const { nodes } = glb.json;
  const parent = new Int32Array(joints.length).fill(-1);
  joints.forEach((node, k) => nodes[node]!.children?.forEach((child) => { if (number.has(child)) parent[number.get(child)!] = k; }));
  if (parent.some((of, k) => of >= k)) throw new Error("The joints of the growth that came are out of order.");
  const rows = (path: "translation" | "rotation" | "scale", rest: number[]): Float32Array => Float32Array.from(joints.flatMap((node) => nodes[node]![path] ?? rest));
  return { parent, inverse, translation: rows("translation", [0, 0, 0]), rotation: rows("rotation", [0, 0, 0, 1]), scale: rows("scale", [1, 1, 1]) };
}

function partOf(glb: Glb, { attributes, indices, material, targets }: Primitive, curve: { time: Float32Array; value: Float32Array } | undefined): GrowthPart {
  const way = targets?.[0];
  const [position, index] = [glb.floats(attributes.POSITION!), glb.column(indices) as Uint32Array];
  return {
    material: glb.json.materials[material]!.name,
    position, index, normal: glb.floats(attributes.NORMAL!), uv: glb.floats(attributes.TEXCOORD_0!),
    tint: attributes.COLOR_0 === undefined ? null : (glb.column(attributes.COLOR_0) as Uint8Array),
    joint: glb.column(attributes.JOINTS_0!) as Uint16Array, weight: glb.column(attributes.WEIGHTS_0!) as Uint8Array,
    fold: way && curve ? { way: glb.floats(way.POSITION), time: curve.time, share: curve.value, restsOut: !isPoint(position, index) } : null,
  };
}

/** Are all corners of the first triangle at one place? */
function isPoint(position: Float32Array, index: Uint32Array): boolean {
  const [a, b, c] = [3 * index[0]!, 3 * index[1]!, 3 * index[2]!];
  return [0, 1, 2].every((k) => position[a + k] === position[b + k] && position[a + k] === position[c + k]);
}
