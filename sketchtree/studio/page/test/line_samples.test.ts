import { describe, expect, test } from "vitest";
import { insert, type Sample } from "../src/draw/line/samples";

const at = (time: number, x: number, y = 0): Sample => ({ x, y, pressure: 0.5, time });

describe("the pen's events", () => {
  test("out of order, they are put in order of time", () => {
    const line: Sample[] = [];
    insert(line, [at(0, 0), at(20, 2), at(10, 1), at(30, 3)]);
    expect(line.map((sample) => sample.x)).toEqual([0, 1, 2, 3]);
  });

  test("told twice, they count once", () => {
    const line: Sample[] = [];
    insert(line, [at(0, 0), at(10, 1)]);
    insert(line, [at(0, 0), at(10, 1), at(20, 2)]);
    expect(line).toHaveLength(3);
  });

  test("at one time, the last told holds", () => {
    const line = [at(0, 0), at(10, 1)];
    insert(line, [at(10, 1.5)]);
    expect(line.map((sample) => sample.x)).toEqual([0, 1.5]);
  });

  test("a pen that rests adds no points, but its firmest press stays", () => {
    const line = [at(0, 0), at(10, 1)];
    insert(line, [{ ...at(20, 1), pressure: 0.9 }, at(30, 1)]);
    expect(line).toEqual([at(0, 0), { ...at(10, 1), pressure: 0.9 }]);
  });

  test("what is no number is left out", () => {
    const line: Sample[] = [];
    insert(line, [at(0, NaN), at(5, Infinity), at(NaN, 1), at(10, 1)]);
    expect(line).toEqual([at(10, 1)]);
  });
});
