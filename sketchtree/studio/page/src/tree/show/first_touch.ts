// Who would know that limbs can be taken in hand here? A line in the view's corner says so, until the first one was.

import { element } from "../../parts/element";
import type { Store } from "../../store";

const KEY = "sketchtree-limb-taken";

export function firstTouch(root: HTMLElement, store: Store): void {
  const line = element("p", { class: "tree-legend tree-first", "data-testid": "limb-hint" }, "Click a branch to edit it");
  line.hidden = true;
  root.append(line);
  let taken = remembered();
  const follow = (): void => {
    if (store.ui.selected !== null && !taken) {
      taken = true;
      remember();
    }
    line.hidden = taken || store.ui.uncertainty || store.known.photoTree !== null || (store.known.tree?.segments ?? 0) === 0;
  };
  store.on(["selected", "tree", "photoTree", "uncertainty"], follow);
}

function remembered(): boolean {
  try {
    return localStorage.getItem(KEY) !== null;
  } catch {
    return false; // a notebook may keep its cells from remembering
  }
}

function remember(): void {
  try {
    localStorage.setItem(KEY, "yes");
  } catch {
    // then it is said again the next time
  }
}
