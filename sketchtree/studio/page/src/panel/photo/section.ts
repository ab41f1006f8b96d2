// The part at the side that is there while a photo is marked: in which way, how its tree grows, and what it wears.

import { way } from "../../draw/trunk/way";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import { section } from "../side/section";
import { contourByHand } from "../trunk/by_hand";
import { moreTrunk } from "../trunk/more";
import { trunkNumbers } from "../trunk/numbers";
import { trunkView } from "../trunk/view";
import { wayChoice } from "../trunk/way_choice";
import { keepStrokes } from "./keep_strokes";
import { leafAmount } from "./leaf_amount";
import { library } from "./library";
import { morePhoto } from "./more";
import { photoColours } from "./photo_colours";

export function photoSection(store: Store): HTMLElement {
  const crown = element("div", {}, leafAmount(store), photoColours(store), library(store), morePhoto(store), keepStrokes(store));
  const scribbles = element("div", { testId: "trunk-section" }, trunkView(store), trunkNumbers(store), contourByHand(store), moreTrunk(store));
  const made = section("photo", "From the photo", true, wayChoice(store), crown, scribbles);
  const show = (): void => {
    made.root.hidden = !store.known.underlay?.photo;
    scribbles.hidden = way(store) !== "scribbles";
    crown.hidden = !scribbles.hidden;
  };
  store.on(["underlay", "trunk"], show);
  show();
  return made.root;
}
