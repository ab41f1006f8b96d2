// The growth of the tree, to keep: as a file that moves, or as a film. How it grows is chosen as in the strip under the tree.

import type { Choice } from "../../messages";
import { element } from "../../parts/element";
import { slider } from "../../parts/slider";
import type { Store } from "../../store";
import { SECONDS } from "../../tree/growth/ageing";
import { howItGrows } from "../../tree/growth/how";
import { plain } from "../figures";
import { detailChoice } from "./export_controls";
import type { ExportOptions } from "./export_options";

/** As the program's `Grown`. */
export interface GrownOptions {
  mode: "age" | "full" | "scale";
  bend: number;
  seconds: number;
  lod: ExportOptions["lod"];
}

export interface GrowthControls {
  root: HTMLElement;
  options: () => GrownOptions;
}

const [SHORTEST, LONGEST] = [2, 30]; // seconds
const FILMS = [".mp4", ".gif"];
const HINTS: Record<string, string> = { ".glb": "Blender, three.js, web", ".usdz": "iPhone, iPad", ".usd": "Houdini, Blender", ".mp4": "plays anywhere", ".gif": "for a page, a chat" };

export function growthControls(store: Store): GrowthControls {
  let seconds = SECONDS;
  const put = (value: number): void => { seconds = value; };
  const long = slider({
    label: "Takes", min: SHORTEST, max: LONGEST, step: 0.5, value: seconds, testId: "export-growth-seconds", hint: "From seed to tree",
    show: (value) => `${plain(value, 1)} s`, onInput: put, reset: { label: `${SECONDS} s`, onReset: () => { put(SECONDS); long.set(SECONDS); } },
  });
  let lod: ExportOptions["lod"] = 0;
  const detail = detailChoice("export-growth-lod", (value) => { lod = value; });
  const root = element("div", { class: "export-options" }, howItGrows(store, "export-growth", true), long.root, detail.root);
  return { root, options: () => ({ ...store.ui.ageing, seconds, lod }) };
}

/** Files that move, and films. */
export function movingGroups(moving: readonly Choice[]): { title: string; formats: { format: Choice; hint: string }[] }[] {
  const of = (films: boolean) => moving.filter((one) => FILMS.includes(one.name) === films).map((format) => ({ format, hint: HINTS[format.name] ?? "" }));
  return [{ title: "A tree that grows", formats: of(false) }, { title: "A film of its growth", formats: of(true) }].filter((group) => group.formats.length > 0);
}
