import { describe, expect, it } from "vitest";
import type { Tree } from "../src/messages";
import { RoundTrip } from "../src/panel/status/round_trip";
import { doing, figures } from "../src/panel/status/words";

const tree = {
  segments: 1240, drawn: 240, leaves: 9000, triangles: [40_000, 18_000], height: 8.24,
} as Tree;

describe("the figures of the status line", () => {
  it("say height, segments, leaves, triangles, template and time", () => {
    expect(figures(tree, "English oak", 84).map((one) => one.value)).toEqual([
      "8.2 m tall", "1\u202f240 segments", "9\u202f000 leaves", "58\u202f000 triangles", "English oak", "84 ms",
    ]);
  });

  it("tell drawn from grown", () => {
    expect(figures(tree, null, null).find((one) => one.name === "segments")!.title).toBe("Pieces of branch: 240 drawn, 1\u202f000 grown.");
  });
});

describe("what the program is at", () => {
  it("is nothing, a stage, or that strokes over points would wait", () => {
    expect(doing({ state: "idle", stage: "" }, null)).toBe("");
    expect(doing({ state: "working", stage: "mesh" }, { on: true })).toBe("Making the wood");
    expect(doing({ state: "idle", stage: "" }, { on: true })).toBe("Getting ready for strokes over points");
    expect(doing({ state: "working", stage: "infer" }, { on: true })).toBe("Getting ready to find depths, only this once");
    expect(doing({ state: "working", stage: "infer" }, { on: false })).toBe("Finding the depths");
  });
});

describe("a round trip", () => {
  it("lasts from the last change to the first frame that answers it", () => {
    let now = 0;
    const trip = new RoundTrip(() => now);
    trip.sent({ type: "strokes", label: "branch" }, 4);
    now = 60;
    expect(trip.came({ phase: "quick", revision: 4 })).toBe(false); // an older change's
    now = 84;
    expect(trip.came({ phase: "quick", revision: 5 })).toBe(true);
    expect(trip.last).toBe(84);
    now = 500;
    expect(trip.came({ phase: "full", revision: 5 })).toBe(false);
    expect(trip.last).toBe(84);
  });

  it("is not started by what changes nothing", () => {
    const trip = new RoundTrip(() => 0);
    trip.sent({ type: "glance", template: "oak" }, 1);
    trip.sent({ type: "hold", limb: "1", share: 1, depth: 2, live: true }, 1);
    expect(trip.came({ phase: "quick", revision: 2 })).toBe(false);
  });
});
