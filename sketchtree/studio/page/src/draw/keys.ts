// Which keys do what? One table; the sheet that `?` shows is made from it (sheet.ts). Keys of a field, a dialog or the 3D view are theirs.

import type { Store, Tool } from "../store";
import { type Desk, here, wrapped } from "./desk";
import { showAll } from "./following";
import type { Pen } from "./hand/pen";
import { moved } from "./line/reshaping";
import { selectedLimb } from "./selection";
import { erase, replace } from "./steps";
import { act } from "./trunk/points";
import { nextPoint, pointBetween } from "./trunk/points_keys";
import { brushOf } from "./trunk/sizes";
import { isOffered, way } from "./trunk/way";

const TURN = 15; // degrees
const WIDER = 1.25;
const CLOSER = 1.25;
const NUDGE = 2; // CSS pixels
const NEXT = { tint: "alone", alone: "off", off: "tint" } as const;

export interface Shortcut {
  keys: string[]; // as in `KeyboardEvent.key`, letters small; "Mod+" for Ctrl or ⌘
  shown: string; // for people
  does: string;
  group: "Tools" | "Trunk from scribbles" | "Edit" | "View" | "File";
  act: (desk: Desk) => void;
}

const tool = (key: string, name: Tool, does: string, group: Shortcut["group"] = "Tools"): Shortcut =>
  ({ keys: [key], shown: key.toUpperCase(), does, group, act: ({ store }) => { if (isOffered(store, name)) store.set("tool", name); } });

const scribble = (key: string, name: Tool, does: string): Shortcut => tool(key, name, does, "Trunk from scribbles");

const turn = (by: number) => ({ store }: Desk): void => store.set("turn", wrapped(Math.round((store.ui.turn + by) / TURN) * TURN));

const width = (factor: number) => ({ store }: Desk): void => {
  const sized = brushOf(store.ui.tool);
  store.set(sized, Number((store.ui[sized] * factor).toPrecision(3)));
};

const nudge = (dx: number, dy: number) => (desk: Desk): void => {
  const chosen = here(desk.store).filter((stroke) => desk.store.ui.selectedStrokes.includes(stroke.id));
  const step = NUDGE / desk.camera.scale;
  replace(desk.store, "move", new Map(chosen.map((stroke) => [stroke.id, [moved(stroke, dx * step, dy * step)]])));
};

const zoom = (factor: number) => ({ camera }: Desk): void => camera.zoom(factor, camera.width / 2, camera.height / 2);

export const SHORTCUTS: Shortcut[] = [
  tool("b", "branch", "Draw a branch"),
  tool("c", "crown", "Outline the crown"),
  tool("o", "obstacle", "Draw an obstacle"),
  tool("e", "erase", "Erase; with Alt only a part"),
  tool("v", "select", "Select, reshape; with Alt move"),
  tool("h", "pan", "Move the page; or hold Space"),
  { keys: ["["], shown: "[", does: "Thinner pen, smaller brush", group: "Tools", act: width(1 / WIDER) },
  { keys: ["]"], shown: "]", does: "Thicker pen, larger brush", group: "Tools", act: width(WIDER) },
  scribble("t", "foreground", "Scribble on the tree"),
  scribble("n", "background", "Scribble on what is not tree"),
  scribble("a", "matte_add", "Paint wood into the matte"),
  scribble("x", "matte_erase", "Paint out of the matte"),
  scribble("p", "vertices", "The contour's points"),
  scribble("r", "foot", "Where the trunk stands"),
  { keys: ["m"], shown: "M", does: "The matte: tint, black and white, none", group: "Trunk from scribbles", act: nextView },
  { keys: ["PageDown"], shown: "Page ↓ ↑", does: "The next point, the one before; Delete removes it", group: "Trunk from scribbles", act: (desk) => nextPoint(desk, 1) },
  { keys: ["PageUp"], shown: "", does: "", group: "Trunk from scribbles", act: (desk) => nextPoint(desk, -1) },
  { keys: ["Insert"], shown: "Insert", does: "A point half way to the next", group: "Trunk from scribbles", act: pointBetween },
  { keys: ["Mod+z"], shown: "Ctrl Z", does: "Undo", group: "Edit", act: ({ store }) => store.send({ type: "undo" }) },
  { keys: ["Mod+y", "Mod+Shift+z"], shown: "Ctrl Y", does: "Redo", group: "Edit", act: ({ store }) => store.send({ type: "redo" }) },
  { keys: ["Delete", "Backspace"], shown: "Delete", does: "Delete what is selected", group: "Edit", act: deleteSelected },
  { keys: ["f"], shown: "F", does: "Flip the branch to the other side", group: "Edit", act: ({ store }) => flip(store) },
  { keys: ["l"], shown: "L", does: "Lock the branch as it is, or free it", group: "Edit", act: ({ store }) => lock(store) },
  { keys: ["Mod+a"], shown: "Ctrl A", does: "Select every line of this page", group: "Edit", act: ({ store }) => selectAll(store) },
  { keys: ["Alt+ArrowLeft"], shown: "Alt ← ↑ → ↓", does: "Move what is selected a little", group: "Edit", act: nudge(-1, 0) },
  { keys: ["Alt+ArrowRight"], shown: "", does: "", group: "Edit", act: nudge(1, 0) },
  { keys: ["Alt+ArrowUp"], shown: "", does: "", group: "Edit", act: nudge(0, -1) },
  { keys: ["Alt+ArrowDown"], shown: "", does: "", group: "Edit", act: nudge(0, 1) },
  { keys: ["Escape"], shown: "Esc", does: "Let go", group: "Edit", act: letGo },
  { keys: ["ArrowLeft"], shown: "← →", does: "Turn the page by 15°", group: "View", act: turn(-TURN) },
  { keys: ["ArrowRight"], shown: "", does: "", group: "View", act: turn(TURN) },
  { keys: ["Home"], shown: "Home", does: "Back to the front", group: "View", act: ({ store }) => store.set("turn", 0) },
  { keys: ["Mod++", "Mod+=", "+", "="], shown: "+", does: "Closer", group: "View", act: zoom(CLOSER) },
  { keys: ["Mod+-", "-"], shown: "−", does: "Farther", group: "View", act: zoom(1 / CLOSER) },
  { keys: ["Mod+0", "0"], shown: "0", does: "Show the whole drawing", group: "View", act: showAll },
];

function letGo({ store, letGo: ofTool }: Desk): void {
  ofTool();
  store.set("selectedStrokes", []);
  store.set("selected", null);
}

/** A photo's matte is seen in another way. */
function nextView({ store }: Desk): void {
  if (way(store) === "scribbles") store.set("matteView", NEXT[store.ui.matteView]);
}

/** A limb chosen in the tree or by its stroke goes to the other side. */
export function flip(store: Store): void {
  const limb = selectedLimb(store);
  if (limb) store.send({ type: "flip", limb: limb.id });
}

export function lock(store: Store): void {
  const limb = selectedLimb(store);
  if (limb) store.send({ type: "lock", limb: limb.id, on: !limb.locked });
}

function deleteSelected(desk: Desk): void {
  const { store } = desk;
  if (store.ui.tool === "vertices") {
    if (desk.deed) act(desk, desk.deed);
    desk.deed = null;
    desk.tellDeed(0, 0); // nothing
    return desk.repaintLive();
  }
  const own = new Set(here(store).map((stroke) => stroke.id));
  const strokes = store.ui.selectedStrokes.filter((id) => own.has(id));
  if (strokes.length) erase(store, strokes);
  else if (store.ui.selected !== null) store.send({ type: "delete", limb: store.ui.selected });
}

function selectAll(store: Store): void {
  store.set("tool", "select");
  store.set("selectedStrokes", here(store).map((stroke) => stroke.id));
}

/** The name of a key with what is held, as in the table. */
export function pressed(event: Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">): string {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const letter = key.length === 1 && key >= "a" && key <= "z";
  return `${event.ctrlKey || event.metaKey ? "Mod+" : ""}${event.altKey ? "Alt+" : ""}${event.shiftKey && letter ? "Shift+" : ""}${key}`;
}

/** Whether a key pressed there is for typing or for a control of its own. */
export function isForOther(event: Event): boolean {
  const on = event.composedPath()[0];
  if (!(on instanceof HTMLElement)) return false;
  const types = on.isContentEditable || on.matches("input:not([type=range]):not([type=checkbox]), textarea, select");
  return types || on.closest("dialog[open], [popover]:popover-open") !== null;
}

export function listenKeys(root: HTMLElement, desk: Desk, pen: Pen): void {
  const table = new Map(SHORTCUTS.flatMap((shortcut) => shortcut.keys.map((key) => [key, shortcut] as const)));
  const room = root.getRootNode();
  const onDown = (event: Event): void => {
    if (!(event instanceof KeyboardEvent) || event.defaultPrevented || isForOther(event)) return;
    const on = event.composedPath()[0];
    if (event.key === " " && !(on instanceof HTMLButtonElement)) {
      event.preventDefault();
      pen.setSpace(true);
      return;
    }
    if (event.key === "Escape" && pen.busy) return pen.cancel();
    if (isControlsOwn(event, on)) return;
    const shortcut = table.get(pressed(event));
    if (!shortcut) return;
    event.preventDefault();
    if (pen.busy) return; // not in the middle of a line
    shortcut.act(desk);
  };
  room.addEventListener("keydown", onDown);
  room.addEventListener("keyup", (event) => { if (event instanceof KeyboardEvent && event.key === " ") pen.setSpace(false); });
}

/** Arrows in a slider or a row of choices move those. */
function isControlsOwn(event: KeyboardEvent, on: EventTarget | undefined): boolean {
  const moves = event.key.startsWith("Arrow") || event.key === "Home";
  return moves && !event.altKey && on instanceof HTMLElement && on.closest("input[type=range], [role=radiogroup], [role=slider], #tree, #strip") !== null;
}
