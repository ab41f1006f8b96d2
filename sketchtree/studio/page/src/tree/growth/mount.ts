// The tree as it grows: what stands in its place while the time is not over, and what the controls do.
//
//     opened → asked for → there: a slider from seed to tree → closed, and all of it is given back
//
// At the end of the time one sees the usual tree, whose limbs can be taken. Whoever draws on sees that tree at once, and its growth is made anew when it rests;
// whoever wants another growth keeps the one there is, and the time, until the other has come.

import { block, press } from "../../parts/button";
import type { Store } from "../../store";
import { Marks } from "../plant/marks";
import type { Lighting } from "../plant/surface";
import { Wardrobe } from "../plant/wardrobe";
import type { Stand } from "../mount";
import { type Ageing } from "./ageing";
import { Asking } from "./asking";
import { growthBar } from "./bar";
import { Clock } from "./clock";
import type { Growth } from "./growth";
import { howItGrows } from "./how";
import { Standing } from "./standing";

const RESTS = 1000; // milliseconds that a tree is there before its growth is made
const DRAWN = 3000; // after a stroke, if no tree comes of it: it may have been none of the tree
const CHOSEN = 350; // and after a hand on how it grows
const THINNED = 0.3; // of the leaves while it moves, where no graphics card draws it

export function mountGrowth(stand: Stand, store: Store): void {
  new GrowthView(stand, store);
}

class GrowthView {
  private readonly clock = new Clock();
  private open = false;
  private words = "";
  private remedy = "";
  private made: number | null = null;
  private standing: Standing | null = null;
  private bends = false; // what stands differs from the tree at its end
  private revision = -1; // of the drawing that it grows to
  private readonly lighting: Lighting;
  private readonly wardrobe: Wardrobe;
  private readonly asking: Asking;
  private asked: Ageing;
  private readonly bar;

  constructor(private readonly stand: Stand, private readonly store: Store) {
    const { view, lighting, textures } = stand;
    this.asked = store.ui.ageing;
    this.asking = new Asking(store, {
      waits: (done) => this.waits(done),
      made: (growth, revision) => this.take(growth, revision),
      refused: (why) => { this.made = null; this.say(why.message, why.remedy); this.leave(); },
    });
    this.lighting = { ...lighting, marks: new Marks(), doubt: { value: 0 }, leafShare: { value: 1 } };
    this.wardrobe = new Wardrobe(this.lighting, textures, view.stage.pace.software, () => view.stage.shadows());
    this.bar = growthBar(howItGrows(store, "growth"), {
      open: () => (this.open ? this.close() : this.begin()),
      close: () => this.close(),
      play: () => { this.clock.playing ? this.clock.pause() : this.clock.play(); this.show(); },
      move: (time) => { this.clock.set(time); this.show(); },
      loop: () => { this.clock.loops = !this.clock.loops; this.tell(); },
    });
    stand.bar.append(this.bar.opener);
    view.root.append(this.bar.strip);
    this.layOut();
    this.followStage();
    this.followStore();
  }

  private begin(): void {
    this.open = true;
    this.clock.time = 1;
    this.bar.strip.hidden = false;
    this.ask(0);
    this.tell();
  }

  private close(): void {
    if (!this.open) return;
    this.open = false;
    const within = this.bar.strip.contains(document.activeElement);
    this.bar.strip.hidden = true;
    this.asking.cancel();
    this.made = null;
    this.leave();
    this.tell();
    if (within) this.bar.opener.focus();
  }

  private ask(wait: number): void {
    if (!this.open) return;
    this.asked = this.store.ui.ageing;
    this.asking.soon(wait);
  }

  private waits(done: number): void {
    this.made = done;
    this.say(done > 0 ? `${Math.round(100 * done)} % made` : "Growth is being made…");
  }

  private take(growth: Growth, revision: number): void {
    this.standing?.dispose();
    const wears = (name: string, isLeaf: boolean) => {
      const of = this.stand.scenery.materialOf(name);
      return of ? this.wardrobe.wear(of, isLeaf ? "baked" : "wood") : null;
    };
    this.standing = new Standing(growth, wears, this.stand.view.stage.pace.software);
    this.stand.view.stage.scene.add(this.standing.group);
    this.bends = this.asked.bend !== 0;
    this.revision = revision;
    this.made = null;
    this.say("");
    this.show();
  }

  /** The usual tree again, and nothing of the growth is kept. */
  private leave(): void {
    this.clock.set(1);
    this.standing?.dispose();
    this.standing = null;
    this.wardrobe.clear();
    this.revision = -1;
    this.show();
  }

  private say(words: string, remedy = ""): void {
    [this.words, this.remedy] = [words, remedy];
    this.tell();
  }

  private tell(): void {
    const { clock, bar, open, words, remedy, made } = this;
    press(bar.opener, open);
    bar.opener.setAttribute("aria-expanded", String(open));
    bar.show({ time: clock.time, playing: clock.playing, loops: clock.loops, there: this.standing !== null, words, remedy, made });
  }

  /** What is to be seen at this time is in the scene. */
  private show(): void {
    const { view, aside } = this.stand;
    const grows = this.standing !== null && (this.clock.time < 1 || this.bends);
    if (grows && !view.grows) this.letGo();
    if (grows !== view.grows) aside(grows);
    if (this.standing) this.standing.group.visible = grows;
    if (grows) this.pose();
    this.tell();
    if (!this.clock.playing && !view.stage.pace.software) view.stage.shadows();
    view.stage.draw(true);
  }

  private pose(): void {
    this.standing!.at(this.clock.time);
    this.lighting.leafShare.value = this.standing!.leafShare; // a young crown takes little of the light
    if (!this.stand.view.stage.pace.software) this.stand.view.stage.renderer.shadowMap.needsUpdate = true;
  }

  private letGo(): void {
    this.store.set("selected", null);
    this.store.set("pointed", null);
  }

  private followStage(): void {
    const { stage } = this.stand.view;
    stage.beforeDraw.push((now) => {
      if (!this.clock.playing) return false;
      const goesOn = this.clock.tick(now);
      this.show();
      return goesOn;
    });
    const before = stage.whileMoving;
    stage.whileMoving = (moving) => {
      before(moving);
      if (stage.pace.software) this.standing?.thin(moving ? THINNED : 1);
      if (stage.pace.software && !moving && this.stand.view.grows) stage.renderer.shadowMap.needsUpdate = true;
    };
  }

  private followStore(): void {
    const { store } = this;
    store.on(["strokes", "edits"], () => {
      if (!this.open) return;
      this.leave();
      this.ask(DRAWN);
    });
    store.on("selected", () => { if (store.ui.selected !== null && this.stand.view.grows) this.back(); });
    store.on("frame", () => {
      const head = store.frame?.head;
      if (!this.open || !head || head.revision <= this.revision) return;
      if (store.known.photoTree && head.phase !== "photo") return; // the drawing's, which goes on behind the photo's
      this.ask(head.phase === "quick" ? DRAWN : RESTS);
    });
    store.on("ageing", () => this.ask(CHOSEN));
    store.on("photoTree", () => { // another tree is looked at
      if (!this.open) return;
      this.leave();
      this.ask(RESTS);
    });
    const can = (): void => {
      const none = !store.known.tree?.height;
      block(this.bar.opener, none ? "draw a trunk first" : null);
      if (none) this.close();
    };
    store.on(["tree", "photoTree"], can);
    can();
  }

  /** Whoever takes a limb, on the page, sees the tree that has it. */
  private back(): void {
    this.clock.set(1);
    this.bends = false;
    this.show();
  }

  /** The strip stands over what is at the foot, and the tree over the strip. */
  private layOut(): void {
    const { view, bar } = this.stand;
    const { strip } = this.bar;
    const place = (): void => {
      const dial = view.root.querySelector<HTMLElement>(".tree-turn");
      const row = view.root.clientHeight - Math.min(bar.offsetTop, dial?.offsetTop ?? Infinity);
      strip.style.bottom = `${row + 6}px`;
      const foot = view.root.clientHeight - (strip.hidden ? bar.offsetTop : strip.offsetTop);
      if (foot === view.foot) return;
      view.foot = foot;
      view.follow(false);
    };
    const watch = new ResizeObserver(place);
    [strip, bar].forEach((part) => watch.observe(part));
  }
}
