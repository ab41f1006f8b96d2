// Which season is it?

import type { Store } from "../../store";
import { onList } from "../catalogue";
import { picturePicker } from "./picture_picker";
import { seasonDrawing } from "./season_drawing";

export function seasonPicker(store: Store): HTMLElement {
  const made = picturePicker({
    label: "Season", testId: "season-picker", child: "season", onPick: (season) => store.send({ type: "choose", options: { season } }),
  });
  made.root.classList.add("seasons");
  onList(store, (welcome) => welcome.seasons, (seasons) => {
    made.fill(seasons.map((season) => ({ value: season, title: season.charAt(0).toUpperCase() + season.slice(1), picture: seasonDrawing(season) })));
  });
  store.on("options", () => made.set(store.known.options?.season ?? "summer"));
  return made.root;
}
