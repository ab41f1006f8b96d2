// How is the photo's tree marked: by its crown and limbs (Tan et al. 2008), or by scribbles that say what is tree? The strokes of the other way stay in the drawing, and are not shown.

import type { Stroke } from "../../messages";
import type { Store, Tool } from "../../store";
import { isScribble, sides } from "./scribbles";

export type Way = "drawing" | "crown" | "scribbles"; // drawing: no photo shows the tree

const TOOLS: Record<Way, readonly Tool[]> = {
  drawing: ["branch", "crown", "obstacle", "erase", "select", "pan"],
  crown: ["branch", "crown", "obstacle", "erase", "select", "pan"],
  scribbles: ["foreground", "background", "matte_add", "matte_erase", "vertices", "foot", "erase", "pan"],
};

export function way({ known }: Pick<Store, "known">): Way {
  if (!known.underlay?.photo) return "drawing";
  return known.trunk?.on ? "scribbles" : "crown";
}

/** Does the tool make sense now? */
export function isOffered(store: Pick<Store, "known">, tool: Tool): boolean {
  return TOOLS[way(store)].includes(tool);
}

/** Does the stroke say something now? Without a photo everything is shown, so that it can be erased. */
export function isOfWay(store: Pick<Store, "known">, stroke: Pick<Stroke, "kind">): boolean {
  const now = way(store);
  return now === "drawing" || isScribble(stroke) === (now === "scribbles");
}

/** Is there something that a matte can be told from: scribbles on both sides? */
export function isScribbled({ known }: Pick<Store, "known">): boolean {
  const has = sides(known.strokes.values());
  return has.tree && has.beside;
}

/** Mark the tree in this way from now on. */
export function setWay(store: Store, to: "crown" | "scribbles"): void {
  const on = to === "scribbles";
  if (store.known.trunk?.on !== on) store.chooseTrunk({ on }, on ? "scribbles" : "crown and limbs");
}

/** A tool that makes no sense any more gives way to one that does; scribbles begin on the tree. */
export function followWay(store: Store): void {
  const follow = (): void => {
    if (way(store) === "scribbles") store.set("turn", 0); // where the photo lies
    if (isOffered(store, store.ui.tool)) return;
    store.set("tool", way(store) === "scribbles" ? "foreground" : way(store) === "crown" && !hasCrown(store) ? "crown" : "branch");
  };
  store.on(["trunk", "underlay"], follow);
  let photo = store.known.underlay?.digest;
  store.on("underlay", () => {
    const other = store.known.underlay?.digest;
    if (other !== photo) {
      Object.assign(store.known, { matte: null, trunks: null, found: null }); // they are of another photo
      store.tell("matte", "trunks");
    }
    photo = other;
  });
}

export function hasCrown(store: Pick<Store, "known">): boolean {
  return [...store.known.strokes.values()].some((stroke) => stroke.kind === "crown");
}
