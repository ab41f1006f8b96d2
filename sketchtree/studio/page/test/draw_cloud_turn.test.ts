import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { rememberTurn } from "../src/draw/cloud/turn";
import type { Changed, Cloud, Request } from "../src/messages";
import { Store } from "../src/store";

const CLOUD: Cloud = { digest: "0".repeat(32), x: 0, y: 0, unit: 10, count: 2, coloured: false, height: 4, remarks: [] };

function opened(turn: number, digest = CLOUD.digest): Changed {
  return {
    type: "changed", since: 0, revision: 2, put: [], gone: [], order: null, options: null, edits: null, trunk: null, underlay: null, underlay_changed: true, cloud: { ...CLOUD, digest },
    cloud_changed: true, points: { shown: true, size: 2, traced: false, turn }, name: null, undo: null, redo: null, saved: true,
  } as unknown as Changed;
}

describe("the side of the points that the page faces", () => {
  let store: Store;
  let sent: Request[];
  beforeEach(() => {
    vi.useFakeTimers();
    store = new Store();
    sent = [];
    store.send = (request) => { sent.push(request); };
    rememberTurn(store);
  });
  afterEach(() => { vi.useRealTimers(); });

  test("is that of the drawing that is opened", () => {
    store.take(opened(45));
    expect(store.ui.turn).toBe(45);
    vi.runAllTimers();
    expect(sent).toEqual([]);
  });
  test("is told once the page came to rest", () => {
    store.take(opened(0));
    for (const turn of [10, 20, 30]) store.set("turn", turn);
    expect(sent).toEqual([]);
    vi.runAllTimers();
    expect(sent).toEqual([{ type: "turned", turn: 30 }]);
  });
  test("stays where the connection came again", () => {
    store.take(opened(0));
    store.set("turn", 30);
    store.take(opened(0));
    expect(store.ui.turn).toBe(30);
  });
  test("is nobody's business without points", () => {
    store.set("turn", 30);
    vi.runAllTimers();
    expect(sent).toEqual([]);
  });
});
