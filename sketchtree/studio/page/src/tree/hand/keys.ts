// What do keys do while the tree has the focus? Tab walks through the limbs, Escape lets go of them (and then Tab leaves), Enter takes the handle.

import type { Store } from "../../store";
import { turned, zoomed } from "../eye/eye";
import type { View } from "../view";
import type { Handles } from "./handles";
import type { Toolbar } from "./toolbar";

const STEP = 5; // degrees

export function listenKeys(view: View, store: Store, toolbar: Toolbar, handles: Handles): void {
  let leaving = false;
  view.root.addEventListener("focusin", (event) => { if (event.target === view.root) leaving = false; });

  const walk = (by: 1 | -1): boolean => {
    const ids = store.known.limbs.map((limb) => limb.id);
    const at = store.ui.selected === null ? (by === 1 ? -1 : ids.length) : ids.indexOf(store.ui.selected);
    const next = ids[at + by];
    if (leaving || next === undefined) return false; // the browser moves the focus on
    store.set("selected", next);
    return true;
  };
  const nearer = (factor: number) => () => view.look(zoomed(view.eye, factor, 0, 0, view.stage.high));
  const turn = (right: number, up: number) => () => view.look(turned(view.eye, right, up), true);
  const side = (azimuth: number, elevation: number) => () => view.showAll(azimuth, elevation);
  const chosen = (act: () => void) => () => { if (store.ui.selected !== null) act(); };
  const whole = (): void => view.showAll();

  const onKey: Record<string, () => void> = {
    ArrowLeft: turn(-STEP, 0), ArrowRight: turn(STEP, 0), ArrowUp: turn(0, STEP), ArrowDown: turn(0, -STEP),
    "+": nearer(1.2), "=": nearer(1.2), "-": nearer(1 / 1.2), Home: whole, "0": whole,
    "1": side(0, 4), "2": side(90, 4), "3": side(0, 89.5),
    f: chosen(() => toolbar.flip()), l: chosen(() => toolbar.toggleLock()), Delete: chosen(() => toolbar.remove()), Backspace: chosen(() => toolbar.remove()),
    Enter: chosen(() => handles.focus()),
    Escape: () => { leaving = true; store.set("selected", null); view.root.focus(); },
  };

  view.root.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const inView = event.target === view.root;
    if (event.key === "Tab") {
      if (inView && walk(event.shiftKey ? -1 : 1)) event.preventDefault();
      return;
    }
    const act = onKey[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act || (!inView && event.key === "Enter")) return; // Enter on a button presses it
    if (["f", "l", "Delete", "Backspace"].includes(event.key) && store.ui.selected === null) return;
    event.preventDefault();
    event.stopPropagation(); // the page's shortcuts do not act a second time
    act();
  });
}
