// A photo is being marked: what is to be done, what is missing, and what comes of it. A card at the top of the page.

import { setPhoto } from "../../draw/photo";
import { block, button } from "../../parts/button";
import { element } from "../../parts/element";
import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";
import { icon } from "../../style/icons";

const HOW = "Left button: the crown. Right button: a branch.";
const WAITS = "Looking for the foliage …";
const NONE = "mark the crown and the trunk first";
const SOON = "limbs are told from leaves once the foliage is known";

export function photoCard(store: Store): HTMLElement {
  const words = element("p", { testId: "photo-words" });
  const tint = toggle({ label: "Foliage", on: store.ui.tint, hint: "Tint what was found to be foliage", testId: "photo-tint", onSwitch: (on) => store.set("tint", on) });
  const use = button({
    label: "Use traced limbs", look: "primary", testId: "use-traced", hint: "The traced limbs become the drawing; the crown stays",
    onPress: () => store.send({ type: "usetraced" }),
  });
  const close = button({
    label: "Leave the photo", icon: "close", iconOnly: true, look: "quiet", hint: "It is only a picture to trace over then", testId: "photo-leave",
    onPress: () => setPhoto(store, false),
  });
  const root = element("div", { class: "hint-card photo-card", role: "group", aria: { label: "Marking a photo" }, testId: "photo-card" },
    icon("picture"), words, tint.root, use, close);
  const show = (): void => {
    const { underlay, traced, foliage } = store.known;
    root.hidden = !underlay?.photo;
    words.textContent = traced?.remark || (traced?.waits ? WAITS : HOW);
    tint.root.hidden = !foliage?.png;
    block(use, !traced?.trees.length ? NONE : traced.waits ? SOON : null);
    root.dataset["limbs"] = String(traced?.trees.reduce((sum, tree) => sum + tree.parent.length, 0) ?? 0);
  };
  store.on(["underlay", "traced", "foliage"], show);
  show();
  return root;
}
