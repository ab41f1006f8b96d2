// Which of the many trees that fit? The same number gives the same tree; the die throws another one.

import { button } from "../../parts/button";
import { element, freshId } from "../../parts/element";
import type { Store } from "../../store";

const MOST = 2 ** 31 - 1;
const THROWN = 10_000; // numbers one can remember

export function seed(store: Store): HTMLElement {
  const id = freshId("seed");
  const field = element("input", { class: "field figure", id, testId: "seed", title: "The same number always grows the same tree" });
  field.type = "number";
  field.min = "0";
  field.max = String(MOST);
  field.step = "1";
  field.inputMode = "numeric";
  const label = element("label", { class: "row-label" }, "Variation");
  label.htmlFor = id;
  const choose = (value: number): void => {
    field.value = String(value);
    store.send({ type: "choose", options: { seed: value } });
  };
  field.addEventListener("change", () => {
    const typed = field.valueAsNumber;
    choose(Number.isFinite(typed) ? Math.min(MOST, Math.max(0, Math.round(typed))) : (store.known.options?.seed ?? 0));
  });
  field.addEventListener("keydown", (event) => event.stopPropagation());
  const roll = button({
    label: "Another variation", icon: "dice", iconOnly: true, hint: "Grow another variation. What you drew and did by hand stays.", testId: "seed-roll",
    onPress: () => choose(Math.floor(Math.random() * THROWN)),
  });
  store.on("options", () => {
    if (store.known.options && document.activeElement !== field) field.value = String(store.known.options.seed);
  });
  return element("div", { class: "row" }, label, element("span", { class: "with-unit" }, field, roll));
}
