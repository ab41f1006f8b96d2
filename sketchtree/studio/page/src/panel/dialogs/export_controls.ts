// The options of export as rows: level of detail, levels, leaves, game pack, wood, solid. What cannot go together is dimmed and says why.

import { choice } from "../../parts/choice";
import { element } from "../../parts/element";
import { toggle } from "../../parts/toggle";
import { blocked, changed, USUAL, type ExportOptions, type OptionName } from "./export_options";

export interface ExportControls {
  root: HTMLElement;
  options: () => ExportOptions;
}

export function exportControls(): ExportControls {
  let now = { ...USUAL };
  const change = (one: Partial<ExportOptions>): void => {
    now = changed(now, one);
    show();
  };
  const lod = choice<string>({
    label: "Detail", showLabel: true, value: "0", testId: "export-lod", onPick: (value) => change({ lod: Number(value) as ExportOptions["lod"] }),
    options: [
      { value: "0", label: "Full", title: "All triangles" }, { value: "1", label: "50 %", title: "At most half of the triangles" },
      { value: "2", label: "20 %", title: "At most a fifth of the triangles" }, { value: "3", label: "6 %", title: "For far away" },
    ],
  });
  const levels = choice<ExportOptions["levels"]>({
    label: "Levels of detail", showLabel: true, value: "one", testId: "export-levels", onPick: (value) => change({ levels: value }),
    options: [
      { value: "one", label: "One", title: "Only the detail chosen above" }, { value: "together", label: "In one file", title: "All levels and an impostor, in one file" },
      { value: "apart", label: "A file each", title: "All levels and an impostor, each in its own file, in a .zip" },
    ],
  });
  const leaves = choice<ExportOptions["leaves"]>({
    label: "Leaves", showLabel: true, value: "merged", testId: "export-leaves", onPick: (value) => change({ leaves: value }),
    options: [
      { value: "merged", label: "One mesh", title: "Opens everywhere" }, { value: "instanced", label: "Instanced", title: "A small file: a few leaves, drawn at many places (glTF and USD)" },
    ],
  });
  const wood = choice<"auto" | "one-piece" | "tubes">({
    label: "Wood", showLabel: true, value: "auto", testId: "export-wood", onPick: (value) => change({ wood: value === "auto" ? null : value }),
    options: [
      { value: "auto", label: "Auto", title: "One piece up to 2,000 limbs, tubes beyond" }, { value: "one-piece", label: "One piece", title: "Limbs joined into one closed surface" },
      { value: "tubes", label: "Tubes", title: "A light tube for each limb" },
    ],
  });
  const pack = toggle({ label: "Game pack", on: false, testId: "export-pack", hint: "All that a game needs: levels, wind, pivots, bones, collision (glTF and USD)", onSwitch: (on) => change({ pack: on ? "game" : null }) });
  const solid = toggle({ label: "Solid wood, for 3D printing", on: false, testId: "export-solid", hint: "The wood united into one solid that meets itself nowhere", onSwitch: (on) => change({ solid: on }) });
  const rows: [OptionName, HTMLElement][] = [["lod", lod.root], ["levels", levels.root], ["leaves", leaves.root], ["wood", wood.root], ["pack", pack.root], ["solid", solid.root]];
  const reasons = element("p", { class: "hint", role: "status" });
  const show = (): void => {
    const why = blocked(now);
    lod.set(String(now.lod));
    levels.set(now.levels);
    leaves.set(now.leaves);
    wood.set(now.wood ?? "auto");
    pack.set(now.pack !== null);
    solid.set(now.solid);
    for (const [name, row] of rows) row.inert = why[name] !== undefined;
    reasons.textContent = [...new Set(Object.values(why))].map((reason) => `${reason}.`).join(" ");
  };
  show();
  return { root: element("div", { class: "export-options" }, ...rows.map(([, row]) => row), reasons), options: () => now };
}
