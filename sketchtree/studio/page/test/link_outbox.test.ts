import { beforeEach, describe, expect, test } from "vitest";
import { pause } from "../src/link/line";
import { Outbox } from "../src/link/outbox";
import type { Changed, Request, SentStroke, Stroke } from "../src/messages";

const stroke = (id: string, x = 0): Stroke => ({ id, kind: "branch", xy: [x, 0, x, 10], pressure: null, time: null, width: 4, closed: false, view_deg: 0 });
const put = (...strokes: SentStroke[]): Request => ({ type: "strokes", label: "branch", put: strokes });
const gone = (...ids: string[]): Request => ({ type: "strokes", label: "erase", gone: ids });
const changed = (fields: Partial<Changed>): Changed => ({
  type: "changed", since: 1, revision: 2, put: [], gone: [], order: null, options: null, edits: null, trunk: null, underlay: null, underlay_changed: false, cloud: null, cloud_changed: false, points: null, name: null,
  undo: null, redo: null, saved: false, ...fields,
});

let sent: Request[];
let outbox: Outbox;

beforeEach(() => {
  sent = [];
  outbox = new Outbox((request) => sent.push(request));
});

const greet = (...strokes: Stroke[]): number[] => outbox.changed(changed({ since: 0, put: strokes }), true);

describe("without a line to the program", () => {
  test("what changes the drawing waits, and goes in order when there is one", () => {
    outbox.add(put(stroke("a")));
    outbox.add({ type: "choose", options: { seed: 3 } });
    outbox.add({ type: "undo" });
    expect(sent).toEqual([]);
    greet();
    expect(sent.map((request) => request.type)).toEqual(["strokes", "choose", "undo"]);
  });

  test("what is worth nothing later is dropped", () => {
    outbox.add({ type: "sketching", stroke: stroke("a") });
    outbox.add({ type: "glance", template: "oak" });
    outbox.add({ type: "hold", limb: "1", share: 0.5, depth: 2, live: true });
    greet();
    expect(sent).toEqual([]);
  });

  test("strokes are kept until the program has them", () => {
    greet();
    outbox.add(put(stroke("a")));
    outbox.broke();
    expect(outbox.strokes).toHaveLength(1);
    greet();
    expect(sent).toHaveLength(2);
    outbox.changed(changed({ put: [stroke("a")] }), false);
    expect(outbox.strokes).toEqual([]);
  });

  test("a stroke whose answer was lost is not sent again", () => {
    greet();
    outbox.add(put(stroke("a")));
    outbox.broke();
    greet(stroke("a"));
    expect(sent).toHaveLength(1);
    expect(outbox.size).toBe(0);
  });
});

describe("with a line", () => {
  beforeEach(() => { greet(); });

  test("requests go at once, and only strokes are kept", () => {
    outbox.add(put(stroke("a")));
    outbox.add({ type: "undo" });
    expect(sent).toHaveLength(2);
    expect(outbox.size).toBe(1);
  });

  test("one that is confirmed settles those sent before it: they were refused", () => {
    outbox.add(put(stroke("refused")));
    outbox.add(put(stroke("a")));
    outbox.changed(changed({ put: [stroke("a")] }), false);
    expect(outbox.size).toBe(0);
  });

  test("of two moves of a stroke each waits for its own answer", () => {
    outbox.add(put(stroke("a", 1)));
    outbox.add(put(stroke("a", 2)));
    outbox.changed(changed({ put: [stroke("a", 1)] }), false);
    expect(outbox.size).toBe(1);
    outbox.changed(changed({ put: [stroke("a", 2)] }), false);
    expect(outbox.size).toBe(0);
  });

  test("one answer may be of several requests", () => {
    outbox.add(put(stroke("a")));
    outbox.add(put(stroke("b")));
    outbox.add(gone("c"));
    outbox.changed(changed({ put: [stroke("a"), stroke("b")], gone: ["c"] }), false);
    expect(outbox.size).toBe(0);
  });

  test("a request that changed nothing is answered, too", () => {
    outbox.add(gone("never there"));
    outbox.changed(changed({ since: 5, revision: 5 }), false);
    expect(outbox.size).toBe(0);
  });

  test("other changes settle nothing", () => {
    outbox.add(put(stroke("a")));
    outbox.changed(changed({ put: [stroke("of another page")] }), false);
    outbox.changed(changed({ since: 2, revision: 3 }), false);
    expect(outbox.size).toBe(1);
  });

  test("what the program does not have when it tells everything again was refused", () => {
    outbox.add(put(stroke("refused")));
    greet();
    expect(outbox.size).toBe(0);
    expect(sent).toHaveLength(1);
  });
});

test("what an earlier visit left goes before what is new", () => {
  outbox = new Outbox((request) => sent.push(request), 100);
  outbox.add(put(stroke("new")));
  outbox.restore([{ key: 7, request: put(stroke("old")), sent: false }]);
  greet();
  expect(sent.map((request) => (request.type === "strokes" ? request.put![0]!.id : ""))).toEqual(["old", "new"]);
});

test("pauses between two tries grow, up to a few seconds", () => {
  const pauses = [0, 1, 2, 3, 10].map((tries) => pause(tries, 0.5));
  expect(pauses).toEqual([250, 500, 1000, 2000, 5000]);
});
