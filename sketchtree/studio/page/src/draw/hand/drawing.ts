// Drawing a line: branch, crown or obstacle. The hand is steadied, what it does is shown in 3D now and then, and at pen-up the line is one stroke.

import type { Stroke } from "../../messages";
import type { Desk } from "../desk";
import { pixels } from "../desk";
import { insert, length, type Sample } from "../line/samples";
import { stabilise } from "../line/stabiliser";
import { thin } from "../line/thinning";
import { draw, freshId, stroke } from "../steps";
import type { Tool, Touch } from "./touch";

const SHORTEST = 4; // CSS pixels: less is a tap, not a line
const TELL_EVERY = 100; // ms between two `Sketching`
const GRAIN = 0.02; // CSS pixels

export function drawing(desk: Desk, kind: Stroke["kind"]): Tool {
  let raw: Sample[] = [];
  let pressed = false;
  let id = "";
  let turn = 0;
  let told = 0;

  const finished = (lifted: boolean): ReturnType<typeof stroke> => {
    const steady = stabilise(raw, desk.store.ui.stabiliser, desk.camera.scale, lifted);
    return stroke({ id, kind, line: thin(steady, desk.camera.scale), pressed, width: desk.store.ui.width, turn, grain: pixels(desk, GRAIN) });
  };
  const isLine = (): boolean => raw.length > 1 && length(raw) > pixels(desk, SHORTEST) && (kind === "branch" || raw.length > 2);
  const tell = (): void => {
    const now = performance.now();
    if (now - told < TELL_EVERY || !isLine()) return;
    told = now;
    desk.store.send({ type: "sketching", stroke: finished(false) });
  };
  const end = (): void => {
    if (told) desk.store.send({ type: "sketching", stroke: null });
    raw = [];
    told = 0;
    desk.live = null;
    desk.repaintLive();
  };
  return {
    cursor: "crosshair",
    down: (at) => {
      raw = [plain(at)];
      pressed = at.pen;
      id = freshId();
      turn = desk.store.ui.turn;
      desk.trouble = null;
    },
    move: (fresh, predicted) => {
      insert(raw, fresh.map(plain));
      const steady = stabilise([...raw, ...predicted.map(plain)], desk.store.ui.stabiliser, desk.camera.scale, false);
      desk.live = { kind, line: steady, pressed, width: desk.store.ui.width };
      desk.repaintLive();
      tell();
    },
    up: (at) => {
      insert(raw, [plain(at)]);
      if (isLine()) draw(desk.store, finished(true));
      end();
    },
    cancel: end,
    hover: () => {},
  };
}

/** A lifted pen presses with nothing; what it pressed before counts. */
function plain(at: Touch): Sample {
  return { x: at.x, y: at.y, pressure: at.pressure, time: at.time };
}
