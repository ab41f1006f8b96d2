// The part at the side that is there while a photo is marked: how its tree grows, and what it wears.

import type { Store } from "../../store";
import { section } from "../side/section";
import { keepStrokes } from "./keep_strokes";
import { leafAmount } from "./leaf_amount";
import { library } from "./library";
import { morePhoto } from "./more";
import { photoColours } from "./photo_colours";

export function photoSection(store: Store): HTMLElement {
  const made = section("photo", "From the photo", true, leafAmount(store), photoColours(store), library(store), morePhoto(store), keepStrokes(store));
  const show = (): void => { made.root.hidden = !store.known.underlay?.photo; };
  store.on("underlay", show);
  show();
  return made.root;
}
