// What is said while a photo is marked, and what its one large button does? Words alone: no element is touched.

import type { Growing, Traced } from "../../messages";

export const HOW = "Left button: the crown. Right button: a branch.";
export const HOW_BY_HAND = "Outline the crown, then draw along the trunk."; // a pen or a finger has one button
const LOOKING = "Looking for the foliage …";
const GROWS = "Growing the tree …";
const SOON = "It grows in a moment.";
const READY = "Grown from the photo.";
const STOPPED = "Stopped.";

/** One sentence; `how` says what to do, `doubt` what speaks against strokes that were proposed. */
export function said(traced: Traced | null, growing: Growing | null, how: string = HOW, doubt = ""): string {
  if (doubt) return `Look at these lines: ${doubt}.`;
  if (traced?.remark) return traced.remark;
  if (traced?.waits) return LOOKING;
  switch (growing?.state) {
    case "waits": return traced?.trees.length ? SOON : how;
    case "grows": return GROWS;
    case "ready": return READY;
    case "stopped": return STOPPED;
    case "failed": return growing.remark;
    default: return how;
  }
}

export type Press = "grow" | "stop" | "nothing"; // the tree is as it should be, or there is nothing to grow

/** What a press would do. */
export function pressed(traced: Traced | null, growing: Growing | null): Press {
  if (!growing || growing.state === "none" || growing.state === "ready") return "nothing";
  return growing.state === "grows" || traced?.waits ? "stop" : "grow";
}
