// How do the parts of all chunks become few draw calls? Wood: one mesh a material; leaves: one list of places a card.
//
// Everything is copied whenever anything changed: 200,000 triangles are 10 MB and take a few milliseconds, less than one pass over the scene saves.

import type { LeafPart, Plant, WoodPart } from "./plant";

export interface MergedWood {
  material: string;
  position: Float32Array;
  normal: Int8Array;
  uv: Float32Array;
  limb: Float32Array; // number of the limb, as `Merged.limbs` counts them; a float so that a shader takes it as it is
  index: Uint32Array;
}

export interface MergedLeaves {
  card: string;
  count: number;
  place: Float32Array;
  turn: Int16Array;
  scale: Float32Array;
  tint: Uint8Array;
}

export interface Merged {
  wood: MergedWood[];
  leaves: MergedLeaves[];
  limbs: string[]; // id of each number
  number: ReadonlyMap<string, number>; // of each id
}

export function merged(plant: Plant): Merged {
  const number = new Map<string, number>();
  const wood = new Map<string, WoodPart[]>();
  const leaves = new Map<string, LeafPart[]>();
  for (const chunk of plant.chunks.values()) {
    for (const part of chunk.wood) {
      among(wood, part.material).push(part);
      for (const id of part.limbs) if (!number.has(id)) number.set(id, number.size);
    }
    for (const part of chunk.leaves) among(leaves, part.card).push(part);
  }
  return {
    wood: [...wood].map(([material, parts]) => joinedWood(material, parts, number)),
    leaves: [...leaves].map(([card, parts]) => joinedLeaves(card, parts)),
    limbs: [...number.keys()],
    number,
  };
}

function among<T>(groups: Map<string, T[]>, name: string): T[] {
  if (!groups.has(name)) groups.set(name, []);
  return groups.get(name)!;
}

function joinedWood(material: string, parts: WoodPart[], number: ReadonlyMap<string, number>): MergedWood {
  const vertices = total(parts, (part) => part.limb.length);
  const all: MergedWood = {
    material,
    position: new Float32Array(3 * vertices), normal: new Int8Array(4 * vertices), uv: new Float32Array(2 * vertices), limb: new Float32Array(vertices),
    index: new Uint32Array(total(parts, (part) => part.index.length)),
  };
  let vertex = 0;
  let corner = 0;
  for (const part of parts) {
    all.position.set(part.position, 3 * vertex);
    all.normal.set(part.normal, 4 * vertex);
    all.uv.set(part.uv, 2 * vertex);
    const numbers = part.limbs.map((id) => number.get(id)!);
    for (let k = 0; k < part.limb.length; k++) all.limb[vertex + k] = numbers[part.limb[k]!]!;
    for (let k = 0; k < part.index.length; k++) all.index[corner + k] = part.index[k]! + vertex;
    vertex += part.limb.length;
    corner += part.index.length;
  }
  return all;
}

function joinedLeaves(card: string, parts: LeafPart[]): MergedLeaves {
  const count = total(parts, (part) => part.place.length / 3);
  const all: MergedLeaves = {
    card, count,
    place: new Float32Array(3 * count), turn: new Int16Array(4 * count), scale: new Float32Array(3 * count), tint: new Uint8Array(3 * count),
  };
  let leaf = 0;
  for (const part of parts) {
    all.place.set(part.place, 3 * leaf);
    all.turn.set(part.turn, 4 * leaf);
    all.scale.set(part.scale, 3 * leaf);
    all.tint.set(part.tint, 3 * leaf);
    leaf += part.place.length / 3;
  }
  return all;
}

function total<T>(parts: T[], count: (part: T) => number): number {
  return parts.reduce((sum, part) => sum + count(part), 0);
}
