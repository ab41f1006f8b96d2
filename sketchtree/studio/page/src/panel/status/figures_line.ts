// How big is the tree? Its figures, as the program told them last.

import { element } from "../../parts/element";
import type { Store } from "../../store";
import type { RoundTrip } from "./round_trip";
import { figures, type Said } from "./words";

export function figuresLine(store: Store, trip: RoundTrip): HTMLElement {
  const root = element("span", { class: "figures" });
  let height = 0; // of the newest whole tree: what comes first is only a part of one
  const show = (): void => {
    const { tree, strokes, welcome, photoTree } = store.known;
    const nothing = strokes.size === 0 && photoTree === null;
    if (tree?.phase === "glance") return;
    if (!tree?.segments || nothing) {
      root.replaceChildren(element("span", {}, nothing ? "Nothing drawn yet" : "No tree yet"));
      return;
    }
    if (tree.phase !== "quick" || height === 0) height = tree.height;
    const title = welcome?.templates.find((one) => one.name === tree.template)?.title ?? tree.template;
    root.replaceChildren(...figures({ ...tree, height }, title, trip.last).map(figure));
  };
  store.on(["tree", "strokes", "welcome", "photoTree"], show);
  show();
  return root;
}

function figure(said: Said): HTMLElement {
  return element("span", { class: `figure-${said.name}`, title: said.title }, said.value);
}
