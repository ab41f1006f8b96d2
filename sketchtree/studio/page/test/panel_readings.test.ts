import { expect, it } from "vitest";
import { twoViews } from "../src/panel/readings/two_views";

const room = { width: 100, height: 100, margin: 10 };

it("draws a tree from the front and from above at one scale, in the middle of its room", () => {
  const lines = twoViews([[0, 100, 0, 0, 0, 0], [0, 50, 0, 30, 20, 10]], room, room);
  expect(lines.front[0]).toEqual([38, 90, 38, 10]);
  expect(lines.front[1]).toEqual([38, 50, 62, 26]);
  expect(lines.above[1]).toEqual([38, 46, 62, 54]); // towards the viewer is down
});

it("keeps what is wide from above inside its room", () => {
  const { above } = twoViews([[0, 0, -500, 10, 10, 500]], room, room);
  expect(Math.min(...above[0]!)).toBeGreaterThanOrEqual(10);
  expect(Math.max(...above[0]!)).toBeLessThanOrEqual(90);
});

it("survives a tree of one point and of none", () => {
  expect(twoViews([[5, 5, 5]], room, room).front[0]).toEqual([50, 50]);
  expect(twoViews([], room, room)).toEqual({ front: [], above: [] });
});
