// What does one do here? A card on the page that says it in two sentences, and goes with the first line drawn. It can be called again.

import { button } from "../../parts/button";
import { element } from "../../parts/element";
import { icon } from "../../style/icons";
import type { Store } from "../../store";

const KEY = "sketchtree-hint-seen";

export interface Hint {
  root: HTMLElement;
  show: () => void;
}

export function hintCard(store: Store, newPage: () => void): Hint {
  const close = button({ label: "Close the hint", icon: "close", iconOnly: true, look: "quiet", testId: "hint-close", onPress: () => away() });
  const words = element("p", {}, element("strong", {}, "Draw a trunk, then branches."), element("span", {}, " The tree follows."));
  const fresh = button({ label: "New page", testId: "hint-new", onPress: newPage });
  const root = element("div", { class: "hint-card", role: "note", testId: "hint" }, icon("branch"), words, fresh, close);
  let called = false;
  let before: number | null = null; // strokes there were when it appeared
  const away = (): void => {
    root.hidden = true;
    called = false;
    localStorage.setItem(KEY, "seen");
  };
  const show = (): void => {
    before = store.known.strokes.size;
    root.hidden = before === 0; // the empty page says it itself
  };
  root.hidden = true;
  store.on(["welcome", "strokes", "undo", "underlay", "cloud"], () => {
    const { strokes, undo, welcome, underlay, cloud } = store.known;
    if (!welcome || strokes.size === 0 || underlay?.photo || cloud) {
      root.hidden = true;
      return;
    }
    if (!root.hidden) {
      if (before !== null && strokes.size > before && undo !== null) away(); // the first line
    } else if (called || (before === null && undo === null && localStorage.getItem(KEY) === null && !welcome.recovered)) show();
  });
  return { root, show: () => { called = true; show(); } };
}
