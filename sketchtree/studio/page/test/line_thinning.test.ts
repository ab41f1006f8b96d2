import { describe, expect, test } from "vitest";
import type { Sample } from "../src/draw/line/samples";
import { distanceToSpan, thin } from "../src/draw/line/thinning";

const curve = (count: number, place: (share: number) => [number, number]): Sample[] => Array.from({ length: count }, (_, k) => {
  const [x, y] = place(k / (count - 1));
  return { x, y, pressure: 0.5, time: k * 4 };
});

const away = (sample: Sample, kept: Sample[]): number => Math.min(...kept.slice(1).map((to, k) => distanceToSpan(sample, kept[k]!, to)));
const farthest = (line: Sample[], kept: Sample[]): number => Math.max(...line.map((sample) => away(sample, kept)));

const bow = curve(600, (share) => [400 * share, 150 * Math.sin(2 * Math.PI * share)]);

describe("thinning", () => {
  test("leaves the path by no more than half a pixel", () => {
    for (const pixel of [0.5, 1, 4]) expect(farthest(bow, thin(bow, pixel)) * pixel).toBeLessThanOrEqual(0.5);
  });

  test("leaves 20 to 200 points of a line of the hand", () => {
    expect(thin(bow, 1).length).toBeGreaterThanOrEqual(20);
    expect(thin(bow, 1).length).toBeLessThanOrEqual(200);
  });

  test("keeps both ends", () => {
    const kept = thin(bow, 1);
    expect(kept[0]).toBe(bow[0]);
    expect(kept.at(-1)).toBe(bow.at(-1));
  });

  test("keeps some points of a straight line, for its width", () => {
    expect(thin(curve(500, (share) => [300 * share, 0]), 1).length).toBeGreaterThanOrEqual(20);
  });

  test("of a scribble without end no more than 200 points stay", () => {
    const scribble = curve(6000, (share) => [200 * Math.sin(331 * share), 200 * Math.cos(457 * share)]);
    expect(thin(scribble, 1).length).toBeLessThanOrEqual(200);
  });

  test("lines of one or two points stay as they are", () => {
    expect(thin(bow.slice(0, 1), 1)).toEqual(bow.slice(0, 1));
    expect(thin(bow.slice(0, 2), 1)).toEqual(bow.slice(0, 2));
  });
});
