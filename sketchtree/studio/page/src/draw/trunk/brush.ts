// Scribbling on a photo, and painting its matte: a wide line, the same whatever the hand presses; a tap is a dot. What is under the brush is shown by its ring.

import type { SentStroke, Stroke } from "../../messages";
import { type Desk, isSamePage, pixels } from "../desk";
import type { Tool, Touch } from "../hand/touch";
import { insert, type Sample } from "../line/samples";
import { stabilise } from "../line/stabiliser";
import { thin } from "../line/thinning";
import { draw, freshId, stroke } from "../steps";
import { brushOf } from "./sizes";

const GRAIN = 0.02; // CSS pixels
const RING = 3; // CSS pixels: a smaller ring would not be seen
const LABELS: Partial<Record<Stroke["kind"], string>> = { foreground: "tree", background: "not tree", matte_add: "paint in", matte_erase: "paint out" };

export function brush(desk: Desk, kind: Stroke["kind"]): Tool {
  let raw: Sample[] = [];
  const width = (): number => desk.store.ui[brushOf(kind)];
  const ring = (at: Pick<Touch, "x" | "y"> | null): void => {
    desk.ring = at && width() / 2 > pixels(desk, RING) ? { x: at.x, y: at.y, radius: width() / 2 } : null;
  };
  const finished = (): SentStroke => {
    const line = thin(stabilise(raw, desk.store.ui.stabiliser, desk.camera.scale, true), desk.camera.scale);
    return stroke({ id: freshId(), kind, line, pressed: false, width: width(), turn: 0, grain: pixels(desk, GRAIN) });
  };
  const end = (): void => {
    raw = [];
    desk.live = null;
    desk.repaintLive();
  };
  return {
    get cursor() { return desk.ring ? "none" : "crosshair"; },
    down: (at) => {
      if (!isSamePage(desk.store.ui.turn, 0)) desk.store.set("turn", 0); // the photo lies on the front
      raw = [plain(at)];
      ring(at);
      desk.live = { kind, line: raw, pressed: false, width: width() };
      desk.repaintLive();
    },
    move: (fresh, predicted) => {
      if (!raw.length) return;
      insert(raw, fresh.map(plain));
      ring(fresh[fresh.length - 1] ?? null);
      desk.live = { kind, line: stabilise([...raw, ...predicted.map(plain)], desk.store.ui.stabiliser, desk.camera.scale, false), pressed: false, width: width() };
      desk.repaintLive();
    },
    up: (at) => {
      insert(raw, [plain(at)]);
      if (raw.length) draw(desk.store, finished(), LABELS[kind]);
      end();
    },
    cancel: end,
    hover: (at) => {
      ring(at);
      desk.repaintLive();
    },
  };
}

/** Pressure says nothing here. */
function plain(at: Touch): Sample {
  return { x: at.x, y: at.y, pressure: 0.5, time: at.time };
}
