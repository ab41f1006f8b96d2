// How many points has the contour, over which gaps does the trunk go, how many levels of branches are grafted on?

import { element } from "../../parts/element";
import type { Store } from "../../store";
import { counted } from "../figures";
import { trunkSlider } from "./trunk_slider";

const FEWEST = 3;
const MOST = 400; // there are seldom more worth having; a project may say so
const WIDEST = 40; // pixels
const LEVELS = 5;

export function trunkNumbers(store: Store): HTMLElement {
  const found = (): number => store.known.found?.vertices.reduce((sum, ring) => sum + ring.length / 2, 0) ?? 0;
  const vertices = trunkSlider(store, {
    of: "vertices", label: "Contour points", hint: "How many the contour keeps: few find thick limbs only, many find each bump.", min: Math.log(FEWEST), max: Math.log(MOST), step: 0.01, usual: null,
    knob: (value) => Math.log(value ?? (found() || 40)), value: (knob) => Math.round(Math.exp(knob)), show: (value) => (value === null ? (found() ? `automatic: ${found()}` : "automatic") : String(value)),
  });
  const gap = trunkSlider(store, {
    of: "gap", label: "Gaps", hint: "Pieces of the matte so near belong to the tree.", min: 0, max: Math.sqrt(WIDEST), step: 0.05, usual: 3,
    knob: (value) => Math.sqrt(value ?? 3), value: (knob) => Math.round(knob * knob), show: (value) => `${value ?? 3} px`,
  });
  const levels = trunkSlider(store, {
    of: "levels", label: "Levels", hint: "Of branches that are grafted on; 0: only what the photo shows.", min: 0, max: LEVELS, step: 1, usual: 3,
    knob: (value) => value ?? 3, value: Math.round, show: (value) => (value === 0 ? "only the trunk" : counted(value ?? 3, "level", "levels")),
  });
  return element("div", {}, vertices, gap, levels);
}
