// What was asked and is not yet answered? Nothing is lost when the line breaks: what changes the drawing waits here, in order, until it can be sent, and
// strokes wait until the program's `Changed` has them.
//
//     add → (offline: waits) → sent → confirmed, away            line breaks: what was not confirmed is to be sent again
//     hello → whole `Changed` → what it has is confirmed; what had been sent before and is not in it was refused; the rest is sent

import type { Changed, Request, Stroke, Strokes } from "../messages";

export interface Waiting {
  key: number; // grows with each
  request: Request;
  sent: boolean; // on this line
}

const PASSING = new Set(["sketching", "glance", "cancel", "readings", "hello"]); // worth nothing later

export class Outbox {
  private waiting: Waiting[] = [];
  private next: number;
  private open = false; // the program answered `Hello`; things can go

  constructor(private readonly send: (request: Request) => void, first = 1) {
    this.next = first;
  }

  /** Strokes that the program has not confirmed, oldest first. */
  get strokes(): Strokes[] {
    return this.waiting.flatMap(({ request }) => (request.type === "strokes" ? [request] : []));
  }

  get size(): number {
    return this.waiting.length;
  }

  /** Send it now, or keep it until that is possible; returns what is kept, if it is. */
  add(request: Request): Waiting | null {
    const passing = PASSING.has(request.type) || (request.type === "hold" && request.live === true);
    if (this.open) this.send(request);
    if (passing || (this.open && request.type !== "strokes")) return null;
    const kept = { key: this.next++, request, sent: this.open };
    this.waiting.push(kept);
    return kept;
  }

  /** What an earlier visit of this page left behind goes first. */
  restore(earlier: Waiting[]): void {
    this.waiting = [...earlier.map((one) => ({ ...one, sent: false })), ...this.waiting];
    this.next = Math.max(this.next, ...earlier.map((one) => one.key + 1));
    if (this.open) this.flush();
  }

  has(key: number): boolean {
    return this.waiting.some((one) => one.key === key);
  }

  /** The oldest that was sent and is not settled. */
  get oldest(): number | null {
    return this.waiting.find((one) => one.sent)?.key ?? null;
  }

  /** The line broke. */
  broke(): void {
    this.open = false;
    this.waiting.forEach((one) => { one.sent = false; });
  }

  /** The program said `Changed`; returns the keys of what is settled by it. `answer`: it is the answer to `Hello`. */
  changed(event: Changed, answer: boolean): number[] {
    const put = new Set(event.put.map((stroke) => stroke.id));
    const whole = event.since === 0;
    const last = whole ? -1 : this.lastConfirmed(event, put);
    const settled = this.waiting.filter((one, at) => at <= last || (whole && this.inWhole(one, put)) || (answer && one.sent));
    this.waiting = this.waiting.filter((one) => !settled.includes(one));
    if (answer) {
      this.open = true;
      this.flush();
    }
    return settled.map((one) => one.key);
  }

  /** The program works in order: with one that is confirmed all sent before it are settled, done or refused. One `Changed` may be of several. */
  private lastConfirmed(event: Changed, put: Set<string>): number {
    const gone = new Set(event.gone);
    if (event.since === event.revision && !put.size && !gone.size) return this.waiting.findIndex(({ sent }) => sent); // nothing had to be done
    let last = this.waiting.findIndex(({ request, sent }) => sent && request.type === "strokes"
      && ((request.put ?? []).some((stroke) => put.has(stroke.id)) || (request.gone ?? []).some((id) => gone.has(id))));
    if (last < 0) return last;
    const came = new Map(event.put.map((stroke) => [stroke.id, stroke]));
    while (last + 1 < this.waiting.length && this.waiting[last + 1]!.sent && isDone(this.waiting[last + 1]!.request, came, gone)) last += 1;
    return last;
  }

  private inWhole({ request }: Waiting, put: Set<string>): boolean {
    if (request.type !== "strokes") return false;
    return (request.put ?? []).every((stroke) => put.has(stroke.id)) && !(request.gone ?? []).some((id) => put.has(id));
  }

  private flush(): void {
    for (const one of this.waiting) {
      if (one.sent) continue;
      this.send(one.request);
      one.sent = true;
    }
    this.waiting = this.waiting.filter((one) => one.request.type === "strokes");
  }
}

/** All that it asked is in what came. */
function isDone(request: Request, came: Map<string, Stroke>, gone: Set<string>): boolean {
  if (request.type !== "strokes") return false;
  return (request.put ?? []).every((stroke) => isSame(stroke.xy, came.get(stroke.id)?.xy)) && (request.gone ?? []).every((id) => gone.has(id));
}

function isSame(sent: number[], came: number[] | undefined): boolean {
  return came?.length === sent.length && sent.every((value, at) => Math.abs(value - came[at]!) < 1e-3);
}
