// Let the program mark the photo's main tree. There as long as nothing is marked.

import { isScribble } from "../../draw/trunk/scribbles";
import { button } from "../../parts/button";
import type { Store } from "../../store";

export function proposeButton(store: Store): HTMLButtonElement {
  const made = button({
    label: "Propose", testId: "photo-propose", hint: "Let crown and trunk of the main tree be found; it says when it is not sure", onPress: () => store.send({ type: "propose" }),
  });
  const show = (): void => {
    made.hidden = isMarked(store);
  };
  store.on(["strokes", "underlay"], show);
  show();
  return made;
}

/** Does a stroke mark its crown or a limb? */
export function isMarked({ known }: Store): boolean {
  return [...known.strokes.values()].some((stroke) => stroke.kind !== "obstacle" && !isScribble(stroke) && stroke.view_deg % 360 === 0);
}
