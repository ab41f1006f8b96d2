import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { linger } from "../src/panel/linger";
import { pace } from "../src/panel/pace";

beforeEach(() => { vi.useFakeTimers(); });
afterEach(() => { vi.useRealTimers(); });

describe("a slider's pace", () => {
  it("speaks at once, then at most ten times a second, and says the last word", () => {
    const said: number[] = [];
    const slider = pace<number>(100, (value) => said.push(value), () => Date.now());
    for (let i = 0; i <= 50; i++) { slider.say(i); vi.advanceTimersByTime(10); }
    expect(said[0]).toBe(0);
    expect(said.length).toBeLessThanOrEqual(6);
    vi.advanceTimersByTime(100);
    expect(said.at(-1)).toBe(50);
  });

  it("says what waits when the slider is let go, and nothing twice", () => {
    const said: number[] = [];
    const slider = pace<number>(100, (value) => said.push(value), () => Date.now());
    slider.say(1);
    slider.say(2);
    slider.flush();
    vi.advanceTimersByTime(500);
    expect(said).toEqual([1, 2]);
  });

  it("forgets what waits when it is dropped", () => {
    const said: number[] = [];
    const slider = pace<number>(100, (value) => said.push(value), () => Date.now());
    slider.say(1);
    slider.say(2);
    slider.drop();
    vi.advanceTimersByTime(500);
    expect(said).toEqual([1]);
  });
});

describe("a pointer that lingers", () => {
  it("is told after its delay; one that passes over is not, and neither is its leaving", () => {
    const told: string[] = [];
    const pointer = linger<string>(250, (what) => told.push(what), () => told.push("away"));
    pointer.over("oak");
    vi.advanceTimersByTime(100);
    pointer.away();
    vi.advanceTimersByTime(500);
    expect(told).toEqual([]);
    pointer.over("oak");
    vi.advanceTimersByTime(250);
    pointer.away();
    expect(told).toEqual(["oak", "away"]);
  });

  it("goes from one to the next without leaving between", () => {
    const told: string[] = [];
    const pointer = linger<string>(250, (what) => told.push(what), () => told.push("away"));
    pointer.over("oak");
    vi.advanceTimersByTime(250);
    pointer.pass(); // between the two
    pointer.over("elm");
    vi.advanceTimersByTime(250);
    expect(told).toEqual(["oak", "elm"]);
  });
});
