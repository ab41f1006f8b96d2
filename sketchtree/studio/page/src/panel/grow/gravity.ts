// How far do grown branches bend under their own weight? What was drawn never moves.

import type { Store } from "../../store";
import { plain } from "../figures";
import { optionSlider } from "./option_slider";

export function gravity(store: Store): HTMLElement {
  return optionSlider(store, {
    option: "gravity", label: "Gravity", hint: "How far grown branches bend under their own weight; 1 is what physics says. Drawn branches stay as drawn.",
    min: 0, max: 5, step: 0.1, usual: 0, rest: 0, show: (value) => (value === 0 ? "off" : `${plain(value)} × weight`),
  });
}
