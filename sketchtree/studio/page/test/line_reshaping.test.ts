import { describe, expect, test } from "vitest";
import { isCaught, isInside, nearest } from "../src/draw/line/nearness";
import { moved, pulled } from "../src/draw/line/reshaping";
import type { Stroke } from "../src/messages";

const straight: Stroke = {
  id: "a", kind: "branch", xy: Array.from({ length: 11 }, (_, k) => [10 * k, 0]).flat(), pressure: null, time: null, width: null, closed: false, view_deg: 0,
};
const square: Stroke = { ...straight, id: "c", kind: "crown", xy: [0, 0, 100, 0, 100, 100, 0, 100], closed: true };

describe("reshaping", () => {
  test("moves every point of a stroke alike", () => {
    expect(moved(square, 5, -3).xy).toEqual([5, -3, 105, -3, 105, 97, 5, 97]);
  });

  test("pulls the point that is held all the way, and far ones not at all", () => {
    const { xy } = pulled(straight, 5, 0, 8, 30);
    expect(xy[11]).toBe(8);
    expect([xy[1], xy[21]]).toEqual([0, 0]);
    expect(xy[13]).toBeGreaterThan(0);
    expect(xy[13]).toBeLessThan(8);
  });

  test("goes around a closed outline the shorter way", () => {
    const { xy } = pulled(square, 0, -10, 0, 150);
    expect(xy[6]).toBeCloseTo(xy[2]! - 100, 6);
  });
});

describe("under the pen", () => {
  test("the nearest stroke within reach is found", () => {
    const other = { ...straight, id: "b", xy: [0, 20, 100, 20] };
    expect(nearest([straight, other], 50, 13, 10)?.id).toBe("b");
    expect(nearest([straight, other], 50, 60, 10)).toBeNull();
  });

  test("an outline has an inside", () => {
    expect(isInside(square.xy, 50, 50)).toBe(true);
    expect(isInside(square.xy, 150, 50)).toBe(false);
  });

  test("a lasso catches strokes that lie mostly in it", () => {
    expect(isCaught(straight, [-5, -5, 70, -5, 70, 5, -5, 5])).toBe(true);
    expect(isCaught(straight, [-5, -5, 30, -5, 30, 5, -5, 5])).toBe(false);
  });
});
