// The side of the points that the page faces is remembered with the drawing: it is told a moment after the page came to rest, and a drawing that is opened is shown from there.

import type { Store } from "../../store";

const REST = 500; // milliseconds

export function rememberTurn(store: Store): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let digest: string | null = null;
  store.on("turn", () => {
    const { points } = store.known;
    if (!store.known.cloud || !points || points.turn === store.ui.turn) return;
    store.known.points = { ...points, turn: store.ui.turn };
    clearTimeout(timer);
    timer = setTimeout(() => { if (store.known.cloud) store.send({ type: "turned", turn: store.ui.turn }); }, REST);
  });
  store.on("cloud", () => {
    const { cloud, points } = store.known;
    if ((cloud?.digest ?? null) === digest) return;
    digest = cloud?.digest ?? null;
    if (cloud) store.set("turn", points?.turn ?? 0);
  });
}
