import { describe, expect, it } from "vitest";
import type { Stroke } from "../src/messages";
import { differing } from "../src/panel/readings/differing";
import { Fresh } from "../src/panel/readings/fresh";
import { twoViews } from "../src/panel/readings/two_views";
import { Store } from "../src/store";

const room = { width: 100, height: 100, margin: 10 };

describe("two views of a tree", () => {
  it("have one scale, and lie in the middle of their rooms", () => {
    const lines = twoViews([[0, 100, 0, 0, 0, 0], [0, 50, 0, 30, 20, 10]], room, room);
    expect(lines.front[0]).toEqual([38, 90, 38, 10]);
    expect(lines.front[1]).toEqual([38, 50, 62, 26]);
    expect(lines.above[1]).toEqual([38, 46, 62, 54]); // towards the viewer is down
  });

  it("keep what is deep inside their rooms", () => {
    const { above } = twoViews([[0, 0, -500, 10, 10, 500]], room, room);
    expect(Math.min(...above[0]!)).toBeGreaterThanOrEqual(10);
    expect(Math.max(...above[0]!)).toBeLessThanOrEqual(90);
  });

  it("survive a tree of one point and of none", () => {
    expect(twoViews([[5, 5, 5]], room, room).front[0]).toEqual([50, 50]);
    expect(twoViews([], room, room)).toEqual({ front: [], above: [] });
  });
});

describe("what differs between two readings", () => {
  const trunk = [0, 100, 0, 0, 0, 0];

  it("is what lies at other depths", () => {
    expect(differing([trunk, [0, 50, 0, 30, 20, 10]], [trunk, [0, 50, 0, 30, 20, -10]])).toEqual([false, true]);
  });

  it("is not what a line's width would hide", () => {
    expect(differing([trunk, [0, 50, 0, 30, 20, 10]], [trunk, [0, 50, 0, 30, 20, 8]])).toEqual([false, false]);
  });

  it("is unknown where the limbs are not the same", () => {
    expect(differing([trunk], [trunk, trunk])).toEqual([false]);
  });
});

describe("readings", () => {
  const drawn = (): Store => {
    const store = new Store();
    store.known.strokes = new Map([["a", { id: "a" } as Stroke]]);
    store.known.options = { template: "auto", season: "summer" } as Store["known"]["options"];
    return store;
  };

  it("stay true in another season", () => {
    const { known } = drawn();
    const fresh = new Fresh();
    fresh.keep(known);
    known.options = { ...known.options!, season: "autumn", seed: 7 };
    expect(fresh.holds(known)).toBe(true);
  });

  it("are stale after another stroke, another edit, another template", () => {
    for (const change of [
      (known: Store["known"]) => known.strokes.set("b", { id: "b" } as Stroke),
      (known: Store["known"]) => known.strokes.set("a", { id: "a" } as Stroke), // moved
      (known: Store["known"]) => { known.edits = [{ what: "held", limb: "1", share: [], depth: [] }]; },
      (known: Store["known"]) => { known.options = { ...known.options!, template: "oak" }; },
    ]) {
      const { known } = drawn();
      const fresh = new Fresh();
      fresh.keep(known);
      change(known);
      expect(fresh.holds(known)).toBe(false);
    }
  });
});
