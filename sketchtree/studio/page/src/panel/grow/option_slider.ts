// A slider that is one of the tree's options.

import type { Store } from "../../store";
import { heldSlider } from "../held_slider";

export interface OptionLook {
  option: "generations" | "density" | "gravity" | "light" | "leaf_size" | "leaf_density";
  label: string;
  hint: string;
  min: number;
  max: number;
  step: number;
  usual: number | null; // what a double click goes back to; null: what the template says
  rest: number; // where the knob stands then
  show: (value: number) => string;
  auto?: string; // what is shown where the option is null
}

export function optionSlider(store: Store, look: OptionLook): HTMLElement {
  return heldSlider<number | null>(store, ["options"], {
    ...look, testId: look.option, back: look.usual === null ? "back to automatic" : `back to ${look.show(look.usual)}`,
    knob: (value) => value ?? look.rest, value: (knob) => knob, show: (value) => (value === null ? (look.auto ?? "") : look.show(value)),
    now: () => store.known.options?.[look.option], say: (value) => store.send({ type: "choose", options: { [look.option]: value } }),
  });
}
