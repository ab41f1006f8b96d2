// How far is something that was asked for by HTTP? Told over the line, under an id that is the page's own.

import type { Store } from "../store";

let asked = 0;

export class Pending {
  readonly id = `${Math.random().toString(36).slice(2, 10)}-${asked++}`;
  private readonly leave: () => void;

  /** `hears` is told, 0-1, until it has ended. */
  constructor(store: Store, hears: (done: number, stage: string) => void) {
    this.leave = store.on("making", () => {
      const told = store.known.making;
      if (told?.id === this.id) hears(told.done, told.stage);
    });
  }

  end(): void {
    this.leave();
  }
}
