import { describe, expect, test } from "vitest";
import { cut } from "../src/draw/line/cutting";
import type { Stroke } from "../src/messages";

const straight: Stroke = {
  id: "a", kind: "branch", xy: Array.from({ length: 11 }, (_, k) => [10 * k, 0]).flat(), pressure: Array.from({ length: 11 }, (_, k) => k / 10),
  time: Array.from({ length: 11 }, (_, k) => 8 * k), width: 4, closed: false, view_deg: 30,
};
const square: Stroke = { ...straight, id: "c", kind: "crown", xy: [0, 0, 100, 0, 100, 100, 0, 100], pressure: null, time: null, closed: true, view_deg: 0 };

const fresh = (): (() => string) => {
  let count = 0;
  return () => `new-${(count += 1)}`;
};

describe("the eraser", () => {
  test("cuts a line in two, at the edge of what it went over", () => {
    const pieces = cut(straight, 50, 0, 7, fresh());
    expect(pieces.map((piece) => piece.id)).toEqual(["a", "new-1"]);
    expect(pieces[0]!.xy.slice(-2)).toEqual([43, 0]);
    expect(pieces[1]!.xy.slice(0, 2)).toEqual([57, 0]);
  });

  test("leaves the id to the piece at the root, also of a line drawn towards it", () => {
    expect(cut(straight, 50, 0, 7, fresh(), true).map((piece) => piece.id)).toEqual(["new-1", "a"]);
  });

  test("cuts pressure and time along", () => {
    const [first, second] = cut(straight, 50, 0, 7, fresh());
    expect(first!.pressure!.at(-1)).toBeCloseTo(0.43);
    expect(second!.time![0]).toBeCloseTo(45.6);
    for (const piece of [first!, second!]) expect(piece.pressure!.length).toBe(piece.xy.length / 2);
  });

  test("leaves the page and the width of a piece as they were", () => {
    for (const piece of cut(straight, 50, 0, 7, fresh())) expect([piece.view_deg, piece.width]).toEqual([30, 4]);
  });

  test("passes between two points and still cuts", () => {
    const long: Stroke = { ...straight, xy: [0, 0, 100, 0], pressure: null, time: null };
    expect(cut(long, 50, 0, 5, fresh())).toHaveLength(2);
  });

  test("gives the stroke itself back where it is not touched", () => {
    expect(cut(straight, 50, 20, 7, fresh())).toEqual([straight]);
  });

  test("shortens a line at its end, and leaves nothing of one it covers", () => {
    expect(cut(straight, 100, 0, 7, fresh()).map((piece) => piece.xy.slice(-2))).toEqual([[93, 0]]);
    expect(cut(straight, 50, 0, 60, fresh())).toEqual([]);
  });

  test("opens an outline: one piece, that goes round from cut to cut", () => {
    const [piece, ...others] = cut(square, 100, 50, 10, fresh());
    expect(others).toEqual([]);
    expect([piece!.id, piece!.closed]).toEqual(["c", false]);
    expect(piece!.xy.slice(0, 2)).toEqual([100, 60]);
    expect(piece!.xy.slice(-2)).toEqual([100, 40]);
  });
});
