// How is a step of drawing said to the program? One request each, so that one undo takes it back.

import { isScribble } from "./trunk/scribbles";
import { MAX_POINTS, type SentStroke, type Stroke } from "../messages";
import type { Store } from "../store";
import type { Sample } from "./line/samples";

const DIGITS = "0123456789abcdefghijklmnopqrstuvwxyz";
const ID_LENGTH = 12;

/** A stroke id that no other page will make. */
export function freshId(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(ID_LENGTH));
  return `s-${[...bytes].map((byte) => DIGITS[byte % DIGITS.length]).join("")}`;
}

export interface Drawn {
  id: string;
  kind: Stroke["kind"];
  line: Sample[]; // thinned
  pressed: boolean;
  width: number;
  turn: number;
  grain: number; // page units: coordinates are rounded to it
}

/** The stroke that a line of the pen is. */
export function stroke({ id, kind, line, pressed, width, turn, grain }: Drawn): SentStroke {
  const kept = line.slice(0, MAX_POINTS);
  const start = kept[0]?.time ?? 0;
  const brushed = isScribble({ kind });
  const round = (value: number): number => Number((Math.round(value / grain) * grain).toPrecision(9));
  return {
    id, kind, xy: kept.flatMap((sample) => [round(sample.x), round(sample.y)]),
    pressure: pressed ? kept.map((sample) => Math.min(1, Math.max(0, Math.round(sample.pressure * 1000) / 1000))) : null,
    time: kept.map((sample) => Math.min(1e9, Math.max(0, Math.round(sample.time - start)))),
    width: kind === "branch" || brushed ? Number(width.toPrecision(4)) : null, closed: kind !== "branch" && !brushed, view_deg: turn,
  };
}

export function draw(store: Store, made: SentStroke, label: string = made.kind): void {
  store.send({ type: "strokes", label, put: [made] });
}

export function erase(store: Store, gone: string[]): void {
  if (gone.length) store.send({ type: "strokes", label: "erase", gone });
}

/** Strokes stand in place of others: those of the same id are replaced, those without successor go. */
export function replace(store: Store, label: string, instead: Map<string, Stroke[]>): void {
  const put = [...instead.values()].flat();
  const stay = new Set(put.map((one) => one.id));
  const gone = [...instead.keys()].filter((id) => !stay.has(id));
  if (put.length || gone.length) store.send({ type: "strokes", label, put, gone });
}
