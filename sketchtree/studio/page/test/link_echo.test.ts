import { beforeEach, describe, expect, test } from "vitest";
import { Echo } from "../src/link/echo";
import type { Stroke, Strokes } from "../src/messages";

const stroke = (id: string, x = 0): Stroke => ({ id, kind: "branch", xy: [x, 0, x, 10], pressure: null, time: null, width: 4, closed: false, view_deg: 0 });
const put = (...strokes: Stroke[]): Strokes => ({ type: "strokes", label: "branch", put: strokes });
const gone = (...ids: string[]): Strokes => ({ type: "strokes", label: "erase", gone: ids });
const told = (fields: { since?: number; put?: Stroke[]; gone?: string[]; order?: string[] }) => ({ since: 1, put: [], gone: [], order: null, ...fields });

let echo: Echo;
const shown = (): Record<string, number> => Object.fromEntries([...echo.shown.values()].map(({ id, xy }) => [id, xy[0]]));

beforeEach(() => {
  echo = new Echo();
  echo.changed(told({ since: 0, put: [stroke("a"), stroke("b")] }), []);
});

describe("what is on its way", () => {
  test("is shown over what the program has", () => {
    echo.send([put(stroke("a", 9)), gone("b")]);
    expect(shown()).toEqual({ a: 9 });
  });

  test("stays shown while the program answers something older", () => {
    const [first, second] = [put(stroke("a", 1)), put(stroke("a", 2))];
    echo.send([first], first);
    echo.send([first, second], second);
    echo.changed(told({ put: [stroke("a", 1)] }), [second]);
    expect(shown()).toEqual({ a: 2, b: 0 });
  });

  test("a stroke erased before the program has it does not come back with its answer", () => {
    const [drawn, erased] = [put(stroke("c")), gone("c")];
    echo.send([drawn, erased]);
    echo.changed(told({ put: [stroke("c")] }), [erased]);
    expect(shown()).toEqual({ a: 0, b: 0 });
  });

  test("is taken away when it was refused", () => {
    const [bad, good] = [put(stroke("bad")), put(stroke("c"))];
    echo.send([bad, good]);
    echo.changed(told({ put: [stroke("c")] }), []);
    expect(shown()).toEqual({ a: 0, b: 0, c: 0 });
  });

  test("is taken away when it was refused, and another is still on its way", () => {
    const [bad, good, later] = [put(stroke("bad")), put(stroke("c")), put(stroke("d"))];
    echo.send([bad, good, later]);
    echo.changed(told({ put: [stroke("c")] }), [later]);
    expect(shown()).toEqual({ a: 0, b: 0, c: 0, d: 0 });
  });

  test("lies over another drawing that is told whole", () => {
    const drawn = put(stroke("c"));
    echo.send([drawn]);
    echo.changed(told({ since: 0, put: [stroke("z")] }), [drawn]);
    expect(shown()).toEqual({ z: 0, c: 0 });
  });
});

describe("what another page did", () => {
  test("is shown", () => {
    echo.changed(told({ put: [stroke("c", 3)], gone: ["a"] }), []);
    expect(shown()).toEqual({ b: 0, c: 3 });
  });

  test("keeps the order that is told", () => {
    echo.changed(told({ put: [stroke("c")], order: ["c", "b", "a"] }), []);
    expect([...echo.shown.keys()]).toEqual(["c", "b", "a"]);
  });
});

test("the changes one by one show the same as all at once", () => {
  const requests = Array.from({ length: 60 }, (_, k) => (k % 7 === 6 ? gone(`s${k - 3}`) : put(stroke(`s${k % 11}`, k))));
  for (const request of requests) echo.send(requests.slice(0, requests.indexOf(request) + 1), request);
  const together = shown();
  requests.forEach((request, k) => echo.changed(told({ put: (request.put ?? []) as Stroke[], gone: request.gone ?? [] }), requests.slice(k + 1)));
  expect(shown()).toEqual(together);
});
