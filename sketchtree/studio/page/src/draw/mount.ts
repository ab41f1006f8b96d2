// (stub)

import type { Store } from "../store";

export function mountDraw(root: HTMLElement, store: Store): void {
  void root;
  void store;
}
