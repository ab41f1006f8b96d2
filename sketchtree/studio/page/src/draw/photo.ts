// Is the picture under the page a photo of the tree? Then strokes mark its crown and limbs (Tan et al. 2008): left button the crown, right button a branch.

import type { Underlay } from "../messages";
import type { Store } from "../store";
import { isSamePage } from "./desk";
import { hasCrown, way } from "./trunk/way";

/** The photo that strokes mark now; null: there is none, or the page is turned away from it. */
export function photoHere(store: Store): Underlay | null {
  const { underlay } = store.known;
  return underlay?.photo && isSamePage(store.ui.turn, 0) ? underlay : null;
}

const CLEAR = 0.9; // how strong a photo is that is to be marked, at least

/** It is one from now on, or only a picture to trace over. */
export function setPhoto(store: Store, on: boolean): void {
  const { underlay } = store.known;
  if (!underlay || underlay.photo === on) return;
  store.send({ type: "setunderlay", underlay: { ...underlay, photo: on, opacity: on ? Math.max(underlay.opacity, CLEAR) : underlay.opacity } });
}

/** Is it marked by a pen or a finger, which has one button? */
export function byHand(): boolean {
  return matchMedia("(pointer: coarse)").matches;
}

/** With the photo the pen draws the crown first; then, where it has one button, the trunk. */
export function followPhoto(store: Store): void {
  let was = false;
  let crowned = false;
  store.on("strokes", () => {
    const before = crowned;
    crowned = hasCrown(store);
    if (crowned && !before && byHand() && store.ui.tool === "crown" && photoHere(store)) store.set("tool", "branch");
  });
  store.on("underlay", () => {
    const is = photoHere(store) !== null;
    if (is === was) return;
    was = is;
    if (!is) return;
    store.set("turn", 0);
    store.set("tool", way(store) === "scribbles" ? "foreground" : hasCrown(store) ? "branch" : "crown");
  });
}
