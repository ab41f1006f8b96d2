// How densely do branches bear others? Times what the template's species does.

import type { Store } from "../../store";
import { plain } from "../figures";
import { optionSlider } from "./option_slider";

export function density(store: Store): HTMLElement {
  return optionSlider(store, {
    option: "density", label: "Density", hint: "How many twigs grow along a branch, beside what is usual for the species.",
    min: 0.1, max: 3, step: 0.05, usual: 1, rest: 1, show: (value) => `× ${plain(value)}`,
  });
}
