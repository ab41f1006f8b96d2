// How long did it take from the pen's lifting (or a slider's move) to the new tree? Told by requests that change the document and the frames that answer.

import type { Request, Tree } from "../../messages";

const CHANGES: ReadonlySet<Request["type"]> = new Set([
  "strokes", "choose", "hold", "flip", "mirror", "lock", "delete", "settle", "pick", "undo", "redo", "new", "open", "usetraced", "propose",
]);

export class RoundTrip {
  last: number | null = null; // milliseconds
  private asked: { at: number; revision: number } | null = null;

  constructor(private readonly now: () => number = () => performance.now()) {}

  /** A request went out while the page knew this revision. */
  sent(request: Request, revision: number): void {
    if (!CHANGES.has(request.type) || (request.type === "hold" && request.live)) return;
    this.asked = { at: this.now(), revision };
  }

  /** A frame came: true where it answers what was asked last. */
  came(tree: Pick<Tree, "phase" | "revision">): boolean {
    if (!this.asked || tree.phase === "glance" || tree.phase === "photo" || tree.revision <= this.asked.revision) return false;
    this.last = this.now() - this.asked.at;
    this.asked = null;
    return true;
  }
}
