// The controls of how a tree grows: its mode, and how its branches bend. What is chosen is the page's own, wherever these stand.

import { choice } from "../../parts/choice";
import { element } from "../../parts/element";
import { slider } from "../../parts/slider";
import type { Store } from "../../store";
import { BEND, bendInWords, caught, MODES, type Ageing, type Mode } from "./ageing";

export function howItGrows(store: Store, testId: string, showLabel = false): HTMLElement {
  const put = (part: Partial<Ageing>): void => store.set("ageing", { ...store.ui.ageing, ...part });
  const mode = choice<Mode>({ label: "Mode", showLabel, value: store.ui.ageing.mode, options: MODES, testId: `${testId}-mode`, onPick: (value) => put({ mode: value }) });
  const bend = slider({
    label: "Branches bend", min: -BEND, max: BEND, step: 1, value: store.ui.ageing.bend, testId: `${testId}-bend`, hint: "As they get heavy, or seek the light",
    show: (degrees) => bendInWords(caught(degrees)), onInput: (degrees) => put({ bend: caught(degrees) }), reset: { label: "straight on", onReset: () => put({ bend: 0 }) },
  });
  store.on("ageing", () => {
    mode.set(store.ui.ageing.mode);
    if (caught(bend.input.valueAsNumber) !== store.ui.ageing.bend) bend.set(store.ui.ageing.bend);
  });
  return element("div", { class: "tree-growth-how" }, mode.root, bend.root);
}
