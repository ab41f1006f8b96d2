// Which other trees may the drawing show? A strip of them with their odds; a click takes one.

import { block, button } from "../../parts/button";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import { percent } from "../figures";
import { roving } from "../roving";
import { sketchlet } from "./sketchlet";

export function alternatives(store: Store): HTMLElement {
  const list = element("div", { class: "readings", role: "group", aria: { label: "Other readings of the drawing" }, testId: "alternatives" });
  const words = element("p", { class: "hint" });
  const walk = roving(list, () => [...list.querySelectorAll<HTMLElement>("button")]);
  let asked = false;
  let drawings: (() => void)[] = [];
  const look = button({
    label: "Show other readings", icon: "eye", testId: "readings",
    hint: "A drawing is flat: how far a branch comes towards you is a guess. This shows the likeliest guesses.",
    onPress: () => {
      asked = true;
      store.send({ type: "readings" });
      tell();
    },
  });
  const tell = (): void => {
    const { alternatives: known, revision, strokes } = store.known;
    const stale = known !== null && known.revision !== revision;
    list.classList.toggle("stale", stale);
    block(look, asked ? "looking" : strokes.size === 0 ? "draw something first" : null);
    look.querySelector("span")!.textContent = asked ? "Looking …" : known ? "Look again" : "Show other readings";
    look.hidden = known !== null && !stale && !asked;
    words.textContent = asked ? "This takes a few seconds." : !known ? "The drawing may show other trees as well: seen from the side they differ."
      : stale ? "The drawing has changed since." : known.readings.length < 2 ? "Nothing else is likely: the drawing shows this one tree."
      : "Front above, seen from the top below. The first is the tree you see.";
  };
  const fill = (): void => {
    asked = false;
    const known = store.known.alternatives;
    const made = (known?.readings ?? []).map((reading, index) => {
      const { root, draw } = sketchlet(reading);
      const odds = percent(reading.odds);
      const title = index === 0 ? `The tree you see: ${odds} likely` : `Take this one: ${odds} likely`;
      const pick = element("button", { class: "reading", title, aria: { label: title, pressed: String(index === 0) }, testId: `alternative-${index}` }, root, element("span", {}, odds));
      pick.type = "button";
      pick.addEventListener("click", () => { if (known && !list.classList.contains("stale")) store.send({ type: "pick", reading: index, revision: known.revision }); });
      return { pick, draw };
    });
    drawings = made.map((one) => one.draw);
    list.replaceChildren(...made.map((one) => one.pick));
    drawings.forEach((draw) => draw());
    walk.keep();
    tell();
  };
  store.on("alternatives", fill);
  store.on("theme", () => requestAnimationFrame(() => drawings.forEach((draw) => draw())));
  store.on("trouble", () => { asked = false; tell(); });
  store.on(["revision", "strokes"], tell);
  tell();
  return element("div", { class: "alternatives" }, words, list, look);
}
