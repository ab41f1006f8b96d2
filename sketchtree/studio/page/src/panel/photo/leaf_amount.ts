// How large, and how many, are the leaves of a photo's tree? Times what it takes to cover the foliage.

import { element } from "../../parts/element";
import type { Store } from "../../store";
import { plain } from "../figures";
import { optionSlider } from "../grow/option_slider";

const LOOK = { min: 0.25, max: 3, step: 0.05, usual: 1, rest: 1, show: (value: number) => `× ${plain(value)}` };

export function leafAmount(store: Store): HTMLElement {
  return element("div", {},
    optionSlider(store, { ...LOOK, option: "leaf_size", label: "Leaf size", hint: "Beside what covers the photo's foliage." }),
    optionSlider(store, { ...LOOK, option: "leaf_density", label: "Leaf density", hint: "How many leaves, beside what covers the photo's foliage." }));
}
