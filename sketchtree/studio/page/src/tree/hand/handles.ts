// How is a limb's depth taken in hand? Round grips along the chosen limb; each slides along the way out of its page only, by pointer or by arrow keys. While it
// slides the limb bends here at once, and the program says how all that hangs on it would go (`Ghost`).

import { metres as inMetres } from "../../panel/figures";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import { along, type Point } from "../eye/eye";
import { depthOf } from "../page/plane";
import { Ghosts } from "../page/ghosts";
import type { View } from "../view";
import type { Chosen } from "./chosen";
import { bent, cursorAlong, grips, limits, placeAt, pulled, SEEN } from "./drag";
import type { Guide } from "./guide";
import type { Reached } from "./wood_of";

const LIVE = 1000 / 15; // milliseconds between previews
const ROOM = 26; // pixels between handles, at least
const BESIDE = 18; // pixels from a handle to its words
const LEAST = 0.08; // of the tree's height: so far a handle may always go
const STEP = 0.02; // of the tree's height, an arrow key

export class Handles {
  private readonly layer = element("div", { class: "tree-handles" });
  private shown: { share: number; handle: HTMLButtonElement }[] = [];
  private one: Reached | null = null;
  private dragging = false;
  private told = 0;
  private readonly preview: Ghosts;
  private readonly words = element("span", { class: "tree-label tree-height tree-pulled", "aria-hidden": "true", hidden: true }); // how far, while it slides

  constructor(private readonly view: View, private readonly chosen: Chosen, private readonly store: Store, private readonly guide: Guide) {
    this.preview = new Ghosts(view.stage.scene, { light: ["#e07b00", "#ffd08a"], dark: ["#ffd08a", "#ffab3d"] });
    view.root.append(this.layer);
    view.stage.afterDraw.push(() => this.follow());
    store.on(["selected", "limbs"], () => this.renew());
    store.on("frame", () => this.renew());
    store.on("theme", () => this.preview.wear(store.ui.theme));
  }

  /** The grips of the limb that is chosen now. */
  renew(): void {
    if (this.dragging) return;
    this.preview.show([], 0);
    const focused = this.shown.findIndex(({ handle }) => handle.matches(":focus"));
    this.one = this.chosen.now;
    const shares = !this.one ? [] : this.one.limb ? grips(this.one.limb.held) : [1];
    this.quiet();
    this.layer.replaceChildren(this.words);
    this.shown = shares.map((share, k) => ({ share, handle: this.handle(share, k) }));
    this.shown[focused]?.handle.focus();
    this.view.stage.draw();
  }

  focus(): void {
    this.shown.at(-1)?.handle.focus();
  }

  private handle(share: number, k: number): HTMLButtonElement {
    const held = this.one!.limb?.held.some((at) => Math.abs(at - share) < 0.01) ?? false;
    const name = `Depth at ${Math.round(100 * share)} % of the limb${held ? ", held" : ""}. Drag, or arrow up and down`;
    const made = element("button", { class: `tree-handle${held ? " held" : ""}`, type: "button", "aria-label": name, title: "Drag nearer or farther. What was drawn stays as it was drawn.", "data-testid": `handle-${k}` });
    made.addEventListener("pointerdown", (event) => this.take(event, made, share));
    made.addEventListener("keydown", (event) => this.key(event, share));
    for (const name of ["pointerenter", "focus"]) made.addEventListener(name, () => this.point(share));
    for (const name of ["pointerleave", "blur"]) made.addEventListener(name, () => { if (!this.dragging) this.quiet(); });
    this.layer.append(made);
    return made;
  }

  /** Where it could slide to; seen from the end of that way, words say it. */
  private point(share: number): void {
    if (this.dragging || !this.one) return;
    const at = placeAt(this.one.path, this.one.share, share);
    this.guide.show(at, this.one.out, this.room(this.one, share));
    this.say(this.slides(at, this.one.out) === null ? "↑ farther · ↓ nearer" : "", this.view.project(at));
  }

  /** The way a handle slides on the screen, a pixel of it seen from its side; null: one looks along it. */
  private slides(at: Point, out: Point): readonly [number, number] | null {
    const [from, to] = [this.view.project(at), this.view.project(along(at, out, 1 / Math.max(this.view.metre(at), 1e-6)))];
    const way = [to[0] - from[0], to[1] - from[1]] as const;
    return Math.hypot(...way) < SEEN ? null : way;
  }

  private say(words: string, [x, y]: readonly [number, number]): void {
    this.words.textContent = words;
    this.words.hidden = words === "";
    const beside = x + BESIDE + this.words.offsetWidth < this.view.stage.wide ? `${BESIDE}px` : `calc(-100% - ${BESIDE}px)`;
    this.words.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(${beside}, -50%)`;
  }

  private quiet(): void {
    this.guide.hide();
    this.words.hidden = true;
  }

  private room(one: Reached, share: number): readonly [number, number] {
    return limits(one.path, one.share, share, one.out, LEAST * this.view.reach);
  }

  private take(down: PointerEvent, handle: HTMLButtonElement, share: number): void {
    if (down.button !== 0 || !this.one) return;
    down.stopPropagation();
    down.preventDefault();
    handle.focus();
    handle.setPointerCapture(down.pointerId);
    const one = this.one;
    const at = placeAt(one.path, one.share, share);
    this.dragging = true;
    this.told = 0;
    const [farthest, nearest] = this.room(one, share);
    this.guide.show(at, one.out, [farthest, nearest]);
    let metres = 0;
    const moved = (event: PointerEvent): void => {
      const wish = pulled(at, one.out, event.clientX - down.clientX, event.clientY - down.clientY, this.view.project, this.view.metre(at));
      metres = Math.min(nearest, Math.max(farthest, wish));
      this.say(metres === 0 ? "" : `${inMetres(Math.abs(metres))} ${metres > 0 ? "nearer" : "farther"}`, this.view.project(along(at, one.out, metres)));
      this.pull(one, share, metres, true);
    };
    const done = (event: PointerEvent): void => {
      handle.removeEventListener("pointermove", moved);
      handle.removeEventListener("pointerup", done);
      handle.removeEventListener("pointercancel", done);
      this.dragging = false;
      this.quiet();
      if (event.type === "pointerup" && metres !== 0) this.pull(one, share, metres, false);
      else this.letGo();
    };
    handle.addEventListener("pointermove", moved);
    handle.addEventListener("pointerup", done);
    handle.addEventListener("pointercancel", done);
  }

  /** Nothing comes of it: neither here nor in what the program shows of it. */
  private letGo(): void {
    this.moving = null;
    if (this.told) this.store.send({ type: "sketching", stroke: null });
    this.renew();
  }

  private key(event: KeyboardEvent, share: number): void {
    const way = { ArrowUp: -1, ArrowDown: 1, ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!way || !this.one) return;
    event.preventDefault();
    event.stopPropagation();
    const [farthest, nearest] = this.room(this.one, share);
    this.pull(this.one, share, Math.min(nearest, Math.max(farthest, way * STEP * this.view.reach * (event.shiftKey ? 4 : 1))), false);
  }

  private pull(one: Reached, share: number, metres: number, live: boolean): void {
    const scale = this.store.known.tree?.scale ?? 1;
    const depth = (depthOf(one.view, placeAt(one.path, one.share, share)) + metres) / scale;
    const bend = bent(one.path, one.share, share, one.out, metres);
    this.preview.show([{ points: bend, radius: 0 }], 0.002 * this.view.reach);
    this.moving = { share, by: along([0, 0, 0], one.out, metres) };
    const now = performance.now();
    if (!live || now - this.told > LIVE) {
      this.told = now;
      this.store.send({ type: "hold", limb: one.id, share, depth, live });
    }
    if (!live) this.moving = null;
    this.view.stage.draw(live);
  }

  private moving: { share: number; by: Point } | null = null;

  private follow(): void {
    if (!this.one) return;
    let last: readonly [number, number] | null = null; // of those seen, from the tip down: a short limb, or one far away, has room for few
    for (const { share, handle } of [...this.shown].reverse()) {
      const at = placeAt(this.one.path, this.one.share, share);
      const here = this.view.project(this.moving?.share === share ? along(at, this.moving.by, 1) : at);
      const room = last === null || Math.hypot(here[0] - last[0], here[1] - last[1]) > ROOM || handle.matches(":focus"); // asked of itself: in a notebook it is in a shadow root
      handle.style.visibility = room ? "visible" : "hidden";
      if (room) last = here;
      const way = this.slides(at, this.one.out);
      handle.style.cursor = way === null ? "ns-resize" : cursorAlong(...way);
      handle.style.transform = `translate(${here[0].toFixed(1)}px, ${here[1].toFixed(1)}px) translate(-50%, -50%)`;
    }
  }
}
