// What is said while a tree is taken from scribbles?

import { expect, test } from "vitest";
import type { Growing, Matte, Trunks } from "../src/messages";
import { sides } from "../src/draw/trunk/scribbles";
import { BEGIN, BEGIN_MOUSE, passedOver, said } from "../src/panel/trunk/words";

const trunks = (state: Trunks["state"], remark = ""): Trunks => ({ type: "trunks", revision: 5, state, trees: [], vertices: [], parts: [], contour: [], size: [], remark });
const growing = (state: Growing["state"], remark = ""): Growing => ({ type: "growing", revision: 5, state, stage: "", done: 0, remark });
const matte = (revision: number): Matte => ({ type: "matte", revision, png: "" });
const both = { tree: true, beside: true };

test("what is painted into the matte is on neither side", () => {
  expect(sides([{ kind: "matte_add" }, { kind: "branch" }])).toEqual({ tree: false, beside: false });
  expect(sides([{ kind: "background" }, { kind: "foreground" }])).toEqual(both);
});

test("what to scribble comes before anything the program says", () => {
  const failed = { trunks: trunks("failed"), growing: growing("failed", "The drawing needs scribbles."), matte: null };
  expect(said({ tree: false, beside: false }, failed)).toBe(BEGIN);
  expect(said({ tree: false, beside: false }, failed, BEGIN_MOUSE)).toBe("Left button: on the tree. Right button: on what is not tree.");
  expect(said({ tree: true, beside: false }, failed)).toBe("Now on what is not tree: sky, ground, what stands behind.");
  expect(said({ tree: false, beside: true }, failed)).toBe("Now on the tree: along the trunk and a few limbs.");
});

test("it is said which step is at work", () => {
  expect(said(both, { trunks: trunks("waits"), growing: growing("waits"), matte: null })).toBe("It begins in a moment.");
  expect(said(both, { trunks: trunks("works"), growing: growing("grows"), matte: matte(4) })).toBe("Finding the tree …");
  expect(said(both, { trunks: trunks("works"), growing: growing("grows"), matte: matte(5) })).toBe("Finding the trunk …");
  expect(said(both, { trunks: trunks("ready"), growing: growing("grows"), matte: matte(5) })).toBe("Growing the tree …");
  expect(said(both, { trunks: trunks("ready"), growing: growing("ready"), matte: matte(5) })).toBe("Grown from the scribbles.");
  expect(said(both, { trunks: trunks("works"), growing: growing("stopped"), matte: null })).toBe("Stopped.");
});

test("a failure is told in the program's words", () => {
  expect(said(both, { trunks: trunks("failed", "why"), growing: growing("failed", "The matte is empty. Scribble more."), matte: null })).toBe("The matte is empty. Scribble more.");
});

test("edits that find nothing on the contour are counted", () => {
  expect(passedOver({ trunks: trunks("ready", "A loop was cut.") })).toBe("");
  expect(passedOver({ trunks: trunks("ready", "`remove` (3, 4): no vertex is there. It was passed over.") })).toBe("One of them finds nothing on this contour.");
  expect(passedOver({ trunks: trunks("ready", "a. It was passed over. b. It was passed over.") })).toBe("2 of them find nothing on this contour.");
  expect(passedOver({ trunks: trunks("works", "It was passed over.") })).toBe("");
});
