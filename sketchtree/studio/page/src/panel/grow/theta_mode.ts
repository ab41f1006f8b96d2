// Whose habit has the tree: the drawing's, as far as it shows one, or the template's alone?

import { choice } from "../../parts/choice";
import { element } from "../../parts/element";
import type { Store } from "../../store";

const MEANS = {
  fit: "Angles and lengths are learnt from your drawing, starting from the template.",
  fixed: "Angles and lengths are the template's, whatever you draw.",
};

export function thetaMode(store: Store): HTMLElement {
  const sentence = element("p", { class: "hint" }, MEANS.fit);
  const made = choice<"fit" | "fixed">({
    label: "Habit from", showLabel: true, testId: "theta-mode", value: "fit",
    options: [
      { value: "fit", label: "Drawing", title: MEANS.fit, testId: "theta-fit" },
      { value: "fixed", label: "Template", title: MEANS.fixed, testId: "theta-fixed" },
    ],
    onPick: (theta) => store.send({ type: "choose", options: { theta } }),
  });
  store.on("options", () => {
    const theta = store.known.options?.theta ?? "fit";
    made.set(theta);
    sentence.textContent = MEANS[theta];
  });
  return element("div", {}, made.root, sentence);
}
