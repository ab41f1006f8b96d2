// How does one begin anew? At once: what was there is one step back.

import { toast } from "../parts/toast";
import type { Store } from "../store";
import { camera } from "./camera";
import { PEN, showEmpty } from "./following";

/** An empty page; what was there is one undo away, and so nothing is asked. */
export function newPage(store: Store): void {
  store.send({ type: "new" });
  store.set("turn", 0);
  store.set("tool", "branch");
  showEmpty(camera);
  store.set("width", PEN);
  if (store.known.strokes.size) toast("A new page.", { action: { label: "Back to the drawing", onPress: () => store.send({ type: "undo" }) } });
}
