// A bare tree is being scribbled on: what is to be done, what is being done, and what went wrong. A card at the top of the page, in the place of that of crown and limbs.

import { byHand, setPhoto } from "../../draw/photo";
import { sides } from "../../draw/trunk/scribbles";
import { setWay, way } from "../../draw/trunk/way";
import { button } from "../../parts/button";
import { element } from "../../parts/element";
import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";
import { icon } from "../../style/icons";
import { growButton } from "../photo/grow_button";
import { BEGIN, BEGIN_MOUSE, said } from "./words";

export function trunkCard(store: Store): HTMLElement {
  const words = element("p", { testId: "trunk-words", role: "status", aria: { live: "polite" } });
  const bar = element("progress", { aria: { label: "How far the tree is" }, testId: "trunk-progress" });
  bar.max = 1;
  const matte = toggle({ label: "Matte", on: true, hint: "How much of each pixel is tree, over the photo (M)", testId: "trunk-matte", onSwitch: (on) => store.set("matteView", on ? "tint" : "off") });
  const other = button({ label: "By crown and limbs", testId: "way-crown", hint: "Outline the crown and draw along limbs instead", onPress: () => setWay(store, "crown") });
  const close = button({
    label: "Leave the photo", icon: "close", iconOnly: true, look: "quiet", hint: "It is only a picture to trace over then", testId: "trunk-leave", onPress: () => setPhoto(store, false),
  });
  const press = growButton(store, "trunk-grow", () => null);
  const grow = element("span", {}, press);
  const root = element("div", { class: "hint-card photo-card", role: "group", aria: { label: "Scribbling on a photo" }, testId: "trunk-card" },
    icon("picture"), element("div", { class: "photo-said" }, words, bar), matte.root, grow, other, close);
  const show = (): void => {
    const { known } = store;
    root.hidden = way(store) !== "scribbles";
    const has = sides(known.strokes.values());
    const now = said(has, known, byHand() ? BEGIN : BEGIN_MOUSE);
    if (words.textContent !== now) words.textContent = now; // said aloud once
    const both = has.tree && has.beside;
    grow.hidden = !both || press.hidden; // it was told before
    bar.hidden = !both || known.growing?.state !== "grows";
    bar.value = known.growing?.done ?? 0;
    other.hidden = has.tree || has.beside;
    matte.root.hidden = !known.matte?.png;
    matte.set(store.ui.matteView !== "off");
    Object.assign(root.dataset, { grown: known.growing?.state ?? "none", trunk: known.trunks?.state ?? "none", matte: String(known.matte?.png ? known.matte.revision : "") });
    root.dataset["points"] = String(known.found?.vertices.reduce((sum, ring) => sum + ring.length / 2, 0) ?? 0);
  };
  store.on(["underlay", "trunk", "trunks", "matte", "growing", "strokes", "matteView"], show);
  show();
  return root;
}
