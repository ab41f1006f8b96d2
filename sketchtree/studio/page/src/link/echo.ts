// What does the page show before the program has answered? What the program has, and over it the strokes still on their way.

import type { Changed, SentStroke, Stroke, Strokes } from "../messages";

/** A stroke as the program would send it back. */
export function whole(sent: SentStroke): Stroke {
  return {
    id: sent.id, kind: sent.kind, xy: sent.xy, pressure: sent.pressure ?? null, time: sent.time ?? null, width: sent.width ?? null,
    closed: sent.closed ?? false, view_deg: sent.view_deg ?? 0,
  };
}

/** The drawing as it is shown. Thousands of strokes may be on their way, so only what is touched is done again. */
export class Echo {
  shown: Map<string, Stroke>; // the program's own map when nothing is on its way
  private truth = new Map<string, Stroke>(); // as the program has them
  private pending: Strokes[] = []; // over it, oldest first

  constructor() {
    this.shown = this.truth;
  }

  /** Others are on their way now. `added`: the last is new, the rest is as it was. */
  send(pending: Strokes[], added?: Strokes): void {
    this.pending = pending;
    if (added && this.shown !== this.truth) apply(this.shown, added);
    else this.compose();
  }

  /** The program said what is different; `pending` is what is still on its way. */
  changed(event: Pick<Changed, "since" | "put" | "gone" | "order">, pending: Strokes[]): void {
    const touched = new Set([...event.gone, ...event.put.map((stroke) => stroke.id)]);
    const settled = this.pending.slice(0, Math.max(0, this.pending.length - pending.length));
    const refused = settled.some((request) => ids(request).some((id) => !touched.has(id)));
    this.pending = pending;
    if (event.since === 0) this.truth = new Map();
    update(this.truth, event);
    if (event.order) this.truth = new Map(event.order.flatMap((id) => (this.truth.has(id) ? [[id, this.truth.get(id)!] as const] : [])));
    if (event.since === 0 || event.order || refused || !pending.length || this.shown === this.truth) return this.compose();
    update(this.shown, event);
    for (const request of pending) apply(this.shown, request, touched);
  }

  private compose(): void {
    this.shown = this.pending.length ? new Map(this.truth) : this.truth;
    this.pending.forEach((request) => apply(this.shown, request));
  }
}

function ids(request: Strokes): string[] {
  return [...(request.gone ?? []), ...(request.put ?? []).map((stroke) => stroke.id)];
}

function update(strokes: Map<string, Stroke>, event: Pick<Changed, "put" | "gone">): void {
  for (const id of event.gone) strokes.delete(id);
  for (const stroke of event.put) strokes.set(stroke.id, stroke);
}

/** Do what a request asks; `only`: to these strokes. */
function apply(strokes: Map<string, Stroke>, request: Strokes, only?: Set<string>): void {
  for (const id of request.gone ?? []) if (!only || only.has(id)) strokes.delete(id);
  for (const sent of request.put ?? []) if (!only || only.has(sent.id)) strokes.set(sent.id, whole(sent));
}
