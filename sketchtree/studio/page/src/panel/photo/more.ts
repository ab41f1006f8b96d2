// What few want of a photo's tree: the paper's own rules, and growth by the image alone, as a comparison.

import { choice } from "../../parts/choice";
import { element } from "../../parts/element";
import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";
import { arrangement } from "./arrangement";

const RECTANGLE = "rectangle"; // the leaf model of the paper

export function morePhoto(store: Store): HTMLElement {
  const rule = choice<"contrast" | "paper">({
    label: "Foliage is", showLabel: true, value: "contrast", testId: "photo-rule",
    options: [
      { value: "contrast", label: "Contrast", title: "What differs from round the crown: blossom, autumn and grey photos too" },
      { value: "paper", label: "Green, red", title: "The most green or red of ten colours, as Tan et al. have it" },
    ],
    onPick: (foliage) => store.send({ type: "choose", options: { foliage } }),
  });
  const flat = toggle({
    label: "Flat leaves", on: false, testId: "photo-flat", hint: "Rectangles, as Tan et al. have them, instead of the species' leaves",
    onSwitch: (on) => store.send({ type: "choose", options: { leaf: on ? RECTANGLE : null } }),
  });
  const alone = toggle({
    label: "Image alone", on: false, testId: "photo-image-only", hint: "For comparison: grown towards the photo only, so that it is a fan from the side",
    onSwitch: (on) => store.send({ type: "choose", options: { alternate: !on } }),
  });
  store.on("options", () => {
    const { options } = store.known;
    rule.set(options?.foliage ?? "contrast");
    flat.set(options?.leaf === RECTANGLE);
    alone.set(options?.alternate === false);
  });
  return element("details", { class: "more", testId: "photo-more" }, element("summary", {}, "More"), rule.root, arrangement(store), flat.root, alone.root);
}
