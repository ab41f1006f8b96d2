// How much do grown twigs seek the light, and stay shut in the shade?

import type { Store } from "../../store";
import { percent } from "../figures";
import { optionSlider } from "./option_slider";

export function light(store: Store): HTMLElement {
  return optionSlider(store, {
    option: "light", label: "Light", hint: "How much grown twigs turn to the light, and how few of them grow in the shade.",
    min: 0, max: 1, step: 0.05, usual: 0, rest: 0, show: (value) => (value === 0 ? "off" : percent(value)),
  });
}
