// What is seen of matte and trunk over the photo? The page's own; nothing of the tree hangs on it.

import { choice } from "../../parts/choice";
import { element } from "../../parts/element";
import { slider } from "../../parts/slider";
import { toggle } from "../../parts/toggle";
import type { Store } from "../../store";

export function trunkView(store: Store): HTMLElement {
  const view = choice<Store["ui"]["matteView"]>({
    label: "Matte", showLabel: true, value: store.ui.matteView, testId: "matte-view",
    options: [
      { value: "off", label: "Off", title: "The photo alone", testId: "matte-off" },
      { value: "tint", label: "Tint", title: "The tree is tinted", testId: "matte-tint" },
      { value: "alone", label: "B/W", title: "White is tree, black is not", testId: "matte-alone" },
    ],
    onPick: (value) => store.set("matteView", value),
  });
  const strength = slider({
    label: "Strength", min: 0.1, max: 1, step: 0.05, value: store.ui.matteStrength, testId: "matte-strength", hint: "How strong the tint is",
    show: (value) => `${Math.round(100 * value)} %`, onInput: (value) => store.set("matteStrength", value),
  });
  const skeleton = toggle({ label: "Skeleton", on: store.ui.skeleton, testId: "trunk-skeleton", hint: "The trunk's middle line over the photo", onSwitch: (on) => store.set("skeleton", on) });
  const show = (): void => {
    view.set(store.ui.matteView);
    strength.root.hidden = store.ui.matteView !== "tint";
  };
  store.on("matteView", show);
  show();
  return element("div", {}, view.root, strength.root, skeleton.root);
}
