// The tool rail: what the pen does, and what can be done to the branch that is chosen.

import { block, button, press, swapIcon } from "../parts/button";
import { element } from "../parts/element";
import type { Store, Tool } from "../store";
import type { IconName } from "../style/icons";
import { flip, lock } from "./keys";
import { selectedLimb } from "./selection";
import { isOffered, way } from "./trunk/way";

const TOOLS: { tool: Tool; icon: IconName; label: string; hint: string; key: string }[] = [
  { tool: "branch", icon: "branch", label: "Branch", hint: "Draw a branch, from where it grows to its tip", key: "B" },
  { tool: "crown", icon: "crown", label: "Crown", hint: "Outline the crown; it closes by itself", key: "C" },
  { tool: "obstacle", icon: "obstacle", label: "Obstacle", hint: "Outline a wall or a rock: branches keep out of it", key: "O" },
  { tool: "foreground", icon: "foreground", label: "Tree", hint: "Scribble on the tree: trunk, limbs, a few twigs", key: "T" },
  { tool: "background", icon: "background", label: "Not tree", hint: "Scribble on what is not tree: sky, ground, what stands behind", key: "N" },
  { tool: "matte_add", icon: "paintIn", label: "Paint in", hint: "Paint wood into the matte", key: "A" },
  { tool: "matte_erase", icon: "paintOut", label: "Paint out", hint: "Paint out of the matte what is no wood", key: "X" },
  { tool: "vertices", icon: "points", label: "Points", hint: "The contour's points: remove, add or merge them", key: "P" },
  { tool: "foot", icon: "pin", label: "Foot", hint: "Click where the trunk stands", key: "R" },
  { tool: "erase", icon: "erase", label: "Erase", hint: "Erase lines; with Alt only a part", key: "E" },
  { tool: "select", icon: "select", label: "Select", hint: "Select, reshape and move", key: "V" },
  { tool: "pan", icon: "pan", label: "Move the page", hint: "Move the page; or hold Space and drag", key: "H" },
];

export function mountTools(root: HTMLElement, store: Store): void {
  const made = TOOLS.map(({ tool, icon, label, hint, key }) => {
    const one = button({ label, icon, iconOnly: true, look: "quiet", hint, key, testId: `tool-${tool}`, onPress: () => store.set("tool", tool) });
    one.classList.add("tool");
    return { tool, one };
  });
  const offer = (): void => {
    for (const { tool, one } of made) one.hidden = !isOffered(store, tool);
    for (const one of branch) one.hidden = way(store) === "scribbles";
  };
  const branch = branchButtons(store);
  const showTool = (): void => made.forEach(({ tool, one }) => press(one, store.ui.tool === tool));
  store.on("tool", showTool);
  showTool();
  const gap = element("span", { class: "rail-gap", role: "separator" });
  branch.unshift(gap);
  root.append(...made.map(({ one }) => one), ...branch);
  store.on(["underlay", "trunk"], offer);
  offer();
}

function branchButtons(store: Store): HTMLElement[] {
  const quiet = { iconOnly: true, look: "quiet" } as const;
  const flips = button({
    ...quiet, label: "Flip", icon: "flip", hint: "Flip the branch to the other side of the page", key: "F", testId: "tool-flip", onPress: () => flip(store),
  });
  const locks = button({
    ...quiet, label: "Lock", icon: "lock", hint: "Lock the branch as it is, or free it", key: "L", testId: "tool-lock", onPress: () => lock(store),
  });
  const show = (): void => {
    const limb = selectedLimb(store);
    const reason = limb ? null : store.ui.selectedStrokes.length ? "its branch is not known yet" : "select a branch first";
    block(flips, reason);
    block(locks, reason);
    press(locks, limb?.locked ?? false);
    swapIcon(locks, limb?.locked ? "unlock" : "lock");
  };
  store.on(["selected", "selectedStrokes", "limbs"], show);
  show();
  for (const one of [flips, locks]) one.classList.add("tool");
  return [flips, locks];
}
