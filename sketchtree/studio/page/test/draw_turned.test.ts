import { describe, expect, test } from "vitest";
import { PageCamera } from "../src/draw/camera";
import { isSamePage, wrapped } from "../src/draw/desk";
import { pressed } from "../src/draw/keys";
import { gridStep } from "../src/draw/paint/paper";
import { projected } from "../src/draw/turned";
import { sideName } from "../src/draw/view_corner";
import type { Limb } from "../src/messages";

const limb: Limb = {
  id: "1", strokes: [], parent: null, order: 0, locked: false, held: [], share: [0, 1], path: [0, 0, 0, 1, 2, 3], sd: [0, 0], view_deg: 0, was: null,
};
const tree = { scale: 0.5, root: [10, 100] };

describe("a turned page", () => {
  test("at 0 shows x to the right and y up", () => {
    expect(projected(limb, tree, 0)).toEqual([10, 100, 12, 96]);
  });

  test("at 90 is looked at from +x: what is near the front lies to the left", () => {
    const [, , x, y] = projected(limb, tree, 90);
    expect(x).toBeCloseTo(10 - 6);
    expect(y).toBeCloseTo(96);
  });

  test("is the same after a whole turn", () => {
    expect(isSamePage(-180, 180)).toBe(true);
    expect(isSamePage(359.8, 0)).toBe(true);
    expect(isSamePage(15, 0)).toBe(false);
    expect([wrapped(190), wrapped(-180), wrapped(360)]).toEqual([-170, 180, 0]);
  });

  test("has a name", () => {
    expect([0, 90, 180, -90, 45, -30].map(sideName)).toEqual(["Front", "From the right", "From behind", "From the left", "45° right", "30° left"]);
  });
});

describe("the page's camera", () => {
  test("keeps the place under the pointer when it comes closer", () => {
    const camera = new PageCamera();
    camera.resize(400, 300);
    const before = camera.toPage(120, 80);
    camera.zoom(2.5, 120, 80);
    camera.toPage(120, 80).forEach((value, at) => expect(value).toBeCloseTo(before[at]!));
  });

  test("shows all of a box", () => {
    const camera = new PageCamera();
    camera.resize(400, 300);
    camera.fit({ left: -1000, top: 50, width: 3000, height: 800 });
    const [[left, top], [right, bottom]] = [camera.toScreen(-1000, 50), camera.toScreen(2000, 850)];
    expect(Math.min(left, top)).toBeGreaterThan(0);
    expect(right).toBeLessThan(400);
    expect(bottom).toBeLessThan(300);
  });

  test("has a grid whose lines are never crowded", () => {
    for (const scale of [0.03, 0.5, 1, 7, 40]) expect(gridStep(scale) * scale).toBeGreaterThanOrEqual(18);
  });
});

test("keys are named as in the table of shortcuts", () => {
  const key = { key: "Z", ctrlKey: true, metaKey: false, altKey: false, shiftKey: true };
  expect(pressed(key)).toBe("Mod+Shift+z");
  expect(pressed({ ...key, key: "?", ctrlKey: false })).toBe("?");
  expect(pressed({ ...key, key: "ArrowLeft", ctrlKey: false, altKey: true, shiftKey: false })).toBe("Alt+ArrowLeft");
});
