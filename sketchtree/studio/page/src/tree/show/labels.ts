// Which words and signs lie over the view? The heights of tree and person, and a small lock at every limb that is held.

import { element } from "../../parts/element";
import type { Limb } from "../../messages";
import type { Store } from "../../store";
import { icon } from "../../style/icons";
import type { Point } from "../eye/eye";
import { placeAt } from "../hand/drag";
import { TALL, type Figure } from "../stage/figure";
import type { View } from "../view";

const HIGHEST = 36; // pixels below the view's upper edge
const MOST = 60; // locks: more would hide the tree

export class Labels {
  private readonly layer = element("div", { class: "tree-labels", "aria-hidden": "true" });
  private placed: { label: HTMLElement; at: () => Point }[] = [];

  constructor(private readonly view: View, private readonly figure: Figure, private readonly store: Store) {
    view.root.append(this.layer);
    view.stage.afterDraw.push(() => this.follow());
    store.on(["limbs", "figure", "tree", "selected"], () => this.renew());
  }

  renew(): void {
    this.layer.replaceChildren();
    this.placed = [];
    const { tree, limbs } = this.store.known;
    if (this.store.ui.figure && tree && tree.height > 0) {
      const { x, z } = this.figure.group.position;
      this.put("tree-height", `${TALL} m`, () => [x, TALL, z]);
      this.put("tree-height whole", `${tree.height.toFixed(tree.height < 10 ? 1 : 0)} m`, () => this.view.top());
    }
    for (const limb of limbs.filter((one) => (one.locked || one.held.length) && one.id !== this.store.ui.selected).slice(0, MOST)) { // the chosen one has its handles there
      const label = this.put("tree-lock", "", () => markAt(limb));
      label.append(icon(limb.locked ? "lock" : "pin"));
    }
    this.view.stage.draw();
  }

  private put(name: string, text: string, at: () => Point): HTMLElement {
    const label = element("span", { class: `tree-label ${name}` }, text);
    this.layer.append(label);
    this.placed.push({ label, at });
    return label;
  }

  private follow(): void {
    for (const { label, at } of this.placed) {
      const [x, low] = this.view.project(at());
      const y = label.classList.contains("whole") ? Math.max(low, HIGHEST) : low; // a top that is out of sight still has its height
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -145%)`;
    }
  }
}

function markAt(limb: Limb): Point {
  return placeAt(limb.path, limb.share, limb.locked ? 0.55 : limb.held[0]!);
}
