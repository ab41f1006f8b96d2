// How many times does what was drawn branch on? Half steps: half of the next generation.

import type { Store } from "../../store";
import { counted, plain } from "../figures";
import { optionSlider } from "./option_slider";

export function generations(store: Store): HTMLElement {
  return optionSlider(store, {
    option: "generations", label: "Generations", hint: "How many times the drawn branches branch on. 0: only what you drew.",
    min: 0, max: 12, step: 0.5, usual: null, rest: 5, auto: "automatic",
    show: (value) => (value === 0 ? "only the drawing" : Number.isInteger(value) ? counted(value, "generation", "generations") : `${plain(value)} generations`),
  });
}
