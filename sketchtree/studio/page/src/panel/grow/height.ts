// How tall is the tree? Metres, or nothing: what is usual for the template.

import { element, freshId } from "../../parts/element";
import type { Store } from "../../store";
import { plain } from "../figures";

const LEAST = 0.05;
const MOST = 1000;

export function height(store: Store): HTMLElement {
  const id = freshId("height");
  const title = "Height of the tree in metres. Leave it empty for what is usual for the template.";
  const field = element("input", { class: "field figure", id, testId: "height", title });
  field.type = "number";
  field.min = String(LEAST);
  field.max = String(MOST);
  field.step = "any";
  field.inputMode = "decimal";
  const label = element("label", { class: "row-label" }, "Height");
  label.htmlFor = id;
  const follow = (): void => {
    const { options, tree } = store.known;
    if (tree?.phase !== "quick") field.placeholder = tree && tree.height > 0 ? `${plain(tree.height, 1)} (auto)` : "auto";
    if (options && document.activeElement !== field) field.value = options.height === null ? "" : plain(options.height, 2);
  };
  field.addEventListener("change", () => {
    const typed = field.valueAsNumber;
    const metres = Number.isFinite(typed) ? Math.min(MOST, Math.max(LEAST, typed)) : null;
    field.value = metres === null ? "" : plain(metres, 2);
    store.send({ type: "choose", options: { height: metres } });
  });
  field.addEventListener("keydown", (event) => event.stopPropagation());
  store.on(["options", "tree"], follow);
  return element("div", { class: "row" }, label, element("span", { class: "with-unit" }, field, "m"));
}
