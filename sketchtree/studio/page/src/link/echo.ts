// What does the page show before the program has answered? What the program has, and over it the strokes still on their way.

import type { SentStroke, Stroke, Strokes } from "../messages";

/** A stroke as the program would send it back. */
export function whole(sent: SentStroke): Stroke {
  return {
    id: sent.id, kind: sent.kind, xy: sent.xy, pressure: sent.pressure ?? null, time: sent.time ?? null, width: sent.width ?? null,
    closed: sent.closed ?? false, view_deg: sent.view_deg ?? 0,
  };
}

/** Do to these strokes what a request asks. */
export function echo(strokes: Map<string, Stroke>, request: Strokes): void {
  for (const id of request.gone ?? []) strokes.delete(id);
  for (const sent of request.put ?? []) strokes.set(sent.id, whole(sent));
}

/** What is shown: a new map where something is on its way, the program's own where nothing is. */
export function shown(truth: Map<string, Stroke>, pending: Strokes[]): Map<string, Stroke> {
  if (!pending.length) return truth;
  const all = new Map(truth);
  pending.forEach((request) => echo(all, request));
  return all;
}
