// What does a hand on the tree do?

import { expect, test } from "vitest";
import { axes, between, framed, metres, panned, place, shortest, turned, zoomed, type Eye, type Point } from "../src/tree/eye/eye";
import { bent, cursorAlong, ends, grips, limits, placeAt, pulled } from "../src/tree/hand/drag";
import { pick, runsOf, type Ray } from "../src/tree/hand/pick";
import { depthOf, onPage } from "../src/tree/page/plane";
import type { MergedWood } from "../src/tree/plant/merge";
import { clear } from "../src/tree/stage/figure";
import { unmixed } from "../src/tree/show/capture";
import { crc32, zipped } from "../src/tree/show/zip";

const EYE: Eye = { azimuth: 0, elevation: 0, distance: 10, target: [0, 5, 0] };
const near = (a: readonly number[], b: readonly number[]): void => a.forEach((v, k) => expect(v).toBeCloseTo(b[k]!, 6));

test("azimuth 0 looks from the front, 90 from the tree's right", () => {
  near(place(EYE), [0, 5, 10]);
  near(place({ ...EYE, azimuth: 90 }), [10, 5, 0]);
  near(axes({ ...EYE, azimuth: 90 }).right, [0, 0, -1]);
});

test("no turn goes over the top or under the ground", () => {
  expect(turned(EYE, 0, 500).elevation).toBe(89.5);
  expect(turned(EYE, 0, -500).elevation).toBe(-20);
});

test("what is under the pointer stays there while one comes nearer", () => {
  const [x, y, high] = [120, -80, 600];
  const under = (eye: Eye): Point => [eye.target[0] + x * metres(eye, high), eye.target[1] - y * metres(eye, high), 0];
  near(under(zoomed(EYE, 1.7, x, y, high)), under(EYE));
});

test("the scene follows the hand that moves it", () => {
  near(panned(EYE, 100, 0, 600).target, [-100 * metres(EYE, 600), 5, 0]);
});

test("a framed eye sees the whole height of a tree, and its whole width in a narrow view", () => {
  const seen = (eye: Eye, at: Point): [number, number] => {
    const { right, up, back } = axes(eye);
    const offset = [0, 1, 2].map((k) => at[k]! - eye.target[k]!) as unknown as Point;
    const along = (way: Point): number => offset[0] * way[0] + offset[1] * way[1] + offset[2] * way[2];
    const half = (eye.distance - along(back)) * Math.tan((14 * Math.PI) / 180);
    return [along(right) / half, along(up) / half];
  };
  for (const aspect of [0.4, 1.5]) {
    const eye = framed({ ...EYE, azimuth: 30, elevation: 8 }, [0, 0, 0, 0, 9, 0, 3, 4.5, 0, -3, 4.5, 0, 0, 4.5, 3, 0, 4.5, -3], aspect);
    for (const at of [[0, 0, 0], [0, 9, 0], [3, 4.5, 0], [-3, 4.5, 0], [0, 4.5, 3]] as const) {
      const [x, y] = seen(eye, at);
      expect(Math.abs(x)).toBeLessThan(aspect);
      expect(Math.abs(y)).toBeLessThan(1);
    }
  }
});

test("a tree that leans far to one side stands in the middle of the view, and as large as one that stands straight", () => {
  const straight = [0, 0, 0, -4, 8, 0, 4, 8, 0];
  const leaning = [0, 0, 0, 0, 8, 0, 8, 8, 0];
  const [one, other] = [framed(EYE, straight, 1), framed(EYE, leaning, 1)];
  expect(other.distance).toBeCloseTo(one.distance, 6);
  expect(other.target[0]).toBeCloseTo(4, 6);
});

test("nothing to see moves no eye", () => {
  expect(framed(EYE, [], 1)).toBe(EYE);
});

test("the buttons at the view's foot hide nothing of the tree", () => {
  const eye = framed(EYE, [0, 0, 0, 0, 9, 0], 1, 0.2);
  const lowest = (0 - eye.target[1]) / (eye.distance * Math.tan((14 * Math.PI) / 180)); // -1 the foot
  expect(lowest).toBeGreaterThan(-1 + 2 * 0.2);
});

test("a person stands beside the tree where nothing hangs", () => {
  expect(clear([0, 1, 0, -3, 6, 0], -2, 0)).toBe(-2); // limbs high above do not matter
  expect(clear([-1.8, 1, 0, -2.4, 0.5, 0], -2, 0)).toBeCloseTo(-2.85, 6);
  expect(clear([-1.8, 1, -3], -2, 0)).toBe(-2); // nor does what hangs far behind
  expect(clear([-1.8, 1, 3], -2, 0)).toBeLessThan(-2); // what hangs before would hide one
});

test("a limb is not pulled farther than a few times its way on the page", () => {
  const [path, shares] = [[0, 0, 0, 2, 0, 1], [0, 1]];
  const [farther, nearer] = limits(path, shares, 1, [0, 0, 1], 0.1);
  expect(nearer).toBeCloseTo(2.5 * 2 - 1, 6);
  expect(farther).toBeCloseTo(-2.5 * 2 - 1, 6);
  expect(limits([0, 0, 0, 0, 0, 0.1], shares, 1, [0, 0, 1], 0.5)).toEqual([-0.6, 0.4]); // one that runs at the eye has some room too
});

test("over a handle the pointer shows the way it slides", () => {
  expect([cursorAlong(5, 0), cursorAlong(-5, 0.1), cursorAlong(0, -3), cursorAlong(2, 2), cursorAlong(-2, -2), cursorAlong(2, -2)])
    .toEqual(["ew-resize", "ew-resize", "ns-resize", "nwse-resize", "nwse-resize", "nesw-resize"]);
});

test("a flight turns the short way round", () => {
  expect(shortest(350)).toBe(-10);
  expect(between({ ...EYE, azimuth: 350 }, { ...EYE, azimuth: 10 }, 0.5).azimuth).toBe(360);
});

test("a page at 90 degrees lies where one looks at it from the tree's right", () => {
  const plane = { scale: 0.5, root: [100, 200] };
  near(onPage(plane, 0, 104, 190, 1), [2, 5, 1]);
  near(onPage(plane, 90, 104, 190, 1), [1, 5, -2]);
  expect(depthOf(90, onPage(plane, 90, 104, 190, 1))).toBeCloseTo(1);
});

test("a handle seen from its side follows the pointer, seen from its end comes nearer as it is pulled down", () => {
  const side = (at: Point): readonly [number, number] => [40 * at[2], -40 * at[1]]; // looking along x: depth runs across
  const end = (at: Point): readonly [number, number] => [40 * at[0], -40 * at[1]]; // looking along z: depth is not seen
  expect(pulled([0, 0, 0], [0, 0, 1], 80, 5, side, 40)).toBeCloseTo(2);
  expect(pulled([0, 0, 0], [0, 0, 1], 80, 20, end, 40)).toBeCloseTo(0.5);
});

test("a limb bends from its foot, which stays, and moves out of its page only", () => {
  const path = [0, 0, 0, 1, 1, 0, 2, 2, 0];
  expect([...bent(path, [0, 0.5, 1], 0.5, [0, 0, 1], 3)]).toEqual([0, 0, 0, 1, 1, 3, 2, 2, 3]);
});

test("a place at a share of a limb lies between its points", () => {
  near(placeAt([0, 0, 0, 2, 0, 0, 2, 4, 0], [0, 0.5, 1], 0.75), [2, 2, 0]);
});

test("grips are where a limb is held, at its tip, and between where there is room", () => {
  expect(grips([])).toEqual([0.25, 0.5, 0.75, 1]);
  expect(grips([0.52])).toEqual([0.25, 0.52, 0.75, 1]);
});

test("the foot of a limb nobody drew is its thicker end", () => {
  const ring = (y: number, radius: number): Point[] => [0, 1, 2, 3].map((k) => [radius * Math.cos((k * Math.PI) / 2), y, radius * Math.sin((k * Math.PI) / 2)]);
  const [foot, tip] = ends([...ring(5, 0.02), ...ring(2.5, 0.1), ...ring(0, 0.2)]);
  expect([foot[1], tip[1]]).toEqual([0, 5]);
});

const WOOD: MergedWood[] = [{
  material: "bark", normal: new Int8Array(), uv: new Float32Array(),
  position: Float32Array.of(-1, 0, 0, 1, 0, 0, 0, 2, 0, /* behind it */ -1, 0, -3, 1, 0, -3, 0, 2, -3, /* beside */ 4, 0, 0, 4.01, 0, 0, 4, 2, 0),
  limb: Float32Array.of(0, 0, 0, 1, 1, 1, 2, 2, 2), index: Uint32Array.of(0, 1, 2, 3, 4, 5, 6, 7, 8),
}];
const ray = (x: number, y: number): Ray => ({ from: [x, y, 10], way: [0, 0, -1], start: 0.1, spread: 0 });

test("the nearest limb under the pointer is picked, and a thin one from close by", () => {
  const runs = runsOf(WOOD);
  expect(runs.map((run) => run.limb)).toEqual([0, 1, 2]);
  expect(pick(WOOD, runs, ray(0, 0.5))).toMatchObject({ limb: 0, far: 10 });
  expect(pick(WOOD, runs, ray(4.05, 0.02))?.limb).toBe(2);
  expect(pick(WOOD, runs, ray(9, 9))).toBeNull();
});

test("what is seen on black and on white tells colour and alpha apart", () => {
  const [black, white] = [Uint8ClampedArray.of(100, 50, 0, 255, 0, 0, 0, 255), Uint8ClampedArray.of(227, 177, 127, 255, 255, 255, 255, 255)];
  unmixed(black, white);
  expect([...black]).toEqual([199, 100, 0, 128, 0, 0, 0, 0]);
});

test("an archive has its files, their sums and its end", async () => {
  expect(crc32(new TextEncoder().encode("123456789"))).toBe(0xcbf43926);
  const bytes = new Uint8Array(await zipped([{ name: "a.png", data: Uint8Array.of(1, 2, 3) }]).arrayBuffer());
  const view = new DataView(bytes.buffer);
  expect(view.getUint32(0, true)).toBe(0x04034b50);
  expect(view.getUint32(30 + 5 + 3, true)).toBe(0x02014b50);
  expect(view.getUint32(bytes.length - 22, true)).toBe(0x06054b50);
  expect(view.getUint16(bytes.length - 22 + 10, true)).toBe(1);
});
