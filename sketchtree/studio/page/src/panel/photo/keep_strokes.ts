// The strokes that mark the photo, as a file: `sketchtree photo --strokes` reads it.

import { button } from "../../parts/button";
import { element } from "../../parts/element";
import { toast } from "../../parts/toast";
import type { Store } from "../../store";
import { ask, Refused } from "../ask";
import { download, nameOf } from "../download";

export function keepStrokes(store: Store): HTMLElement {
  const keep = async (): Promise<void> => {
    try {
      const answer = await ask("marks");
      download(await answer.blob(), nameOf(answer, `${store.known.name ?? "strokes"}.svg`));
    } catch (error) {
      if (error instanceof Refused) toast(error.message, { remedy: error.remedy, kind: "wrong" });
    }
  };
  const made = button({ label: "Save strokes (SVG)", icon: "save", testId: "photo-strokes", hint: "In the photo's pixels, for `sketchtree photo --strokes`", onPress: () => { void keep(); } });
  return element("div", { class: "buttons" }, made);
}
