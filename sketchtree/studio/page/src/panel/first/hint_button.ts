// Calls the hint again: a small button in the page's corner.

import { button } from "../../parts/button";
import type { Store } from "../../store";
import type { Hint } from "./hint";

export function hintButton(store: Store, hint: Hint): HTMLButtonElement {
  const made = button({
    label: "What do I draw?", icon: "help", iconOnly: true, look: "quiet", testId: "hint-again",
    onPress: () => { if (hint.root.hidden) hint.show(); else hint.root.hidden = true; },
  });
  made.classList.add("hint-again");
  const follow = (): void => { made.hidden = store.known.strokes.size === 0 || (store.known.underlay?.photo ?? false); }; // of a photo a card says it
  store.on(["strokes", "underlay"], follow);
  follow();
  return made;
}
