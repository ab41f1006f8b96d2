// (stub)

import type { Store } from "../store";

export function mountTools(root: HTMLElement, store: Store): void {
  void root;
  void store;
}
