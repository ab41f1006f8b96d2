// There is no tree to see yet: will there be one? Said in its place, until the first one stands.

import { element } from "../../parts/element";
import { way } from "../../draw/trunk/way";
import type { Store } from "../../store";

const GROWS = new Set(["waits", "grows"]);

export function emptyTree(store: Store): HTMLElement {
  const root = element("p", { class: "empty-tree", testId: "empty-tree" });
  const show = (): void => {
    const { welcome, strokes, tree, working, connected, growing, cloud } = store.known;
    const nothing = strokes.size === 0;
    root.hidden = !welcome || (nothing && cloud !== null) || (!nothing && tree !== null && tree.segments > 0);
    root.textContent = nothing ? "Your tree will stand here." : working?.state === "error" || !connected || (way(store) === "scribbles" && !GROWS.has(growing?.state ?? "")) ? "" : "The tree is growing …";
  };
  store.on(["welcome", "strokes", "tree", "working", "connected", "growing", "trunk", "cloud"], show);
  show();
  return root;
}
