// How far is the tree of this cell, and how large is it? One line.

import { element } from "../parts/element";
import type { Store } from "../store";

export function mountWords(root: HTMLElement, store: Store): void {
  root.dataset.testid = "status";
  const words = element("span", { aria: { live: "polite" } });
  root.append(words);
  const show = (): void => {
    const { working, tree, trouble, connected } = store.known;
    const state = connected ? (working?.state ?? "idle") : "working";
    Object.assign(root.dataset, {
      state, segments: String(tree?.segments ?? 0), triangles: String(tree ? tree.triangles.reduce((sum, part) => sum + part, 0) : 0),
      revision: String(tree?.revision ?? 0),
    });
    words.textContent = say(connected, state, trouble && state === "error" ? `${trouble.message} ${trouble.remedy}` : null, store);
  };
  store.on(["working", "tree", "trouble", "connected", "strokes"], show);
  show();
}

function say(connected: boolean, state: string, trouble: string | null, store: Store): string {
  const { tree, strokes } = store.known;
  if (!connected) return "Waiting for the kernel…";
  if (trouble) return trouble;
  if (!strokes.size) return "Draw a trunk from the ground up, then a few branches.";
  const size = tree ? `${tree.segments} segments, ${tree.leaves} leaves, ${tree.height.toFixed(1)} m` : "";
  return state === "working" ? `${size}${size ? " · " : ""}growing…` : size;
}
