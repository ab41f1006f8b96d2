// How does the tree on the page move with the program's file?

import { expect, test, vi } from "vitest";
import { Store } from "../src/store";
import { bendInWords, caught } from "../src/tree/growth/ageing";
import { Asking } from "../src/tree/growth/asking";
import { Clock } from "../src/tree/growth/clock";
import { growthOf, moved } from "../src/tree/growth/growth";
import { leafwise } from "../src/tree/growth/leafwise";
import { Pose } from "../src/tree/growth/pose";
import { sample, tracksOf } from "../src/tree/growth/tracks";

const HALF = Math.SQRT1_2;

/** A GLB of these columns: the accessors are numbered as they come. */
function glb(json: object, columns: { array: Float32Array | Uint16Array | Uint8Array; type: string; normalized?: boolean }[]): ArrayBuffer {
  const [views, accessors, parts]: [object[], object[], Uint8Array[]] = [[], [], []];
  let at = 0;
  for (const { array, type, normalized } of columns) {
    const width = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 }[type]!;
    const componentType = array instanceof Float32Array ? 5126 : array instanceof Uint16Array ? 5123 : 5121;
    views.push({ buffer: 0, byteOffset: at });
    accessors.push({ bufferView: views.length - 1, componentType, count: array.length / width, type, normalized });
    const bytes = new Uint8Array(Math.ceil(array.byteLength / 4) * 4);
    bytes.set(new Uint8Array(array.buffer));
    parts.push(bytes);
    at += bytes.length;
  }
  const text = new TextEncoder().encode(JSON.stringify({ ...json, bufferViews: views, accessors }));
  const long = Math.ceil(text.length / 4) * 4;
  const file = new Uint8Array(28 + long + at).fill(32);
  const words = new DataView(file.buffer);
  [0x46546c67, 2, file.length, long, 0x4e4f534a].forEach((word, k) => words.setUint32(4 * k, word, true));
  file.set(text, 20);
  words.setUint32(20 + long, at, true);
  words.setUint32(24 + long, 0x004e4942, true);
  let from = 28 + long;
  for (const bytes of parts) {
    file.set(bytes, from);
    from += bytes.length;
  }
  return file.buffer;
}

/** A triangle of wood on a joint that comes up to 2 m from the ground in 4 s, and one of leaves that unfolds in the last second. */
function small(corners = Float32Array.of(0, 2, 0, 1, 2, 0, 0, 3, 0)): ArrayBuffer {
  const rest = Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  const inverse = Float32Array.of(...rest, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -2, 0, 1);
  const attributes = { POSITION: 0, NORMAL: 1, TEXCOORD_0: 2, JOINTS_0: 3, WEIGHTS_0: 4 };
  const json = {
    nodes: [{ children: [1] }, { children: [2] }, { translation: [0, 2, 0] }, { mesh: 0 }, { mesh: 1 }],
    meshes: [
      { primitives: [{ attributes, indices: 5, material: 0 }] },
      { primitives: [{ attributes: { ...attributes, COLOR_0: 6 }, indices: 5, material: 1, targets: [{ POSITION: 7 }] }] },
    ],
    materials: [{ name: "wood_oak" }, { name: "leaf_oak" }],
    skins: [{ joints: [1, 2], inverseBindMatrices: 8 }],
    animations: [{
      channels: [{ sampler: 0, target: { node: 2, path: "translation" } }, { sampler: 1, target: { node: 2, path: "scale" } }, { sampler: 2, target: { node: 4, path: "weights" } }],
      samplers: [{ input: 9, output: 10 }, { input: 9, output: 11 }, { input: 12, output: 13 }],
    }],
  };
  return glb(json, [
    { array: corners, type: "VEC3" }, { array: new Float32Array(9), type: "VEC3" }, { array: new Float32Array(6), type: "VEC2" },
    { array: Uint16Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0), type: "VEC4" }, { array: Uint8Array.of(255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0), type: "VEC4", normalized: true },
    { array: Uint16Array.of(0, 1, 2), type: "SCALAR" }, { array: new Uint8Array(12).fill(200), type: "VEC4", normalized: true }, { array: new Float32Array(9).fill(-1), type: "VEC3" },
    { array: inverse, type: "MAT4" }, { array: Float32Array.of(0, 4), type: "SCALAR" }, { array: Float32Array.of(0, 0, 0, 0, 2, 0), type: "VEC3" },
    { array: Float32Array.of(0, 0, 0, 1, 1, 1), type: "VEC3" }, { array: Float32Array.of(0, 3, 4), type: "SCALAR" }, { array: Float32Array.of(1, 1, 0), type: "SCALAR" },
  ]);
}

/** Where the joint takes a point of the tree at rest. */
function taken(matrices: Float32Array, joint: number, [x, y, z]: [number, number, number]): number[] {
  return [0, 1, 2].map((row) => matrices[16 * joint + row]! * x + matrices[16 * joint + 4 + row]! * y + matrices[16 * joint + 8 + row]! * z + matrices[16 * joint + 12 + row]!);
}

test("between keys values go straight on; before the first and after the last they stay", () => {
  const tracks = tracksOf(3, [{ target: 1, time: Float32Array.of(1, 2, 4), value: Float32Array.of(0, 0, 0, 2, 0, 0, 2, 4, 0) }]);
  const into = new Float32Array(6).fill(7);
  const at = (second: number): number[] => { sample(tracks, second, into); return [...into.slice(3)]; };
  expect([at(0), at(1.5), at(2), at(3), at(9)]).toEqual([[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 2, 0], [2, 4, 0]]);
  expect([...into.slice(0, 3)], "a row without a track stays").toEqual([7, 7, 7]);
});

test("turns go the shorter way round", () => {
  const tracks = tracksOf(4, [{ target: 0, time: Float32Array.of(0, 1), value: Float32Array.of(0, 0, 0, 1, -HALF, 0, 0, -HALF) }]); // a quarter about x, by its other quaternion
  const into = new Float32Array(4);
  sample(tracks, 0.5, into);
  [Math.sin(Math.PI / 8), 0, 0, Math.cos(Math.PI / 8)].forEach((part, k) => expect(into[k]).toBeCloseTo(part, 6));
});

test("a joint takes its vertices from where they come to where they are in the tree", () => {
  const growth = growthOf(small());
  const [pose, into] = [new Pose(growth.joints, growth.moves), new Float32Array(64)];
  const tip = (second: number): number[] => { pose.at(second, into); return taken(into, 1, [0, 3, 0]); };
  expect([tip(0), tip(2), tip(4)]).toEqual([[0, 0, 0], [0, 1.5, 0], [0, 3, 0]]);
});

test("the file's parts have their materials, and leaves the way back to their foot", () => {
  const { parts, seconds } = growthOf(small());
  expect(seconds).toBe(4);
  expect(parts.map((part) => [part.material, part.fold !== null, part.index.length, part.weight.constructor.name])).toEqual([["wood_oak", false, 3, "Uint8Array"], ["leaf_oak", true, 3, "Uint8Array"]]);
  expect([0, 3, 3.5, 4, 9].map((second) => moved(parts[1]!.fold!, second))).toEqual([1, 1, 0.5, 0, 0]);
  expect(parts[1]!.fold!.restsOut).toBe(true);
});

test("leaves that only the young tree bears are at their feet at rest", () => {
  const growth = growthOf(small(Float32Array.of(0, 2, 0, 0, 2, 0, 0, 2, 0)));
  expect(growth.parts[1]!.fold!.restsOut).toBe(false);
});

test("what is no file of a growth says so", () => {
  expect(() => growthOf(new ArrayBuffer(8))).toThrow("The growth that came is no GLB.");
  expect(() => growthOf(small().slice(0, 200))).toThrow("The growth that came is cut short.");
  expect(() => growthOf(glb({ nodes: [] }, []))).toThrow("The growth that came does not move.");
});

test("any first part of the leaves is a thinner crown", () => {
  const index = Uint16Array.from(Array.from({ length: 10 }, (_, leaf) => [0, 1, 2, 0, 2, 3].map((corner) => 4 * leaf + corner)).flat());
  expect(leafwise(index)).toBe(6);
  const leaves = [...index].filter((_, k) => k % 6 === 0).map((corner) => corner / 4);
  expect([...leaves].sort((a, b) => a - b)).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
  expect(Math.max(...leaves.slice(0, 5)) - Math.min(...leaves.slice(0, 5))).toBeGreaterThan(6);
  expect(leafwise(Uint16Array.of(0, 1, 2, 0, 2, 3, 4, 5, 6)), "leaves that are not alike stay").toBe(0);
});

test("it plays from the beginning to the end, and again where it is to", () => {
  const clock = new Clock();
  clock.play();
  let now = 0;
  const seconds = (count: number): number => { for (let k = 0; k < 10 * count; k++) clock.tick((now += 100)); return clock.time; };
  clock.tick(now);
  expect(seconds(5)).toBeCloseTo(0.5, 6);
  expect([seconds(6), clock.playing]).toEqual([1, false]);
  clock.loops = true;
  clock.play();
  clock.tick(now);
  seconds(10.5);
  expect([clock.time, clock.playing]).toEqual([1, true]);
  expect(seconds(3)).toBeLessThan(0.3);
  clock.set(0.7);
  expect([clock.time, clock.playing]).toEqual([0.7, false]);
});

test("only the newest wish is asked for, and only its answer counts", async () => {
  vi.useFakeTimers();
  const [asked, said, store]: [Record<string, unknown>[], string[], Store] = [[], [], new Store()];
  vi.stubGlobal("fetch", async (_: string, { body, signal }: { body: string; signal: AbortSignal }) => {
    const wish = JSON.parse(body) as { id: string };
    asked.push(wish);
    store.take({ type: "making", id: wish.id, stage: "grow", done: 0.5 });
    store.take({ type: "making", id: "of another page", stage: "grow", done: 0.9 });
    await new Promise((done) => setTimeout(done, 100));
    if (signal.aborted) throw new DOMException("", "AbortError");
    return new Response(small(), { headers: { "x-revision": "7" } });
  });
  const asking = new Asking(store, { waits: (done) => said.push(`waits ${done}`), made: (growth, revision) => said.push(`${growth.parts.length} of ${revision}`), refused: (why) => said.push(why.message) });
  asking.soon(50);
  asking.soon(50);
  await vi.advanceTimersByTimeAsync(60);
  store.set("ageing", { mode: "scale", bend: 5 });
  asking.soon(50);
  await vi.advanceTimersByTimeAsync(300);
  expect(asked.map(({ id, ...wish }) => wish)).toEqual([{ mode: "full", bend: 0, tree: "drawn" }, { mode: "scale", bend: 5, tree: "drawn" }]);
  expect(asked[0]!.id).not.toEqual(asked[1]!.id);
  expect(said).toEqual(["waits 0", "waits 0", "waits 0.5", "waits 0", "waits 0.5", "2 of 7"]);
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

test("branches that bend hardly grow straight on", () => {
  expect([-60, -3, -2, 0, 2, 14].map((degrees) => bendInWords(caught(degrees)))).toEqual(["60° down", "3° down", "straight on", "straight on", "straight on", "14° up"]);
});
