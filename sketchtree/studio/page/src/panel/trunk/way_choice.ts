// How is the photo's tree marked? The first thing of the photo's part at the side.

import { setWay, way } from "../../draw/trunk/way";
import { choice } from "../../parts/choice";
import type { Store } from "../../store";

export function wayChoice(store: Store): HTMLElement {
  const made = choice<"crown" | "scribbles">({
    label: "How the tree is marked", value: "crown", testId: "photo-way",
    options: [
      { value: "crown", label: "Crown and limbs", title: "A tree in leaf: outline its crown, draw along limbs that show", testId: "photo-way-crown" },
      { value: "scribbles", label: "Trunk from scribbles", title: "A bare tree: scribble on it and beside it, and it is cut out", testId: "photo-way-scribbles" },
    ],
    onPick: (to) => setWay(store, to),
  });
  made.root.classList.add("wide");
  store.on(["trunk", "underlay"], () => made.set(way(store) === "scribbles" ? "scribbles" : "crown"));
  return made.root;
}
