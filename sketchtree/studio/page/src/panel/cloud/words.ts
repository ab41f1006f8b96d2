// What is said of the points behind the drawing? Words alone: no element is touched.

import type { Growing, Points } from "../../messages";

export const HOW = "Draw over the points: limbs take their depth from them.";
const TRACES = "Tracing the tree …";
const READY = "Traced from the points.";
const STOPPED = "Stopped.";

/** One sentence. */
export function said(points: Points | null, growing: Growing | null): string {
  if (!points?.traced) return HOW;
  switch (growing?.state) {
    case "ready": return READY;
    case "stopped": return STOPPED;
    case "failed": return growing.remark ?? "";
    default: return TRACES;
  }
}

/** How many, and how high: for the part at the side. */
export function measured(count: number, height: number): string {
  return `${count.toLocaleString("en")} points, ${height < 10 ? height.toFixed(2) : height.toFixed(1)} m high`;
}
