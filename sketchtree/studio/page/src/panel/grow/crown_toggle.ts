// Does a drawn crown outline bound the tree?

import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";

export function crownToggle(store: Store): HTMLElement {
  const made = toggle({
    label: "Stay inside the crown", on: true, testId: "crown-toggle",
    hint: "Branches end at the crown outline you drew (C draws one). Off: the outline is left out.",
    onSwitch: (on) => store.send({ type: "choose", options: { crown: on ? "auto" : "off" } }),
  });
  store.on("options", () => made.set(store.known.options?.crown !== "off"));
  return made.root;
}
