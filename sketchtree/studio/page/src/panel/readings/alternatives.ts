// Which other trees may the drawing show? A strip of them with their odds; a click takes one.

import type { Alternatives, Reading } from "../../messages";
import { block, button } from "../../parts/button";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import { percent } from "../figures";
import { roving } from "../roving";
import { Fresh } from "./fresh";
import { sketchlet } from "./sketchlet";

const ELSEWHERE = new Set(["mirror", "settle", "reading"]); // steps, by their labels, that put limbs at other depths
const WORDS = {
  asked: "This takes a few seconds.",
  never: "The drawing may show other trees as well: seen from the side they differ.",
  stale: "The drawing has changed since.",
  alone: "Nothing else is likely: the drawing shows this one tree.",
  there: "Above from the front, below from the top. What differs from the likeliest is in colour.",
};

export function alternatives(store: Store): HTMLElement {
  const strip = new ReadingStrip(store);
  return element("div", { class: "alternatives" }, strip.words, strip.list, strip.look);
}

class ReadingStrip {
  readonly list = element("div", { class: "readings", role: "group", aria: { label: "Other readings of the drawing" }, testId: "alternatives" });
  readonly words = element("p", { class: "hint", role: "status" });
  readonly look = button({
    label: "Show other readings", icon: "eye", testId: "readings", onPress: () => this.ask(),
    hint: "A drawing is flat: how far a branch comes towards you is a guess. This shows the likeliest guesses.",
  });
  private readonly walk = roving(this.list, () => this.buttons());
  private readonly fresh = new Fresh();
  private asked = false;
  private drawings: (() => void)[] = [];
  private picked: number | null = 0; // which of them is the tree one sees
  private taking: number | null = null; // a pick is on its way

  constructor(private readonly store: Store) {
    store.on("alternatives", () => this.fill());
    store.on("theme", () => requestAnimationFrame(() => this.drawings.forEach((draw) => draw())));
    store.on("trouble", () => { this.asked = false; this.taking = null; this.tell(); });
    store.on("changed", () => this.follow());
    store.on("strokes", () => this.tell());
    this.tell();
  }

  private ask(): void {
    this.asked = true;
    this.fresh.keep(this.store.known);
    this.store.send({ type: "readings" });
    this.tell();
  }

  /** What there is to say, and whether looking again is worth it. */
  private tell(): void {
    const { alternatives: known, strokes } = this.store.known;
    const stale = known !== null && !this.fresh.holds(this.store.known);
    this.list.hidden = known === null || stale; // what can't be picked is not shown
    block(this.look, this.asked ? "looking" : strokes.size === 0 ? "draw something first" : null);
    this.look.querySelector("span")!.textContent = this.asked ? "Looking …" : known && strokes.size > 0 ? "Look again" : "Show other readings";
    this.look.hidden = known !== null && !stale && !this.asked;
    const alone = known !== null && known.readings.length < 2;
    this.words.textContent = WORDS[this.asked ? "asked" : !known || strokes.size === 0 ? "never" : stale ? "stale" : alone ? "alone" : "there"];
  }

  private fill(): void {
    const known = this.store.known.alternatives;
    if (!known) return;
    if (!this.asked) this.fresh.keep(this.store.known); // another page asked
    this.asked = false;
    this.picked = 0;
    const made = known.readings.map((reading, index) => this.reading(known, reading, index));
    this.drawings = made.map((one) => one.draw);
    this.list.replaceChildren(...made.map((one) => one.root));
    this.drawings.forEach((draw) => draw());
    this.mark();
    this.tell();
  }

  private reading(known: Alternatives, reading: Reading, index: number): { root: HTMLElement; draw: () => void } {
    const { root: canvas, draw } = sketchlet(reading, known.readings[0]!);
    const odds = percent(reading.odds);
    const marks = { testId: `alternative-${index}`, title: `Take this tree: ${odds} likely`, aria: { label: `Reading ${index + 1}: ${odds} likely` } };
    const root = element("button", { class: "reading", ...marks }, canvas, element("span", {}, odds));
    root.type = "button";
    root.addEventListener("click", () => {
      this.taking = index;
      this.store.send({ type: "pick", reading: index, revision: known.revision });
    });
    return { root, draw };
  }

  /** A step was taken: by a pick the tree is that reading; any other that changes depths makes it none of them. */
  private follow(): void {
    const { undo, redo } = this.store.known;
    if (this.taking !== null) this.picked = this.taking;
    else if (redo !== null || ELSEWHERE.has(undo ?? "")) this.picked = null; // after a step back, nobody knows which it was
    this.taking = null;
    this.mark();
    this.tell();
  }

  private mark(): void {
    this.buttons().forEach((one, index) => one.setAttribute("aria-pressed", String(index === this.picked)));
    this.walk.keep();
  }

  private buttons(): HTMLElement[] {
    return [...this.list.querySelectorAll<HTMLElement>("button")];
  }
}
