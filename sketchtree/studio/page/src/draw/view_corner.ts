// How is the page looked at? Which side of the tree it faces, how close it is, and buttons for both.

import { block, button } from "../parts/button";
import { element } from "../parts/element";
import type { IconName } from "../style/icons";
import { type Desk, isSamePage, wrapped } from "./desk";
import { showAll } from "./following";
import { way } from "./trunk/way";

const TURN = 15;
const CLOSER = 1.25;
const SIDES: Record<string, string> = { 0: "Front", 90: "From the right", 180: "From behind", "-90": "From the left" };

/** An azimuth in words. */
export function sideName(turn: number): string {
  const degrees = Math.round(turn);
  return SIDES[String(degrees)] ?? `${Math.abs(degrees)}° ${degrees > 0 ? "right" : "left"}`;
}

export function mountViewCorner(desk: Desk): HTMLElement {
  const { store, camera } = desk;
  const turn = (by: number) => (): void => store.set("turn", wrapped(Math.round((store.ui.turn + by) / TURN) * TURN));
  const closer = (factor: number) => (): void => camera.zoom(factor, camera.width / 2, camera.height / 2);
  const small = (label: string, icon: IconName, key: string, onPress: () => void): HTMLButtonElement =>
    button({ label, icon, iconOnly: true, look: "quiet", key, onPress });
  const front = button({ label: "Front", look: "quiet", hint: "Back to the front", key: "Home", testId: "page-side", onPress: () => store.set("turn", 0) });
  front.classList.add("page-side");
  const size = button({ label: "100 %", look: "quiet", hint: "Show the whole drawing", key: "0", testId: "page-zoom", onPress: () => showAll(desk) });
  size.classList.add("page-zoom");
  const show = (): void => {
    sides.hidden = way(store) === "scribbles" && isSamePage(store.ui.turn, 0); // the photo lies on the front
    front.querySelector("span")!.textContent = sideName(store.ui.turn);
    front.classList.toggle("turned", !isSamePage(store.ui.turn, 0));
    block(front, isSamePage(store.ui.turn, 0) ? "this is the front" : null);
    size.querySelector("span")!.textContent = `${Math.round(100 * camera.scale)} %`;
  };
  const sides = element("div", { class: "page-group", role: "group", aria: { label: "Side of the tree that the page faces" } },
    small("Turn the page left", "left", "ArrowLeft", turn(-TURN)), front, small("Turn the page right", "right", "ArrowRight", turn(TURN)));
  store.on(["turn", "trunk", "underlay"], show);
  camera.on(show);
  show();
  const [farther, nearer] = [small("Farther", "minus", "-", closer(1 / CLOSER)), small("Closer", "plus", "+", closer(CLOSER))];
  for (const one of [farther, nearer]) one.classList.add("page-step"); // where there is room
  return element("div", { class: "page-corner" },
    sides,
    element("div", { class: "page-group", role: "group", aria: { label: "Closer or farther" } }, farther, size, nearer));
}
