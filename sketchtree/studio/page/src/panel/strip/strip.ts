// Which template has the tree? A strip of all of them, the most alike first; resting on one shows the tree with it, a click keeps it.

import { element } from "../../parts/element";
import type { Store } from "../../store";
import { onList } from "../catalogue";
import { linger } from "../linger";
import { roving, type Roving } from "../roving";
import { card, type TemplateCard } from "./card";
import { answers, commonName, rank } from "./ranking";
import { search } from "./search";

const REST = 250; // milliseconds until a look is worth a tree

export function mountStrip(root: HTMLElement, store: Store): void {
  const strip = new Strip(store);
  const find = search("Find a template", (typed) => strip.find(typed));
  root.append(element("div", { class: "strip-head" }, element("h2", {}, "Template"), strip.words, find), strip.list);
  onList(store, (welcome) => welcome.templates, () => strip.fill());
  store.on(["matches", "options", "tree", "strokes"], () => strip.show());
}

class Strip {
  readonly list = element("div", { class: "strip-list", role: "group", aria: { label: "Templates, the most alike first" }, testId: "template-strip" });
  readonly words = element("span", { class: "strip-words", role: "status" });
  private readonly cards = new Map<string, TemplateCard>();
  private readonly walk: Roving;
  private readonly glance;
  private chosen = "auto";
  private typed = "";
  private late = false; // another order waits until the pointer has left

  constructor(private readonly store: Store) {
    this.walk = roving(this.list, () => this.shown());
    this.glance = linger<string>(REST, (template) => this.look(template), () => this.look(null));
    this.list.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    this.list.addEventListener("pointerleave", () => this.left());
    this.list.addEventListener("focusout", (event) => { if (!(event.relatedTarget instanceof Node && this.list.contains(event.relatedTarget))) this.left(); });
  }

  /** The cards there are. */
  fill(): void {
    const welcome = this.store.known.welcome;
    if (!welcome) return;
    this.cards.clear();
    this.add("auto", "Automatic", null, "The template most like the drawing, chosen anew whenever it changes");
    for (const { name, title, picture } of welcome.templates)
      this.add(name, commonName(title), picture && this.store.address(picture), `${title}: rest here to see the tree with it, click to keep it`);
    this.add("none", "No template", null, "Only what the drawing itself says, with plain leaves and bark");
    this.list.replaceChildren(...[...this.cards.values()].map((one) => one.root));
    this.order();
    this.show();
  }

  find(typed: string): void {
    this.typed = typed;
    const welcome = this.store.known.welcome;
    for (const choice of welcome?.templates ?? []) this.cards.get(choice.name)!.root.hidden = !answers(choice, typed);
    for (const name of ["auto", "none"]) this.cards.get(name)?.root.toggleAttribute("hidden", typed.trim() !== "");
    this.list.dataset["empty"] = String(this.shown().length === 0);
    this.list.scrollLeft = 0;
    this.walk.keep();
  }

  /** Choice, use and likeness as they are now. */
  show(): void {
    const { welcome, options, matches, strokes, photoTree } = this.store.known;
    if (!welcome || this.cards.size === 0) return;
    const used = photoTree ? photoTree.template : strokes.size ? (matches?.used ?? null) : null; // an empty page wears none
    const chosen = options?.template ?? "auto";
    const bars = new Map(rank(welcome.templates, matches?.ranked ?? []).map((one) => [one.choice.name, one.bar]));
    for (const [name, one] of this.cards) {
      const title = name === "auto" && chosen === "auto" && used !== null ? `Auto\n${this.title(used)}` : this.title(name);
      one.show({ chosen: name === chosen, used: name === used, bar: bars.get(name) ?? null, title });
    }
    const other = chosen !== this.chosen;
    this.chosen = chosen;
    if (this.inHand()) this.late = true;
    else {
      this.order();
      if (other) this.reveal();
    }
  }

  /** Pointer or focus went elsewhere: the tree as it is, and the order that waited. */
  private left(): void {
    this.glance.away();
    if (this.late && !this.inHand()) this.order();
  }

  /** Best first; "auto" before all, "none" after all. */
  private order(): void {
    const { welcome, matches } = this.store.known;
    if (!welcome) return;
    this.late = false;
    const names = ["auto", ...rank(welcome.templates, matches?.ranked ?? []).map((one) => one.choice.name), "none"];
    const wanted = names.map((name) => this.cards.get(name)!.root);
    if (wanted.some((one, index) => this.list.children[index] !== one)) {
      this.list.replaceChildren(...wanted);
      this.list.scrollLeft = 0; // the best are to be seen, and the chosen one
      this.reveal();
    }
    if (this.typed) this.find(this.typed);
    else this.walk.keep();
  }

  /** The chosen one comes into view. */
  private reveal(): void {
    this.cards.get(this.chosen)?.root.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  private add(name: string, title: string, picture: string | null, hint: string): void {
    const made = card({ name, title, picture, hint });
    const root = made.root;
    root.addEventListener("click", () => this.choose(name));
    root.addEventListener("pointerenter", (event) => { if (event.pointerType !== "touch") this.glance.over(name); });
    root.addEventListener("pointerleave", () => this.glance.pass());
    root.addEventListener("focus", () => { if (root.matches(":focus-visible")) this.glance.over(name); });
    this.cards.set(name, made);
  }

  /** Show the tree with another template for as long as one looks at it. */
  private look(template: string | null): void {
    if (this.store.known.photoTree) return; // that grows for seconds, for whoever means it
    this.store.send({ type: "glance", template });
    this.words.textContent = template === null ? "" : `Looking at ${this.title(template)}: click to keep it`;
  }

  private title(name: string): string {
    if (name === "auto") return "Automatic";
    return commonNameOf(this.store, name) ?? (name === "none" ? "No template" : name);
  }

  private choose(name: string): void {
    this.glance.away();
    this.store.send({ type: "choose", options: { template: name } });
  }

  /** Nothing moves under the pointer, or from under the focus. */
  private inHand(): boolean {
    return this.list.matches(":hover") || this.list.contains(document.activeElement);
  }

  private shown(): HTMLElement[] {
    return [...this.list.children].filter((one): one is HTMLElement => one instanceof HTMLElement && !one.hidden);
  }

  private wheel(event: WheelEvent): void {
    if (event.ctrlKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) return;
    event.preventDefault();
    this.list.scrollLeft += event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1);
  }
}

function commonNameOf(store: Store, name: string): string | undefined {
  const title = store.known.welcome?.templates.find((one) => one.name === name)?.title;
  return title && commonName(title);
}
