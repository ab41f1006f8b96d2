// Which limb is meant by a stroke, and which strokes by a limb? Choosing the one chooses the other.

import type { Limb } from "../messages";
import type { Store } from "../store";

export function limbOf(store: Store, stroke: string): Limb | null {
  return store.known.limbs.find((limb) => limb.strokes.includes(stroke)) ?? null;
}

export function selectedLimb(store: Store): Limb | null {
  return store.known.limbs.find((limb) => limb.id === store.ui.selected) ?? null;
}

export function pairSelections(store: Store): void {
  let pairing = false;
  const once = (what: () => void) => (): void => {
    if (pairing) return;
    pairing = true;
    what();
    pairing = false;
  };
  store.on("selected", once(() => {
    const strokes = selectedLimb(store)?.strokes.filter((id) => store.known.strokes.has(id)) ?? [];
    if (!same(strokes, store.ui.selectedStrokes)) store.set("selectedStrokes", strokes);
  }));
  store.on("selectedStrokes", once(() => {
    const first = store.ui.selectedStrokes[0];
    store.set("selected", first === undefined ? null : (limbOf(store, first)?.id ?? null));
  }));
  store.on("strokes", () => {
    const left = store.ui.selectedStrokes.filter((id) => store.known.strokes.has(id));
    if (!same(left, store.ui.selectedStrokes)) store.set("selectedStrokes", left);
  });
  store.on("limbs", once(() => { // the tree of a stroke just drawn and chosen came
    const first = store.ui.selectedStrokes[0];
    if (first !== undefined && store.ui.selected === null) store.set("selected", limbOf(store, first)?.id ?? null);
  }));
}

function same(a: string[], b: string[]): boolean {
  return a.length === b.length && a.every((id, at) => id === b[at]);
}
