import { describe, expect, test } from "vitest";
import { readScan } from "../src/draw/cloud/scan";
import { seenFrom, stand } from "../src/draw/cloud/seen";
import { projected } from "../src/draw/turned";
import type { Cloud, Limb, Tree } from "../src/messages";
import { measured, said } from "../src/panel/cloud/words";
import { Store } from "../src/store";

const CLOUD: Cloud = { digest: "0".repeat(32), x: 100, y: 500, unit: 10, count: 2, coloured: true, height: 4, remarks: [] };
const POINTS = [0, 4, 0, 1, 2, -3]; // two points, metres

function bytes(): ArrayBuffer {
  const all = new Uint8Array(2 * 15);
  all.set(new Uint8Array(Float32Array.from(POINTS).buffer), 0);
  all.set([255, 0, 0, 0, 0, 255], 24);
  return all.buffer;
}

describe("points of a scan", () => {
  test("are read as the program sends them", () => {
    const scan = readScan(CLOUD, bytes());
    expect([...scan.xyz]).toEqual(POINTS);
    expect([...scan.rgb!]).toEqual([255, 0, 0, 0, 0, 255]);
    expect(readScan({ ...CLOUD, coloured: false }, bytes()).rgb).toBeNull();
  });

  test("stand upright on the page, their foot at its place", () => {
    const seen = seenFrom(readScan(CLOUD, bytes()), CLOUD, 100, 0);
    expect([...seen.xy]).toEqual([100, 460, 110, 480]);
    expect([...seen.order]).toEqual([1, 0]); // the farthest first
  });

  test("turn with the page as limbs do", () => {
    const tree = { scale: 0.1, root: [90, 500] } as Tree;
    const seen = seenFrom(readScan(CLOUD, bytes()), CLOUD, 90, 75);
    const limb = { path: [1, 4, 0, 2, 2, -3] } as Limb; // the same points from the tree's root, which stands a metre to the left
    projected(limb, tree, 75).forEach((value, k) => expect(seen.xy[k]).toBeCloseTo(value, 3));
  });
});

describe("the world's place on the page", () => {
  test("is that of the tree, else the foot of the points, in their metres", () => {
    const store = new Store();
    expect(stand(store)).toEqual({ scale: 1, root: [0, 0] });
    store.known.cloud = CLOUD;
    expect(stand(store)).toEqual({ scale: 0.1, root: [100, 500] });
    store.known.tree = { segments: 0, scale: 1, root: [0, 0] } as unknown as Tree; // of an empty page
    expect(stand(store).root).toEqual([100, 500]);
    store.known.tree = { segments: 9, scale: 0.2, root: [3, 4] } as unknown as Tree;
    expect(stand(store)).toMatchObject({ scale: 0.2, root: [3, 4] });
  });
});

describe("what is said", () => {
  const traced = { shown: true, size: 2, traced: true, turn: 0 };
  test("first what to do, then how far it is", () => {
    expect(said({ ...traced, traced: false }, null)).toBe("Draw over the points: limbs take their depth from them.");
    expect(said(traced, { type: "growing", revision: 1, state: "grows", stage: "infer", done: 0.5, remark: "" })).toBe("Tracing the tree …");
    expect(said(traced, { type: "growing", revision: 1, state: "ready", stage: "", done: 1, remark: "" })).toBe("Traced from the points.");
    expect(said(traced, { type: "growing", revision: 1, state: "failed", stage: "", done: 0, remark: "No tree." })).toBe("No tree.");
  });
  test("how many there are, and how high they stand", () => {
    expect(measured(18500, 19.39)).toBe("18,500 points, 19.4 m high");
  });
});
