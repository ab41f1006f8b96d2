// What was done to the contour by hand? A row each, with a button that takes it back; and one that takes all back.

import { count, type Edits, NO_EDITS } from "../../draw/trunk/edits";
import { button } from "../../parts/button";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import { icon, type IconName } from "../../style/icons";
import { passedOver } from "./words";

const ROWS: { of: keyof Edits; words: string; icon: IconName }[] = [
  { of: "remove", words: "Point removed", icon: "minus" }, { of: "add", words: "Point added", icon: "plus" }, { of: "merge", words: "Points merged", icon: "points" },
];

export function contourByHand(store: Store): HTMLElement {
  const list = element("ul", { class: "edits", testId: "trunk-edits", aria: { label: "Edits of the contour" } });
  const all = button({ label: "Take all back", icon: "reset", testId: "trunk-back", hint: "The contour is as it was found", onPress: () => store.chooseTrunk(NO_EDITS, "edits of the contour") });
  const note = element("p", { class: "hint", testId: "trunk-passed-over" });
  const root = element("div", { class: "trunk-by-hand" }, element("p", { class: "hint" }, "Contour, by hand"), list, note, element("div", { class: "buttons" }, all));
  store.on("trunks", () => { note.textContent = passedOver(store.known); });
  const show = (): void => {
    const { trunk } = store.known;
    root.hidden = !trunk || count(trunk) === 0;
    if (!trunk || root.hidden) return list.replaceChildren();
    list.replaceChildren(...ROWS.flatMap(({ of, words, icon }) => trunk[of].map((point, at) => row(store, of, at, `${words} at ${where(point)}`, icon))));
  };
  store.on("trunk", show);
  show();
  return root;
}

function where(point: Edits["add"][number] | Edits["merge"][number]): string {
  const [x, y] = (Array.isArray(point[0]) ? point[0] : point) as [number, number];
  return `${Math.round(x)}, ${Math.round(y)}`;
}

function row(store: Store, of: keyof Edits, at: number, words: string, name: IconName): HTMLElement {
  const back = button({
    label: `Take back: ${words}`, icon: "close", iconOnly: true, look: "quiet",
    onPress: () => { if (store.known.trunk) store.chooseTrunk({ [of]: store.known.trunk[of].filter((_, other) => other !== at) }, `take back point ${count(store.known.trunk)}`); },
  });
  back.classList.add("tiny");
  return element("li", {}, element("span", { class: "edit" }, icon(name), element("span", { class: "where" }, words)), back);
}
