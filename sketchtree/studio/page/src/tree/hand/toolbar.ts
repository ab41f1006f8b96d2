// What can be done to the chosen limb? A few buttons beside it.

import { button, swapIcon } from "../../parts/button";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import { shortest, snapped } from "../eye/eye";
import { placeAt } from "./drag";
import type { Chosen } from "./chosen";
import { shortName } from "./wood_of";
import type { View } from "../view";

const CLEAR = 26; // pixels between it and the limb, so that no handle is under it

export class Toolbar {
  private readonly bar: HTMLElement;
  private readonly lock: HTMLButtonElement;
  private readonly flipButton: HTMLButtonElement;
  private readonly gone: HTMLButtonElement;
  private readonly name = element("span", { class: "tree-toolbar-name" });

  constructor(private readonly view: View, private readonly chosen: Chosen, private readonly store: Store) {
    this.flipButton = button({ label: "Flip to the other side", icon: "flip", iconOnly: true, look: "quiet", key: "F", testId: "limb-flip", onPress: () => this.flip() });
    this.lock = button({ label: "Lock", icon: "lock", iconOnly: true, look: "quiet", key: "L", testId: "limb-lock", onPress: () => this.toggleLock() });
    const side = button({ label: "Draw on this side", icon: "turn", iconOnly: true, look: "quiet", testId: "limb-side", hint: "Turn the page to see this limb from its side, and draw there", onPress: () => this.turnToSide() });
    this.gone = button({ label: "Delete", icon: "trash", iconOnly: true, look: "quiet", key: "Del", testId: "limb-delete", hint: "Delete, with all that grows on it", onPress: () => this.remove() });
    this.bar = element("div", { class: "tree-toolbar", role: "toolbar", "aria-label": "Chosen limb", "data-testid": "limb-toolbar", hidden: true }, this.name, this.flipButton, this.lock, side, this.gone);
    for (const made of [this.lock, this.gone]) made.append(element("span", { class: "tree-toolbar-word" }));
    view.root.append(this.bar);
    view.stage.afterDraw.push(() => this.follow());
    store.on(["selected", "limbs", "frame"], () => this.renew());
  }

  flip(): void {
    const one = this.chosen.now;
    if (one?.limb) this.store.send({ type: "flip", limb: one.id });
  }

  toggleLock(): void {
    const one = this.chosen.now;
    if (one) this.store.send({ type: "lock", limb: one.id, on: !isKept(one.limb) });
  }

  remove(): void {
    const one = this.chosen.now;
    if (!one) return;
    this.store.send({ type: "delete", limb: one.id });
    this.store.set("selected", null);
  }

  /** The page from which the limb is seen at right angles, to the nearest 15°. */
  turnToSide(): void {
    const one = this.chosen.now;
    if (!one) return;
    const [x, z] = [one.path.at(-3)! - one.path[0]!, one.path.at(-1)! - one.path[2]!];
    const azimuth = (Math.atan2(-z, x) * 180) / Math.PI; // the page whose way to the right is the limb's
    const there = [azimuth, azimuth + 180].sort((a, b) => Math.abs(shortest(a - this.view.eye.azimuth)) - Math.abs(shortest(b - this.view.eye.azimuth)))[0]!;
    this.store.set("turn", shortest(snapped(there, 15)));
  }

  private renew(): void {
    const one = this.chosen.now;
    this.bar.hidden = one === null;
    if (!one) return;
    const kept = isKept(one.limb);
    this.name.textContent = shortName(one);
    word(this.lock, one.limb ? "" : "Keep"); // what can be done to limbs that nobody drew is said in words: one would not look for it
    word(this.gone, one.limb ? "" : "Clear");
    this.flipButton.hidden = one.limb === null;
    swapIcon(this.lock, kept ? "unlock" : "lock");
    const words = kept ? "Unlock: let it move again" : one.limb ? "Lock: keep it as it is" : "Keep: it stays as it is, whatever else changes, and can be flipped and bent";
    this.lock.setAttribute("aria-label", words);
    this.lock.title = this.lock.dataset.hint = `${words} (L)`;
    this.view.stage.draw();
  }

  private follow(): void {
    const one = this.bar.hidden ? null : this.chosen.now;
    if (!one) return;
    const seen = [0, 0.25, 0.5, 0.75, 1].map((share) => this.view.project(placeAt(one.path, one.share, share)));
    const [wide, high] = [this.bar.offsetWidth, this.bar.offsetHeight];
    const middle = (Math.min(...seen.map(([x]) => x)) + Math.max(...seen.map(([x]) => x))) / 2;
    const left = Math.min(Math.max(8, middle - wide / 2), this.view.stage.wide - wide - 8);
    const above = Math.min(...seen.map(([, y]) => y)) - high - CLEAR;
    const below = Math.max(...seen.map(([, y]) => y)) + CLEAR;
    const top = Math.min(Math.max(8, above < 8 ? below : above), this.view.stage.high - high - 60);
    this.bar.style.transform = `translate(${left.toFixed(0)}px, ${top.toFixed(0)}px)`;
  }
}

function word(made: HTMLButtonElement, text: string): void {
  made.querySelector("span")!.textContent = text;
  made.classList.toggle("wordy", text !== "");
}

function isKept(limb: { locked: boolean; held: number[]; strokes: string[] } | null): boolean {
  return limb !== null && (limb.locked || limb.held.length > 0 || limb.strokes.length === 0);
}
