// From which side, and what is shown beside the tree? A row of buttons at the foot of the view.

import { block, button, press } from "../../parts/button";
import { element } from "../../parts/element";
import type { Store } from "../../store";
import type { View } from "../view";

export interface Shown {
  ink: boolean; // the drawing on its pages
  grid: boolean; // lines a metre apart
}

export function viewBar(view: View, store: Store, shown: Shown, changed: () => void): HTMLElement {
  const fly = (azimuth: number, elevation: number) => () => {
    if (store.ui.layout === "over") store.set("turn", azimuth); // there the page is turned, and the tree with it
    else view.showAll(azimuth, elevation);
  };
  const side = (label: string, key: string, azimuth: number, elevation: number): HTMLButtonElement =>
    button({ label, key, look: "quiet", testId: `view-${label.toLowerCase()}`, hint: `See the tree from ${label === "Top" ? "above" : `its ${label.toLowerCase()}`}`, onPress: fly(azimuth, elevation) });
  const figure = button({ label: "Person", icon: "person", iconOnly: true, look: "quiet", testId: "figure", hint: "A person of 1.8 m beside the tree", onPress: () => store.set("figure", !store.ui.figure) });
  const toggle = (what: keyof Shown, label: string, name: "branch" | "gallery", hint: string): HTMLButtonElement => {
    const made = button({ label, icon: name, iconOnly: true, look: "quiet", testId: `show-${what}`, hint, onPress: () => { shown[what] = !shown[what]; press(made, shown[what]); changed(); } });
    press(made, shown[what]);
    return made;
  };
  const points = button({ label: "Points", icon: "cloud", iconOnly: true, look: "quiet", testId: "show-points", hint: "The points of the scan", onPress: () => {
    const is = store.known.points?.shown ?? true;
    store.choosePoints({ shown: !is }, is ? "hide points" : "show points");
  } });
  const top = side("Top", "3", 0, 89.5);
  const follow = (): void => {
    press(figure, store.ui.figure);
    points.hidden = store.known.cloud === null;
    press(points, store.known.points?.shown ?? true);
    block(top, store.ui.layout === "over" ? "not while the page lies over the tree" : null);
  };
  store.on(["figure", "layout", "cloud", "points"], follow);
  follow();
  const bar = element("div", { class: "tree-bar", role: "toolbar", "aria-label": "View" },
    side("Front", "1", 0, 4), side("Side", "2", 90, 4), top,
    button({ label: "Whole tree", icon: "fit", iconOnly: true, look: "quiet", key: "Home", testId: "view-whole", onPress: () => view.showAll() }),
    element("span", { class: "tree-bar-gap" }),
    toggle("ink", "Drawing", "branch", "The drawing, as it lies on the tree"), toggle("grid", "Metres", "gallery", "Lines a metre apart on the ground"), points, figure);
  view.root.append(bar);
  new ResizeObserver(() => { view.foot = view.root.clientHeight - bar.offsetTop; }).observe(bar);
  return bar;
}
