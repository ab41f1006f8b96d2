// Is the tree flat, as an espalier on a wall is?

import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";

export function planar(store: Store): HTMLElement {
  const made = toggle({
    label: "Flat, as on a wall", on: false, testId: "planar", hint: "An espalier or a fan: drawn branches stay near the page.",
    onSwitch: (on) => store.send({ type: "choose", options: { planar: on } }),
  });
  store.on("options", () => made.set(store.known.options?.planar ?? false));
  return made.root;
}
