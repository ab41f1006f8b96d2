// How does the growth come from the program? Asked for once the tree has rested; who asks again, or has drawn on, asks for the newest only.

import { ask, Refused } from "../../panel/ask";
import { growthOf, type Growth } from "./growth";

export type Mode = "age" | "full" | "scale";

/** As the program's `Ageing`. */
export interface Ageing {
  mode: Mode;
  bend: number; // degrees; above 0 branches rise
}

export interface Answers {
  waits: () => void;
  made: (growth: Growth, revision: number) => void; // the revision of the drawing that it grows to
  refused: (why: Refused) => void;
}

const NOT_READ = new Refused("The growth that came can't be read.", "Load the page again.");

export class Asking {
  private timer: ReturnType<typeof setTimeout> | null = null;
  private now: AbortController | null = null;

  constructor(private readonly answers: Answers) {}

  get busy(): boolean {
    return this.timer !== null || this.now !== null;
  }

  /** Ask for it after so many milliseconds; what was asked before is not wanted any more. */
  soon(ageing: Ageing, wait: number): void {
    this.cancel();
    this.answers.waits();
    this.timer = setTimeout(() => {
      this.timer = null;
      void this.fetch(ageing);
    }, wait);
  }

  cancel(): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = null;
    this.now?.abort();
    this.now = null;
  }

  private async fetch(ageing: Ageing): Promise<void> {
    const own = (this.now = new AbortController());
    try {
      const answer = await ask("growth", { method: "POST", body: JSON.stringify(ageing), signal: own.signal });
      const growth = growthOf(await answer.arrayBuffer());
      if (this.now !== own) return;
      this.now = null;
      this.answers.made(growth, Number(answer.headers.get("x-revision")));
    } catch (error) {
      if (this.now !== own) return; // nobody waits for it
      this.now = null;
      this.answers.refused(error instanceof Refused ? error : NOT_READ);
    }
  }
}
