// What is there to choose from? Told when one of the lists of `Welcome` is another; that a file was saved says nothing of the others.

import type { Welcome } from "../messages";
import type { Store } from "../store";

export function onList<T extends object>(store: Store, pick: (welcome: Welcome) => T, listener: (list: T) => void): void {
  let before: T | null = null;
  store.on("welcome", () => {
    const list = store.known.welcome ? pick(store.known.welcome) : null;
    if (list === null || list === before) return;
    before = list;
    listener(list);
  });
}
