// The tree in 3D (stub).

import type { Store } from "../store";

export function mountTree(root: HTMLElement, store: Store): void {
  void root;
  void store;
}
