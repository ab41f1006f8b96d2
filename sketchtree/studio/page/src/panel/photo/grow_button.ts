// Grow the tree of the photo now, or stop growing it: one button whose word says which. It is not there while the tree is as it should be.

import { button, swapIcon } from "../../parts/button";
import type { Traced } from "../../messages";
import type { Store } from "../../store";
import { pressed } from "./words";

const WORDS = { grow: ["Grow the tree", "Grow it into the photo's foliage now"], stop: ["Stop", "Stop; the strokes stay"], nothing: ["Grow the tree", ""] } as const;

/** `traced`: what is being looked for before it grows. */
export function growButton(store: Store, testId = "photo-grow", traced: () => Traced | null = () => store.known.traced): HTMLButtonElement {
  const now = () => pressed(traced(), store.known.growing);
  const made = button({ label: WORDS.grow[0], icon: "play", testId, onPress: () => store.send({ type: "grow", on: now() !== "stop" }) });
  const show = (): void => {
    const press = now();
    made.hidden = press === "nothing";
    const [label, hint] = WORDS[press];
    made.querySelector("span")!.textContent = label;
    made.title = made.dataset["hint"] = hint;
    if (made.dataset["press"] !== press) swapIcon(made, press === "stop" ? "stop" : "play");
    made.dataset["press"] = press;
  };
  store.on(["traced", "growing"], show);
  show();
  return made;
}
