// What is said while a photo is marked, and what does the large button do?

import { expect, test } from "vitest";
import type { Growing, Traced } from "../src/messages";
import { HOW, pressed, said } from "../src/panel/photo/words";

const traced = (more: Partial<Traced> = {}): Traced => ({ type: "traced", revision: 1, trees: [], remark: "", waits: false, ...more });
const growing = (state: Growing["state"], remark = ""): Growing => ({ type: "growing", revision: 1, state, stage: "", done: 0, remark });

test("what is missing is said first, then what is being done", () => {
  expect(said(null, null)).toBe(HOW);
  expect(said(traced({ remark: "Outline the crown." }), growing("grows"))).toBe("Outline the crown.");
  expect(said(traced({ waits: true }), growing("waits"))).toBe("Looking for the foliage …");
  expect(said(traced(), growing("grows"))).toBe("Growing the tree …");
  expect(said(traced(), growing("failed", "There is no foliage."))).toBe("There is no foliage.");
});

test("strokes that nobody drew, and that may be wrong, are to be looked at", () => {
  expect(said(traced(), growing("grows"), HOW, "the trunk is hardly seen")).toBe("Look at these lines: the trunk is hardly seen.");
});

test("the button grows the tree, stops what is being done, or is not there", () => {
  expect(pressed(null, null)).toBe("nothing");
  expect(pressed(traced(), growing("ready"))).toBe("nothing");
  expect(["waits", "stopped", "failed"].map((state) => pressed(traced(), growing(state as Growing["state"])))).toEqual(["grow", "grow", "grow"]);
  expect(pressed(traced(), growing("grows"))).toBe("stop");
  expect(pressed(traced({ waits: true }), growing("waits"))).toBe("stop");
});
