// What is there of the tree? Its chunks by owner, with the cards and materials they use: what frames said so far, put together.
//
// A chunk takes the place of that with the same owner; an owner that a frame does not name is gone. Arrays are copied out of the frame, so that a frame of
// which one small chunk is left does not keep its megabytes.

import type { Chunk, Material, Tree } from "../../messages";
import type { Arrays } from "../../store";

export interface WoodPart {
  material: string;
  limbs: string[]; // ids
  position: Float32Array; // 3 a vertex, metres
  normal: Int8Array; // 4 a vertex, of 127
  uv: Float32Array;
  limb: Uint16Array; // index of `limbs`
  index: Uint32Array;
}

export interface LeafPart {
  card: string;
  place: Float32Array; // 3 a leaf, metres
  turn: Int16Array; // 4 a leaf, quaternion of 32767
  scale: Float32Array; // 3 a leaf
  tint: Uint8Array; // 3 a leaf, linear, of 255
}

export interface CardShape {
  material: string;
  position: Float32Array;
  normal: Float32Array;
  uv: Float32Array;
  index: Uint32Array;
}

export interface Grown {
  wood: WoodPart[];
  leaves: LeafPart[];
}

export interface Plant {
  chunks: ReadonlyMap<string, Grown>;
  cards: ReadonlyMap<string, CardShape>;
  materials: ReadonlyMap<string, Material>;
}

export const NO_PLANT: Plant = { chunks: new Map(), cards: new Map(), materials: new Map() };

type Kind = Float32ArrayConstructor | Uint32ArrayConstructor | Uint16ArrayConstructor | Uint8ArrayConstructor | Int16ArrayConstructor | Int8ArrayConstructor;

/** The plant after this frame. */
export function grown(plant: Plant, head: Tree, arrays: Arrays): Plant {
  const array = <K extends Kind>(name: string, kind: K): InstanceType<K> => {
    const found = arrays.get(name);
    if (!(found instanceof kind)) throw new Error(`The frame of revision ${head.revision} lacks the array ${name}.`);
    return found.slice() as InstanceType<K>;
  };
  const chunks = new Map<string, Grown>();
  const fresh = new Map(head.chunks.map((chunk) => [chunk.owner, chunk]));
  for (const owner of head.owners) {
    const come = fresh.get(owner);
    const had = plant.chunks.get(owner);
    if (come) chunks.set(owner, chunkOf(come, array));
    else if (had) chunks.set(owner, had);
  }
  const cards = new Map(plant.cards);
  for (const { name, material, array: at } of head.cards) {
    const [position, normal, uv] = [array(`${at}position`, Float32Array), array(`${at}normal`, Float32Array), array(`${at}uv`, Float32Array)];
    cards.set(name, { material, position, normal, uv, index: array(`${at}index`, Uint32Array) });
  }
  return { chunks, cards, materials: new Map([...plant.materials, ...head.materials.map((one) => [one.key, one] as const)]) };
}

function chunkOf(chunk: Chunk, array: <K extends Kind>(name: string, kind: K) => InstanceType<K>): Grown {
  const wood = chunk.wood.map(({ array: at, material, limbs }) => ({
    material, limbs,
    position: array(`${at}position`, Float32Array), normal: array(`${at}normal`, Int8Array), uv: array(`${at}uv`, Float32Array),
    limb: array(`${at}limb`, Uint16Array), index: array(`${at}index`, Uint32Array),
  }));
  const leaves = chunk.leaves.map(({ array: at, card }) => ({
    card,
    place: array(`${at}place`, Float32Array), turn: array(`${at}turn`, Int16Array), scale: array(`${at}scale`, Float32Array), tint: array(`${at}tint`, Uint8Array),
  }));
  return { wood, leaves };
}
