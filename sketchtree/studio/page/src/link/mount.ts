// (stub)

import type { Store } from "../store";

export function mountLink(store: Store): void {
  void store;
}
