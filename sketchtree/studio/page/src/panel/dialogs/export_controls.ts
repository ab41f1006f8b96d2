// The options of export as rows: level of detail, levels, leaves, wood, game pack, solid. What cannot go together is dimmed, and why is said below.

import { choice, type Choice } from "../../parts/choice";
import { element } from "../../parts/element";
import { toggle } from "../../parts/toggle";
import { blocked, changed, USUAL, type ExportOptions, type OptionName } from "./export_options";

export interface ExportControls {
  root: HTMLElement;
  options: () => ExportOptions;
}

interface Row {
  name: OptionName;
  root: HTMLElement;
  show: (options: ExportOptions) => void;
}

type Change = (one: Partial<ExportOptions>) => void;

export function exportControls(): ExportControls {
  let now = { ...USUAL };
  const change: Change = (one) => {
    now = changed(now, one);
    show();
  };
  const rows = [lod(change), levels(change), leaves(change), wood(change), pack(change), solid(change)];
  const reasons = element("p", { class: "hint", role: "status" });
  const show = (): void => {
    const why = blocked(now);
    for (const row of rows) {
      row.show(now);
      row.root.inert = why[row.name] !== undefined;
    }
    reasons.textContent = [...new Set(Object.values(why))].map((reason) => `${reason}.`).join(" ");
  };
  show();
  return { root: element("div", { class: "export-options" }, ...rows.map((row) => row.root), reasons), options: () => now };
}

/** Of how many triangles it is made. */
export function detailChoice(testId: string, onPick: (lod: ExportOptions["lod"]) => void): Choice<string> {
  return choice<string>({
    label: "Detail", showLabel: true, value: "0", testId, onPick: (value) => onPick(Number(value) as ExportOptions["lod"]),
    options: [
      { value: "0", label: "Full", title: "All triangles" },
      { value: "1", label: "50 %", title: "At most half of the triangles" },
      { value: "2", label: "20 %", title: "At most a fifth of the triangles" },
      { value: "3", label: "6 %", title: "For far away" },
    ],
  });
}

function lod(change: Change): Row {
  const made = detailChoice("export-lod", (value) => change({ lod: value }));
  return { name: "lod", root: made.root, show: (options) => made.set(String(options.lod)) };
}

function levels(change: Change): Row {
  const made = choice<ExportOptions["levels"]>({
    label: "Levels of detail", showLabel: true, value: "one", testId: "export-levels", onPick: (value) => change({ levels: value }),
    options: [
      { value: "one", label: "One", title: "Only the detail chosen above" },
      { value: "together", label: "In one file", title: "All levels and an impostor, in one file" },
      { value: "apart", label: "A file each", title: "All levels and an impostor, each in its own file, in a .zip" },
    ],
  });
  return { name: "levels", root: made.root, show: (options) => made.set(options.levels) };
}

function leaves(change: Change): Row {
  const made = choice<ExportOptions["leaves"]>({
    label: "Leaves", showLabel: true, value: "merged", testId: "export-leaves", onPick: (value) => change({ leaves: value }),
    options: [
      { value: "merged", label: "One mesh", title: "Opens everywhere" },
      { value: "instanced", label: "Instanced", title: "A small file: a few leaves, drawn at many places (glTF and USD)" },
    ],
  });
  return { name: "leaves", root: made.root, show: (options) => made.set(options.leaves) };
}

function wood(change: Change): Row {
  const made = choice<"auto" | "one-piece" | "tubes">({
    label: "Wood", showLabel: true, value: "auto", testId: "export-wood", onPick: (value) => change({ wood: value === "auto" ? null : value }),
    options: [
      { value: "auto", label: "Auto", title: "One piece up to 2,000 limbs, tubes beyond" },
      { value: "one-piece", label: "One piece", title: "Limbs joined into one closed surface" },
      { value: "tubes", label: "Tubes", title: "A light tube for each limb" },
    ],
  });
  return { name: "wood", root: made.root, show: (options) => made.set(options.wood ?? "auto") };
}

function pack(change: Change): Row {
  const made = toggle({
    label: "Game pack", on: false, testId: "export-pack", hint: "All that a game needs: levels, wind, pivots, bones, collision (glTF and USD)",
    onSwitch: (on) => change({ pack: on ? "game" : null }),
  });
  return { name: "pack", root: made.root, show: (options) => made.set(options.pack !== null) };
}

function solid(change: Change): Row {
  const made = toggle({
    label: "Solid wood, for 3D printing", on: false, testId: "export-solid", hint: "The wood united into one solid that meets itself nowhere",
    onSwitch: (on) => change({ solid: on }),
  });
  return { name: "solid", root: made.root, show: (options) => made.set(options.solid) };
}
