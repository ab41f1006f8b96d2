// The line at the foot: how the tree is, what the program does. For those who listen instead of look, only what matters is said aloud.

import { element } from "../../parts/element";
import type { Store } from "../../store";
import { figuresLine } from "./figures_line";
import { RoundTrip } from "./round_trip";
import { warnings } from "./warnings";
import { work } from "./work";

export function mountStatus(root: HTMLElement, store: Store): void {
  const trip = new RoundTrip();
  const send = store.send;
  store.send = (request) => {
    trip.sent(request, store.known.revision);
    send(request);
  };
  store.on("frame", () => { if (store.frame) trip.came(store.frame.head); }); // before the figures are written
  root.dataset["testid"] = "status";
  root.append(figuresLine(store, trip), warnings(store), element("span", { class: "gap" }), work(store), aloud(store));
  store.on(["working", "connected", "tree", "strokes", "trouble"], () => mark(root, store));
  mark(root, store);
}

/** What programs and tests read: state and figures as data. */
function mark(root: HTMLElement, store: Store): void {
  const { working, connected, tree, drawnTree, strokes, revision } = store.known;
  root.dataset["state"] = connected ? (working?.state ?? "idle") : "error";
  if (tree?.phase === "glance") return;
  const there = tree !== null && strokes.size > 0;
  root.dataset["segments"] = String(there ? tree.segments : 0);
  root.dataset["triangles"] = String(there ? tree.triangles.reduce((sum, one) => sum + one, 0) : 0);
  if (drawnTree?.phase === "full") root.dataset["revision"] = String(drawnTree.revision);
  else if (strokes.size === 0) root.dataset["revision"] = String(revision); // a drawing whose tree is still to come has none yet
}

function aloud(store: Store): HTMLElement {
  const root = element("span", { class: "tick", role: "status", aria: { live: "polite" } });
  store.on("tree", () => {
    const { tree } = store.known;
    if (tree?.phase === "full" || tree?.phase === "photo") root.textContent = `The tree is ready: ${tree.segments} segments, ${tree.leaves} leaves.`;
  });
  store.on("connected", () => { if (!store.known.connected) root.textContent = "The studio does not answer."; });
  return root;
}
