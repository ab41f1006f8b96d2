// The page is turned and nothing is drawn on this side yet: what is it for? A line at the top of the page; the pen goes through it.

import { isSamePage } from "../../draw/desk";
import { element } from "../../parts/element";
import { icon } from "../../style/icons";
import type { Store } from "../../store";

export function turnedNote(store: Store): HTMLElement {
  const root = element("div", { class: "hint-card turned-note", role: "note", testId: "turned-note" }, icon("turn"),
    element("p", {}, element("strong", {}, "Draw from this side."), " Grey: limbs drawn elsewhere."));
  const show = (): void => {
    const { turn } = store.ui;
    const strokes = [...store.known.strokes.values()];
    root.hidden = isSamePage(turn, 0) || strokes.length === 0 || strokes.some((stroke) => isSamePage(stroke.view_deg, turn));
  };
  store.on(["turn", "strokes"], show);
  show();
  return root;
}
