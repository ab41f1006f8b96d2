// Does the tree grow on until its crown is evenly full?

import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";

export function fill(store: Store): HTMLElement {
  const made = toggle({
    label: "Fill the crown", on: false, testId: "fill", hint: "Grow on until the crown is evenly full. Takes longer.",
    onSwitch: (on) => store.send({ type: "choose", options: { fill: on } }),
  });
  store.on("options", () => made.set(store.known.options?.fill ?? false));
  return made.root;
}
