// Do the leaves have the colours in which the photo shows them, or the season's?

import { choice } from "../../parts/choice";
import type { Store } from "../../store";

export function leafColours(store: Store): HTMLElement {
  const made = choice<"photo" | "season">({
    label: "Colours", showLabel: true, value: "photo", testId: "photo-colours",
    options: [
      { value: "photo", label: "Photo", title: "Leaves in the colours in which the photo shows them" },
      { value: "season", label: "Season", title: "Leaves in the season's colours" },
    ],
    onPick: (colours) => store.send({ type: "choose", options: { colours } }),
  });
  store.on("options", () => made.set(store.known.options?.colours ?? "photo"));
  return made.root;
}
