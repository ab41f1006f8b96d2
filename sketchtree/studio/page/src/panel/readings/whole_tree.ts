// What can be done to all depths at once? Guess them anew, or exchange front and back.

import { block, button } from "../../parts/button";
import { element } from "../../parts/element";
import type { Store } from "../../store";

const POINTS = "the points behind the page say on which side each limb is";

export function wholeTree(store: Store): HTMLElement {
  const settle = button({
    label: "Guess depths anew", icon: "reset", testId: "settle", hint: "Find all depths again from the drawing alone. What you hold or have locked stays.",
    onPress: () => store.send({ type: "settle" }),
  });
  const mirror = button({
    label: "Mirror", icon: "mirror", testId: "mirror", hint: "Exchange front and back of the whole tree: one drawing can't tell them apart.",
    onPress: () => store.send({ type: "mirror" }),
  });
  const follow = (): void => {
    const reason = store.known.strokes.size === 0 ? "draw something first" : null;
    block(settle, reason);
    block(mirror, reason ?? (store.known.cloud ? POINTS : null));
  };
  store.on(["strokes", "cloud"], follow);
  follow();
  return element("div", { class: "buttons" }, settle, mirror);
}
