// How does the growth come from the program? Asked for once the tree has rested; who asks again, or has drawn on, asks for the newest only.

import { ask, Refused } from "../../panel/ask";
import { Pending } from "../../panel/pending";
import type { Store } from "../../store";
import { growthOf, type Growth } from "./growth";

export interface Answers {
  waits: (done: number) => void; // and how far it is, 0-1
  made: (growth: Growth, revision: number) => void; // the revision of the drawing that it grows to
  refused: (why: Refused) => void;
}

const NOT_READ = new Refused("The growth that came can't be read.", "Load the page again.");

export class Asking {
  private timer: ReturnType<typeof setTimeout> | null = null;
  private now: AbortController | null = null;

  constructor(private readonly store: Store, private readonly answers: Answers) {}

  get busy(): boolean {
    return this.timer !== null || this.now !== null;
  }

  /** Ask for it after so many milliseconds; what was asked before is not wanted any more. */
  soon(wait: number): void {
    this.cancel();
    this.answers.waits(0);
    this.timer = setTimeout(() => {
      this.timer = null;
      void this.fetch();
    }, wait);
  }

  cancel(): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = null;
    this.now?.abort();
    this.now = null;
  }

  private async fetch(): Promise<void> {
    const own = (this.now = new AbortController());
    const pending = new Pending(this.store, (done) => this.answers.waits(done));
    try {
      const wish = { ...this.store.ui.ageing, tree: this.store.known.photoTree ? "photo" : "drawn", id: pending.id };
      const answer = await ask("growth", { method: "POST", body: JSON.stringify(wish), signal: own.signal });
      const growth = growthOf(await answer.arrayBuffer());
      if (this.now !== own) return;
      this.now = null;
      this.answers.made(growth, Number(answer.headers.get("x-revision")));
    } catch (error) {
      if (this.now !== own) return; // nobody waits for it
      this.now = null;
      this.answers.refused(error instanceof Refused ? error : NOT_READ);
    } finally {
      pending.end();
    }
  }
}
