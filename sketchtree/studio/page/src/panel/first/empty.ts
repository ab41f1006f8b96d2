// The page is empty: what now? A faint drawing shows the order; two buttons lead elsewhere. The pen goes through all of it.

import { button } from "../../parts/button";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import { ghostDrawing } from "./ghost_drawing";

export interface Ways {
  gallery: () => void;
  open: () => void;
}

export function emptyPage(store: Store, ways: Ways): HTMLElement {
  const steps = element("ol", { class: "steps" },
    element("li", {}, "a trunk, from the ground up"),
    element("li", {}, "a few branches"),
    element("li", {}, "if you like, the crown’s outline (C)"));
  const buttons = element("div", { class: "buttons" },
    button({ label: "Look at examples", icon: "gallery", testId: "empty-gallery", onPress: ways.gallery }),
    button({ label: "Open a file", icon: "open", testId: "empty-open", onPress: ways.open }));
  const root = element("div", { class: "empty", testId: "empty" }, element("div", { class: "empty-middle" },
    ghostDrawing(), element("div", { class: "empty-words" }, element("h2", {}, "Draw a tree"), steps, buttons)));
  const show = (): void => {
    const { welcome, strokes, underlay, connected, cloud } = store.known;
    root.hidden = !welcome || !connected || strokes.size > 0 || store.ui.turn !== 0 || (underlay?.photo ?? false) || cloud !== null;
    root.classList.toggle("traced", underlay !== null); // a picture to trace says enough
  };
  store.on(["welcome", "connected", "strokes", "underlay", "turn", "cloud"], show);
  show();
  return root;
}
