// A slider that says how the trunk is taken from its matte.

import type { Trunk } from "../../messages";
import type { Store } from "../../store";
import { heldSlider } from "../held_slider";

export interface TrunkLook {
  of: "vertices" | "gap" | "levels";
  label: string;
  hint: string;
  min: number;
  max: number;
  step: number;
  usual: number | null; // what a double click goes back to
  knob: (value: number | null) => number; // where the knob stands for a value
  value: (knob: number) => number;
  show: (value: number | null) => string;
}

export function trunkSlider(store: Store, look: TrunkLook): HTMLElement {
  return heldSlider<number | null>(store, ["trunk", "trunks"], {
    ...look, testId: `trunk-${look.of}`, back: `back to ${look.show(look.usual)}`, now: () => store.known.trunk?.[look.of],
    say: (value) => store.chooseTrunk({ [look.of]: value } as Partial<Trunk>, look.label.toLowerCase()),
  });
}
