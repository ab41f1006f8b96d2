// What should be known about the tree, though nothing failed? A small badge; a press lists it.

import { button } from "../../parts/button";
import { element } from "../../parts/element";
import { popover } from "../../parts/popover";
import type { Store } from "../../store";
import { counted } from "../figures";

export function warnings(store: Store): HTMLElement {
  const list = element("ul", { class: "notes" });
  const badge = button({ label: "", icon: "warn", look: "quiet", hint: "What to know about this tree", testId: "warnings", onPress: () => notes.open() });
  badge.classList.add("badge");
  const notes = popover(badge, list);
  const show = (): void => {
    const { tree, read, strokes } = store.known;
    const all = strokes.size === 0 ? [] : [...new Set([...(read?.warnings ?? []), ...(tree?.warnings ?? [])])];
    badge.hidden = all.length === 0;
    badge.querySelector("span")!.textContent = counted(all.length, "note", "notes");
    list.replaceChildren(...all.map((one) => element("li", {}, one)));
  };
  store.on(["tree", "read", "strokes"], show);
  show();
  return badge;
}
