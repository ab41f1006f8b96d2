// Which season is it?

import type { Store } from "../../store";
import { picturePicker } from "./picture_picker";
import { seasonDrawing } from "./season_drawing";

export function seasonPicker(store: Store): HTMLElement {
  const made = picturePicker({ label: "Season", testId: "season-picker", child: "season", onPick: (season) => store.send({ type: "choose", options: { season } }) });
  made.root.classList.add("seasons");
  store.on("welcome", () => {
    const seasons = store.known.welcome?.seasons ?? [];
    made.fill(seasons.map((season) => ({ value: season, title: season.charAt(0).toUpperCase() + season.slice(1), picture: seasonDrawing(season) })));
  });
  store.on("options", () => made.set(store.known.options?.season ?? "summer"));
  return made.root;
}
