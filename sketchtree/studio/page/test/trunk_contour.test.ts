// What of a trunk's contour is under the pen, and what does an edit of it leave?

import { expect, test } from "vitest";
import { contourOf, cornersBetween, gridOf, lineAlong, nearestCorner, nearestPlace, pointAt, toPixels, wayBetween, type Corner, type Place } from "../src/draw/trunk/contour";
import { isClear, keeps, merged, NO_EDITS, restored, shown, withPlace, without } from "../src/draw/trunk/edits";
import type { Trunks } from "../src/messages";

/** A square of 40 pixels with its corners and two more vertices on its upper side, at x = 10 and x = 30; and a hole. */
const SQUARE = [0, 0, 40, 0, 40, 40, 0, 40];
const HOLE = [18, 18, 18, 22, 22, 22, 22, 18];
const found: Trunks = {
  type: "trunks", revision: 1, state: "ready", trees: [], remark: "", size: [40, 40],
  vertices: [[0, 0, 10, 0, 30, 0, 40, 0, 40, 40, 0, 40], [18, 18, 18, 22, 22, 22]], parts: [[true, false, false, true, true, true], [true, true, true]], contour: [SQUARE, HOLE],
};
const contour = contourOf(found);
const at = (corners: readonly Corner[]): [number, number][] => corners.map(({ x, y }) => [x, y]);
const outer = (corners: readonly Corner[]): [number, number][] => at(corners.filter(({ ring }) => ring === 0));
const place = (x: number, y: number): Place => nearestPlace(contour, x, y)!;

test("a ring knows how long it is, and how far along it each vertex lies", () => {
  expect(contour.rings.map((ring) => ring.length)).toEqual([160, 16]);
  expect(contour.corners.map(({ s }) => s)).toEqual([0, 10, 30, 40, 80, 120, 0, 4, 8]);
  expect(contour.corners.map(({ parts }) => parts)).toEqual([true, false, false, true, true, true, true, true, true]);
});

test("the nearest point of the contour lies on a side, not on a vertex", () => {
  expect(nearestPlace(contour, 17, -5)).toEqual({ ring: 0, x: 17, y: 0, s: 17 });
  expect(nearestPlace(contour, 0.5, 25)).toMatchObject({ ring: 0, x: 0, y: 25, s: 135 }); // the side that closes the ring
  expect(nearestPlace(contour, 18.5, 20)).toMatchObject({ ring: 1, x: 18, y: 20 });
  expect(nearestPlace(contour, 17, -5, 4)).toBeNull();
});

test("of several vertices within reach the nearest is meant", () => {
  expect(nearestCorner(contour.corners, 12, 1, 20)).toMatchObject({ x: 10, y: 0 });
  expect(nearestCorner(contour.corners, 12, 1, 2)).toBeNull();
});

test("between two places lies the shorter way round, over the first point too", () => {
  expect(wayBetween(contour, place(5, 0), place(35, 0))).toEqual({ from: 5, long: 30 });
  expect(wayBetween(contour, place(0, 20), place(5, 0))).toEqual({ from: 140, long: 25 });
  expect(at(cornersBetween(contour, contour.corners, place(5, 0), place(35, 0)))).toEqual([[10, 0], [30, 0]]);
  expect(at(cornersBetween(contour, contour.corners, place(35, 0), place(5, 0)))).toEqual([[10, 0], [30, 0]]);
  expect(at(cornersBetween(contour, contour.corners, place(0, 20), place(20, 0)))).toEqual([[0, 0], [10, 0]]);
  expect(at(cornersBetween(contour, contour.corners, place(10, 0), place(30, 0)))).toEqual([[10, 0], [30, 0]]); // both ends count
  expect(cornersBetween(contour, contour.corners, place(5, 0), place(18, 20))).toEqual([]); // of another ring
});

test("a way along the contour goes round its corners", () => {
  expect(pointAt(contour.rings[0]!, 50)).toEqual([40, 10]);
  expect(pointAt(contour.rings[0]!, -10)).toEqual([0, 10]);
  expect(lineAlong(contour.rings[0]!, 30, 60)).toEqual([30, 0, 40, 0, 40, 40, 30, 40]);
  expect(lineAlong(contour.rings[0]!, 150, 20)).toEqual([0, 10, 0, 0, 10, 0]);
});

test("pixels of the photo are where the picture lies on the page", () => {
  const grid = gridOf(found, { digest: "", x: -100, y: -800, width: 80, height: 80, opacity: 1, photo: true });
  expect(toPixels(grid, -100, -800)).toEqual([0, 0]);
  expect(toPixels(grid, -60, -780)).toEqual([20, 10]);
});

test("a vertex that is removed is gone at once, and comes back with its edit", () => {
  const edits = without(NO_EDITS, contour.corners[1]!);
  expect(edits).toEqual({ remove: [[10, 0]], add: [], merge: [] });
  expect(outer(shown(contour, edits))).toEqual([[0, 0], [30, 0], [40, 0], [40, 40], [0, 40]]);
  expect(restored(edits, edits.remove[0]!)).toEqual(NO_EDITS);
  expect(withPlace(edits, place(10.5, 0))).toEqual(NO_EDITS); // a new one where one went
});

test("a vertex that is added is there at once, and removing it is no edit", () => {
  const edits = withPlace(NO_EDITS, place(40, 17.0004));
  expect(edits).toEqual({ remove: [], add: [[40, 17]], merge: [] });
  const added = shown(contour, edits).find((corner) => corner.added)!;
  expect(added).toMatchObject({ x: 40, y: 17, parts: true, s: 57 });
  expect(without(edits, added)).toEqual(NO_EDITS);
});

test("a merge names two places that stay clear of the vertices that stay", () => {
  const gone = cornersBetween(contour, contour.corners, place(5, 0), place(35, 0));
  const edits = merged(contour, contour.corners, gone, NO_EDITS);
  expect(edits).toEqual({ remove: [], add: [], merge: [[[5, 0], [35, 0]]] });
  expect(outer(shown(contour, edits))).toEqual([[0, 0], [40, 0], [40, 40], [0, 40]]);
  const tight = merged(contour, contour.corners, contour.corners.slice(1, 2), NO_EDITS); // one vertex, from where it is
  expect(outer(shown(contour, tight))).toEqual([[0, 0], [30, 0], [40, 0], [40, 40], [0, 40]]);
});

test("a merge takes vertices that were added with it, and is no edit where there are no others", () => {
  const one = withPlace(NO_EDITS, place(20, 0));
  const gone = cornersBetween(contour, shown(contour, one), place(15, 0), place(25, 0));
  expect(merged(contour, shown(contour, one), gone, one)).toEqual(NO_EDITS);
  const more = cornersBetween(contour, shown(contour, one), place(5, 0), place(25, 0));
  expect(merged(contour, shown(contour, one), more, one)).toEqual({ remove: [], add: [], merge: [[[5, 0], [25, 0]]] });
});

test("what the program has done already is not done twice", () => {
  const after = contourOf({ ...found, vertices: [[0, 0, 40, 0, 40, 17, 40, 40, 0, 40], found.vertices[1]!], parts: [[true, true, true, true, true], [true, true, true]] });
  const edits = { remove: [[10, 0], [30, 0]] as [number, number][], add: [[40, 17]] as [number, number][], merge: [[[5, 0], [35, 0]]] as [[number, number], [number, number]][] };
  expect(outer(shown(after, edits))).toEqual([[0, 0], [40, 0], [40, 17], [40, 40], [0, 40]]);
  expect(shown(after, edits).filter(({ added }) => added)).toHaveLength(1);
});

test("a contour keeps three points, and it is clear which way round is meant", () => {
  const hole = contour.corners.filter(({ ring }) => ring === 1);
  expect(keeps(contour.corners, hole.slice(0, 1))).toBe("A contour keeps 3 points");
  expect(keeps(contour.corners, contour.corners.slice(0, 3))).toBeNull();
  expect(isClear(contour, place(0, 0), place(40, 20))).toBe(true);
  expect(isClear(contour, place(0, 0), place(40, 38))).toBe(false);
  expect(isClear(contour, place(0, 0), place(18, 20))).toBe(false);
});

test("hit tests are quick on a contour of a large photo", () => {
  const round = Array.from({ length: 4000 }, (_, k) => [750 + 700 * Math.cos((k * Math.PI) / 2000), 750 + 700 * Math.sin((k * Math.PI) / 2000)]).flat();
  const large = contourOf({ ...found, size: [1500, 1500], contour: [round], vertices: [round.filter((_, k) => k % 20 < 2)], parts: [] });
  expect(large.corners).toHaveLength(400);
  expect(nearestCorner(large.corners, ...(round.slice(40, 42) as [number, number]), 0.5)).toMatchObject({ x: round[40], y: round[41] });
  expect(cornersBetween(large, large.corners, large.corners[398]!, large.corners[3]!)).toHaveLength(6);
});
