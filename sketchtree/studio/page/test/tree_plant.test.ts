// What is shown of the tree after each frame?

import { expect, test } from "vitest";
import type { Tree } from "../src/messages";
import type { Arrays } from "../src/store";
import { baked, strideOf } from "../src/tree/plant/bake";
import { coverage, mipmaps } from "../src/tree/plant/coverage";
import { doubtColours, most, ramp } from "../src/tree/plant/doubt";
import { merged, type MergedLeaves } from "../src/tree/plant/merge";
import { grown, NO_PLANT } from "../src/tree/plant/plant";
import { Plants } from "../src/tree/plant/plants";
import { shadeOf } from "../src/tree/plant/shade";

/** A frame in which each of these owners has one triangle of wood, at that height, and one leaf. */
function frame(heights: Record<string, number>, owners: string[], phase: Tree["phase"] = "full"): { head: Tree; arrays: Arrays } {
  const arrays: Arrays = new Map();
  const chunks = Object.entries(heights).map(([owner, y]) => {
    arrays.set(`${owner}.position`, Float32Array.of(0, y, 0, 1, y, 0, 0, y + 1, 0));
    arrays.set(`${owner}.normal`, Int8Array.of(0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0));
    arrays.set(`${owner}.uv`, new Float32Array(6));
    arrays.set(`${owner}.limb`, Uint16Array.of(0, 0, 1));
    arrays.set(`${owner}.index`, Uint32Array.of(0, 1, 2));
    arrays.set(`${owner}.leaf.place`, Float32Array.of(0, y, 0));
    arrays.set(`${owner}.leaf.turn`, Int16Array.of(0, 0, 0, 32767));
    arrays.set(`${owner}.leaf.scale`, Float32Array.of(1, 1, 1));
    arrays.set(`${owner}.leaf.tint`, Uint8Array.of(9, 8, 7));
    return { owner, digest: String(y), wood: [{ array: `${owner}.`, material: "bark", limbs: [owner, `${owner}0`] }], leaves: [{ array: `${owner}.leaf.`, card: "leaf" }] };
  });
  const head = { type: "tree", revision: 1, phase, owners, chunks, cards: [], materials: [] } as unknown as Tree;
  return { head, arrays };
}

test("a chunk takes the place of that with the same owner, and others stay", () => {
  const first = frame({ "1": 0, "2": 5 }, ["1", "2"]);
  const then = frame({ "2": 7 }, ["1", "2"], "quick");
  const plant = grown(grown(NO_PLANT, first.head, first.arrays), then.head, then.arrays);
  expect([...plant.chunks].map(([owner, chunk]) => [owner, chunk.wood[0]!.position[1]])).toEqual([["1", 0], ["2", 7]]);
});

test("an owner that a frame does not name is gone", () => {
  const [first, then] = [frame({ "1": 0, "2": 5 }, ["1", "2"]), frame({}, ["2"])];
  expect([...grown(grown(NO_PLANT, first.head, first.arrays), then.head, then.arrays).chunks.keys()]).toEqual(["2"]);
});

test("the frame's own memory is not kept", () => {
  const { head, arrays } = frame({ "1": 0 }, ["1"]);
  expect(grown(NO_PLANT, head, arrays).chunks.get("1")!.wood[0]!.position.buffer).not.toBe(arrays.get("1.position")!.buffer);
});

test("a frame that lacks an array says which", () => {
  const { head, arrays } = frame({ "1": 0 }, ["1"]);
  arrays.delete("1.uv");
  expect(() => grown(NO_PLANT, head, arrays)).toThrow("The frame of revision 1 lacks the array 1.uv.");
});

test("a glance is shown and not kept", () => {
  const [tree, glance, after] = [frame({ "1": 0 }, ["1"]), frame({ "9": 0 }, ["9"], "glance"), frame({}, ["1"])];
  const plants = new Plants();
  plants.take(tree.head, tree.arrays);
  expect([...plants.take(glance.head, glance.arrays)!.chunks.keys()]).toEqual(["9"]);
  expect([...plants.take(after.head, after.arrays)!.chunks.keys()]).toEqual(["1"]);
});

test("a photo's tree stands in the place of the drawing's, which goes on behind it", () => {
  const [tree, photo, after] = [frame({ "1": 0 }, ["1"]), frame({ "7": 0 }, ["7"], "photo"), frame({ "2": 0 }, ["1", "2"])];
  const plants = new Plants();
  plants.take(tree.head, tree.arrays);
  expect([...plants.take(photo.head, photo.arrays)!.chunks.keys()]).toEqual(["7"]);
  expect(plants.take(after.head, after.arrays)).toBeNull();
  expect([...plants.leavePhoto().chunks.keys()]).toEqual(["1", "2"]);
});

test("the wood of all chunks is one mesh a material, and each limb keeps one number", () => {
  const { head, arrays } = frame({ "1": 0, "2": 5 }, ["1", "2"]);
  const all = merged(grown(NO_PLANT, head, arrays));
  expect(all.wood).toHaveLength(1);
  expect([...all.wood[0]!.index]).toEqual([0, 1, 2, 3, 4, 5]);
  expect([...all.wood[0]!.limb].map((number) => all.limbs[number])).toEqual(["1", "1", "10", "2", "2", "20"]);
  expect(all.leaves.map((leaves) => leaves.count)).toEqual([2]);
});

const LEAVES: MergedLeaves = {
  card: "leaf", count: 2, place: Float32Array.of(0, 0, 0, 5, 0, 0), scale: Float32Array.of(1, 1, 1, 2, 2, 2), tint: Uint8Array.of(1, 2, 3, 4, 5, 6),
  turn: Int16Array.of(0, 0, 0, 32767, 0, 0, Math.round(32767 * Math.SQRT1_2), Math.round(32767 * Math.SQRT1_2)), // the second a quarter round z
};

test("a baked leaf stands where its place, turn and scale put it", () => {
  const card = { material: "leaf", position: Float32Array.of(1, 0, 0), normal: Float32Array.of(1, 0, 0), uv: Float32Array.of(0, 0), index: Uint32Array.of(0, 0, 0) };
  const { position, normal, tint } = baked(LEAVES, card);
  const second = position[0]! > 3 ? 0 : 1;
  expect([...position.slice(3 * second, 3 * second + 3)].map((v) => Math.round(v * 1000) / 1000)).toEqual([5, 2, 0]);
  expect([0, 1, 2].map((axis) => Math.round(normal[4 * second + axis]! / 127))).toEqual([0, 1, 0]);
  expect([...tint.slice(4 * second, 4 * second + 3)]).toEqual([4, 5, 6]);
});

test.each([1, 2, 3, 10, 97, 60000])("of %i baked leaves each has its turn once", (count) => {
  const stride = strideOf(count);
  const seen = new Set<number>();
  for (let k = 0, at = 0; k < count; k++, at = (at + stride) % count) seen.add(at);
  expect(seen.size).toBe(count);
});

test("smaller pictures of a leaf cover as much as the first", () => {
  const size = 64;
  const data = new Uint8Array(4 * size * size).fill(200);
  for (let k = 0; k < size * size; k++) data[4 * k + 3] = (k % size) % 4 === 0 ? 255 : 0; // thin stripes: averages are a quarter
  const levels = mipmaps({ width: size, height: size, data }, 0.4);
  expect(levels.map((level) => level.width)).toEqual([64, 32, 16, 8, 4, 2, 1]);
  expect(coverage(data, 0.4, 1)).toBeCloseTo(0.25, 5);
  for (const level of levels.slice(1)) expect(coverage(level.data, 0.4, 1)).toBeGreaterThan(0.2);
});

test("clear pixels lend their colour to nobody", () => {
  const data = Uint8Array.of(0, 200, 0, 255, 255, 0, 0, 0, 0, 200, 0, 255, 255, 0, 0, 0);
  const [, half] = mipmaps({ width: 2, height: 2, data }, null);
  expect(half!.data[1]).toBeGreaterThan(190);
  expect(half!.data[0]).toBeLessThan(20);
});

test("the inside of a crown sees less of the sky than its outside, and no leaves shade nothing", () => {
  const place: number[] = [];
  for (let x = 0; x < 12; x += 0.4) for (let y = 0; y < 12; y += 0.4) for (let z = 0; z < 12; z += 0.4) place.push(x, y, z);
  const count = place.length / 3;
  const crown: MergedLeaves = { card: "leaf", count, place: Float32Array.from(place), turn: new Int16Array(4 * count), scale: new Float32Array(3 * count).fill(0.3), tint: new Uint8Array(3 * count) };
  const shade = shadeOf([crown], [0, 1, 0])!;
  const [nx, ny, nz] = shade.cells;
  const at = (x: number, y: number, z: number): number => 2 * (x + nx * (y + ny * z));
  const [inside, above] = [at(nx >> 1, ny >> 1, nz >> 1), at(nx >> 1, ny - 1, nz >> 1)];
  expect(shade.light[inside]).toBeLessThan(shade.light[above]! / 2);
  expect(shade.light[inside + 1]).toBeLessThan(shade.light[above + 1]!);
  expect(shadeOf([], [0, 1, 0])).toBeNull();
});

test("doubt is a colour between the ramp's ends, and grey where nobody drew", () => {
  expect(ramp(-1)).toEqual([...ramp(0)]);
  expect(ramp(2)).toEqual([...ramp(1)]);
  const { head, arrays } = frame({ "1": 0 }, ["1"]);
  const now = merged(grown(NO_PLANT, head, arrays));
  const limb = { id: "1", path: [0, 0, 0, 0, 1, 0], sd: [0, 0.5], share: [0, 1] } as never;
  const [colours] = doubtColours(now, [limb]);
  expect([...colours!.slice(0, 3)]).not.toEqual([...colours!.slice(6, 9)]); // the third vertex is of a limb that was not drawn
  expect(most([limb])).toBe(0.5);
});
