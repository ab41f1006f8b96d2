import { describe, expect, test } from "vitest";
import type { Sample } from "../src/draw/line/samples";
import { stabilise } from "../src/draw/line/stabiliser";

/** A slow line to the right, with a shake of ±2 px. */
const shaky: Sample[] = Array.from({ length: 120 }, (_, k) => ({ x: k * 0.8, y: k % 2 ? 2 : -2, pressure: 0.5, time: k * 8 }));

const shake = (line: Sample[]): number => Math.max(...line.slice(60, 110).map((sample) => Math.abs(sample.y)));

describe("a shaking hand", () => {
  test("is steadied, the more the stronger", () => {
    const [weak, middle, strong] = [0.2, 0.5, 0.9].map((strength) => shake(stabilise(shaky, strength, 1, true)));
    expect(weak).toBeLessThan(2);
    expect(middle).toBeLessThan(weak!);
    expect(strong).toBeLessThan(0.3);
  });

  test("is left alone at strength 0", () => {
    expect(stabilise(shaky, 0, 1, true)).toEqual(shaky);
  });

  test("the line ends where the pen was lifted", () => {
    const end = stabilise(shaky, 1, 1, true).at(-1)!;
    expect([end.x, end.y]).toEqual([shaky.at(-1)!.x, shaky.at(-1)!.y]);
  });

  test("the line begins where the pen came down", () => {
    expect(stabilise(shaky, 1, 1, true)[0]).toEqual(shaky[0]);
  });

  test("is steadied alike at any zoom", () => {
    const far = shaky.map((sample) => ({ ...sample, x: sample.x * 10, y: sample.y * 10 }));
    const near = stabilise(shaky, 0.5, 1, true).map((sample) => sample.y);
    stabilise(far, 0.5, 0.1, true).forEach((sample, k) => expect(sample.y / 10).toBeCloseTo(near[k]!, 6));
  });

  test("a fast line lags by no more than a few pixels", () => {
    const fast = Array.from({ length: 60 }, (_, k) => ({ x: k * 24, y: 0, pressure: 0.5, time: k * 8 })); // 3000 px/s
    const lag = stabilise(fast, 0.35, 1, false).at(-1)!.x - fast.at(-1)!.x;
    expect(Math.abs(lag)).toBeLessThan(30);
  });

  test("a lifted line lags nowhere", () => {
    const bend = Array.from({ length: 120 }, (_, k) => ({ x: k * 4, y: 60 * Math.sin(k / 12), pressure: 0.5, time: k * 8 }));
    const steady = stabilise(bend, 0.5, 1, true);
    const ahead = steady.slice(15, 105).reduce((sum, sample, k) => sum + sample.x - bend[k + 15]!.x, 0) / 90;
    expect(Math.abs(ahead)).toBeLessThan(0.5);
  });

  test("a shake as the pen is lifted makes no hook", () => {
    const still = Array.from({ length: 60 }, (_, k) => ({ x: k * 3, y: 0, pressure: 0.5, time: k * 8 }));
    const hooked = [...still, { x: 180, y: 5, pressure: 0.5, time: 480 }];
    const line = stabilise(hooked, 0.5, 1, true);
    const turns = line.slice(1, -1).map((sample, k) => {
      const [before, after] = [line[k]!, line[k + 2]!];
      return Math.abs(Math.atan2(after.y - sample.y, after.x - sample.x) - Math.atan2(sample.y - before.y, sample.x - before.x));
    });
    expect(Math.max(...turns)).toBeLessThan(Math.PI / 6);
  });

  test("times never run back", () => {
    const line = stabilise(shaky, 0.7, 1, true);
    for (let k = 1; k < line.length; k += 1) expect(line[k]!.time).toBeGreaterThan(line[k - 1]!.time);
  });
});
