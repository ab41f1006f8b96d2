// The panel at the side: how the tree grows, what it wears, how the drawing is read, what was done by hand.

import { crownToggle } from "../grow/crown_toggle";
import { density } from "../grow/density";
import { fill } from "../grow/fill";
import { generations } from "../grow/generations";
import { gravity } from "../grow/gravity";
import { height } from "../grow/height";
import { light } from "../grow/light";
import { planar } from "../grow/planar";
import { seed } from "../grow/seed";
import { thetaMode } from "../grow/theta_mode";
import { editsList } from "../edits/list";
import { barkPicker } from "../looks/bark_picker";
import { leafPicker } from "../looks/leaf_picker";
import { seasonPicker } from "../looks/season_picker";
import { cloudSection } from "../cloud/section";
import { way } from "../../draw/trunk/way";
import { photoSection } from "../photo/section";
import { alternatives } from "../readings/alternatives";
import { uncertainty } from "../readings/uncertainty";
import { wholeTree } from "../readings/whole_tree";
import type { Store } from "../../store";
import { section } from "./section";

export function mountSide(root: HTMLElement, store: Store): void {
  const hand = section("edits", "Done by hand", true);
  hand.body.append(editsList(store, hand.mark));
  const part = (name: string, title: string, ...controls: ((store: Store) => HTMLElement)[]): HTMLElement =>
    section(name, title, true, ...controls.map((control) => control(store))).root;
  const depth = part("depth", "Depth", uncertainty, alternatives, wholeTree);
  const drawn = [generations, density, light, crownToggle, fill, planar, thetaMode].map((control) => control(store)); // a photo's tree grows in another way
  const [ofGenerations, ofDensity, ...others] = drawn;
  const tree = section("tree", "Tree", true, seed(store), ofGenerations!, ofDensity!, gravity(store), height(store), ...others).root;
  root.append(photoSection(store), cloudSection(store), tree, part("looks", "Looks", seasonPicker, leafPicker, barkPicker), depth, hand.root);
  const show = (): void => {
    const ofPhoto = store.known.photoTree !== null || way(store) === "scribbles" || (store.known.points?.traced ?? false);
    for (const one of [...drawn, depth, hand.root]) one.hidden = ofPhoto;
  };
  store.on(["photoTree", "trunk", "underlay", "points"], show);
}
