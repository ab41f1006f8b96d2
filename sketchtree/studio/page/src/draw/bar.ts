// (stub)

import type { Store } from "../store";

export function mountBar(root: HTMLElement, store: Store): void {
  void root;
  void store;
}
