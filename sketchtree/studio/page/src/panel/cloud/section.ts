// The part at the side that is there while points lie behind the page: how many, how large they are drawn, and what was done to those of the file.

import { element } from "../../parts/element";
import type { Store } from "../../store";
import { heldSlider } from "../held_slider";
import { section } from "../side/section";
import { measured } from "./words";

const USUAL = 2; // CSS pixels

export function cloudSection(store: Store): HTMLElement {
  const figures = element("p", { class: "hint", testId: "cloud-figures" });
  const remarks = element("ul", { class: "notes", testId: "cloud-remarks" });
  const made = section("cloud", "Point cloud", true, figures, pointSize(store), remarks);
  const show = (): void => {
    const { cloud } = store.known;
    made.root.hidden = cloud === null;
    if (!cloud) return;
    figures.textContent = measured(cloud.count ?? 0, cloud.height ?? 0);
    remarks.hidden = !cloud.remarks?.length;
    remarks.replaceChildren(...(cloud.remarks ?? []).map((text) => element("li", {}, text)));
  };
  store.on("cloud", show);
  show();
  return made.root;
}

function pointSize(store: Store): HTMLElement {
  return heldSlider<number>(store, ["points"], {
    label: "Point size", hint: "How large points are drawn.", min: 0.5, max: 8, step: 0.5, testId: "cloud-size", usual: USUAL, back: `back to ${USUAL} px`,
    knob: (value) => value, value: (knob) => knob, show: (value) => `${value} px`, now: () => store.known.points?.size, say: (size) => store.choosePoints({ size }, "point size"),
  });
}
