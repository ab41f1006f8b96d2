// A photo is being marked: what is to be done, what is missing, and what comes of it. A card at the top of the page.

import { byHand, setPhoto } from "../../draw/photo";
import { setWay, way } from "../../draw/trunk/way";
import { block, button } from "../../parts/button";
import { element } from "../../parts/element";
import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";
import { icon } from "../../style/icons";
import { growButton } from "./grow_button";
import { isMarked, proposeButton } from "./propose_button";
import { HOW, HOW_BY_HAND, said } from "./words";

const NONE = "mark the crown and the trunk first";
const SOON = "limbs are told from leaves once the foliage is known";

export function photoCard(store: Store): HTMLElement {
  const words = element("p", { testId: "photo-words", role: "status", aria: { live: "polite" } });
  const bar = element("progress", { aria: { label: "How far the tree is" }, testId: "photo-progress" });
  bar.max = 1;
  const tint = toggle({ label: "Foliage", on: store.ui.tint, hint: "Tint what was found to be foliage", testId: "photo-tint", onSwitch: (on) => store.set("tint", on) });
  const use = button({
    label: "Use traced limbs", testId: "use-traced", hint: "The traced limbs become the drawing, to be edited limb by limb; the crown stays",
    onPress: () => store.send({ type: "usetraced" }),
  });
  const scribble = button({ label: "By scribbles", testId: "way-scribbles", hint: "The tree is bare: scribble on it and beside it, and it is cut out", onPress: () => setWay(store, "scribbles") });
  const close = button({
    label: "Leave the photo", icon: "close", iconOnly: true, look: "quiet", hint: "It is only a picture to trace over then", testId: "photo-leave",
    onPress: () => setPhoto(store, false),
  });
  const root = element("div", { class: "hint-card photo-card", role: "group", aria: { label: "Marking a photo" }, testId: "photo-card" },
    icon("picture"), element("div", { class: "photo-said" }, words, bar), tint.root, proposeButton(store), scribble, growButton(store), use, close);
  const show = (): void => {
    const { traced, foliage, growing, proposed, revision } = store.known;
    root.hidden = way(store) !== "crown";
    scribble.hidden = isMarked(store);
    const doubt = proposed?.revision === revision ? proposed.why : "";
    const now = said(traced, growing, byHand() ? HOW_BY_HAND : HOW, doubt);
    if (words.textContent !== now) words.textContent = now; // said aloud once
    bar.hidden = growing?.state !== "grows";
    bar.value = growing?.done ?? 0;
    tint.root.hidden = !foliage?.png;
    use.hidden = !traced?.trees.length || growing?.state === "grows"; // one thing at a time
    block(use, !traced?.trees.length ? NONE : traced.waits ? SOON : null);
    root.dataset["limbs"] = String(traced?.trees.reduce((sum, tree) => sum + tree.parent.length, 0) ?? 0);
    root.dataset["grown"] = growing?.state ?? "none";
  };
  store.on(["underlay", "trunk", "traced", "foliage", "growing", "proposed", "revision", "strokes"], show);
  show();
  return root;
}
