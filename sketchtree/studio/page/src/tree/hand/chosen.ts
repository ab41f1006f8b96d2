// Which limb is pointed at, which is chosen, and how are they seen? A colour over their wood, and over the chosen one a line that shines through the leaves.

import type { Store } from "../../store";
import { Ghosts } from "../page/ghosts";
import type { Mark } from "../plant/marks";
import type { Scenery } from "../plant/scenery";
import type { View } from "../view";
import { pick, runsOf, type Run } from "./pick";
import { reached, type Reached } from "./wood_of";

const CHOSEN: Mark = [255, 150, 10, 200];
const BORNE: Mark = [255, 170, 60, 90]; // what the chosen one bears
const POINTED: Mark = [255, 226, 150, 120];

export class Chosen {
  private found: Run[] | null = null; // made when somebody first asks: not while the pen is drawing
  private readonly line: Ghosts;
  private readonly hint: Ghosts; // over the limb that is pointed at: its wood may be behind leaves

  constructor(private readonly view: View, private readonly scenery: Scenery, private readonly marks: { clear: () => void; set: (id: string, mark: Mark) => void }, private readonly store: Store) {
    this.line = new Ghosts(view.stage.scene, { light: ["#e07b00", "#ffb347"], dark: ["#ffc46b", "#ffab3d"] });
    this.hint = new Ghosts(view.stage.scene, { light: ["#c77a10", "#ffdf9e"], dark: ["#ffe0a8", "#ffcf80"] });
    store.on(["selected", "pointed", "limbs"], () => this.show());
    store.on("theme", () => [this.line, this.hint].forEach((one) => one.wear(store.ui.theme)));
  }

  /** Other wood is there. */
  renew(): void {
    this.found = null;
    this.show();
  }

  private get runs(): Run[] {
    return (this.found ??= runsOf(this.scenery.now.wood));
  }

  get now(): Reached | null {
    return reached(this.store.ui.selected, this.store, this.scenery.now, () => this.runs);
  }

  /** The id of the limb under a pixel of the view. */
  at(x: number, y: number): string | null {
    const hit = pick(this.scenery.now.wood, this.runs, this.view.ray(x, y));
    return hit ? (this.scenery.now.limbs[hit.limb] ?? null) : null;
  }

  private show(): void {
    const { selected, pointed } = this.store.ui;
    const hinted = pointed === selected || this.view.grows ? null : this.store.known.limbs.find((limb) => limb.id === pointed);
    this.marks.clear();
    if (pointed) this.marks.set(pointed, POINTED);
    if (selected) for (const id of borne(selected, this.store)) this.marks.set(id, BORNE);
    if (selected) this.marks.set(selected, CHOSEN);
    const one = this.now;
    this.line.show(one ? [{ points: Float32Array.from(one.path), radius: 0 }] : [], 0.0028 * this.view.reach * 0.6);
    this.hint.show(hinted ? [{ points: Float32Array.from(hinted.path), radius: 0 }] : [], 0.001 * this.view.reach);
    this.view.stage.draw();
  }
}

/** The drawn limbs that grow on this one, and on those. */
function borne(id: string, store: Store): string[] {
  const found = new Set([id]);
  for (const limb of store.known.limbs) if (limb.parent !== null && found.has(limb.parent)) found.add(limb.id); // parents come first
  found.delete(id);
  return [...found];
}
