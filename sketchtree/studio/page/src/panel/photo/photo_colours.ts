// Do leaves and bark have the colours in which the photo shows them, or their own?

import { choice } from "../../parts/choice";
import { element } from "../../parts/element";
import type { Store } from "../../store";

export function photoColours(store: Store): HTMLElement {
  const leaves = choice<"photo" | "season">({
    label: "Leaf colours", showLabel: true, value: "photo", testId: "photo-colours",
    options: [
      { value: "photo", label: "Photo", title: "Leaves in the colours in which the photo shows them" },
      { value: "season", label: "Season", title: "Leaves in the season's colours" },
    ],
    onPick: (colours) => store.send({ type: "choose", options: { colours } }),
  });
  const bark = choice<"photo" | "species">({
    label: "Bark colour", showLabel: true, value: "photo", testId: "photo-bark",
    options: [
      { value: "photo", label: "Photo", title: "Bark in the colour in which the photo shows it" },
      { value: "species", label: "Species", title: "Bark in its own colour" },
    ],
    onPick: (colour) => store.send({ type: "choose", options: { bark_colour: colour } }),
  });
  store.on("options", () => {
    leaves.set(store.known.options?.colours ?? "photo");
    bark.set(store.known.options?.bark_colour ?? "photo");
  });
  return element("div", {}, leaves.root, bark.root);
}
