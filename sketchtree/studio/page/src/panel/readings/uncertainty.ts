// Are limbs coloured by how sure their depth is?

import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";

export function uncertainty(store: Store): HTMLElement {
  const made = toggle({
    label: "Show what is uncertain", on: store.ui.uncertainty, testId: "uncertainty",
    hint: "Colours the drawn branches by how sure their depth is: where it is a guess, drag it, flip it or lock it.",
    onSwitch: (on) => store.set("uncertainty", on),
  });
  store.on("uncertainty", () => made.set(store.ui.uncertainty));
  return made.root;
}
