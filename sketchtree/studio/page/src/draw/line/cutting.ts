// What is left of a stroke when the eraser went over a part of it? The pieces outside; the one at its root keeps the id, so that what hangs on it stays.

import type { Stroke } from "../../messages";

const LEAST = 2; // points; and a piece shorter than the eraser is wide is no line

interface Node {
  x: number;
  y: number;
  pressure: number | null;
  time: number | null;
}

/**
 * Cut a disc out of a stroke. Returns the stroke itself where it is not touched, and nothing where nothing is left. `fresh` makes ids;
 * `rootAtEnd`: it was drawn from its tip to its root.
 */
export function cut(stroke: Stroke, x: number, y: number, radius: number, fresh: () => string, rootAtEnd = false): Stroke[] {
  const runs = outside(nodes(stroke), x, y, radius);
  if (runs === null) return [stroke];
  const joined = stroke.closed ? joinEnds(runs) : runs;
  const pieces = joined.filter((run) => run.length >= LEAST && long(run) > radius);
  const first = rootAtEnd ? pieces.length - 1 : 0;
  return pieces.map((run, at) => piece(stroke, run, at === first ? stroke.id : fresh()));
}

function nodes(stroke: Stroke): Node[] {
  const all: Node[] = [];
  for (let at = 0; at < stroke.xy.length / 2; at += 1) {
    all.push({ x: stroke.xy[2 * at]!, y: stroke.xy[2 * at + 1]!, pressure: stroke.pressure?.[at] ?? null, time: stroke.time?.[at] ?? null });
  }
  if (stroke.closed) all.push({ ...all[0]! });
  return all;
}

/** The runs of the line outside the disc, cut where they cross its edge; null: it is not touched. */
function outside(line: Node[], x: number, y: number, radius: number): Node[][] | null {
  const runs: Node[][] = [];
  let run: Node[] = [];
  let touched = false;
  const end = (): void => {
    if (run.length) runs.push(run);
    run = [];
  };
  for (let at = 0; at < line.length; at += 1) {
    const here = line[at]!;
    if (Math.hypot(here.x - x, here.y - y) > radius) run.push(here);
    else touched = true;
    const next = line[at + 1];
    if (!next) continue;
    for (const share of crossings(here, next, x, y, radius)) {
      touched = true;
      const cross = between(here, next, share);
      if (run.length) {
        run.push(cross);
        end();
      } else run.push(cross);
    }
  }
  end();
  return touched ? runs : null;
}

/** Where a span crosses the disc's edge, as shares of its length. */
function crossings(from: Node, to: Node, x: number, y: number, radius: number): number[] {
  const [dx, dy, fx, fy] = [to.x - from.x, to.y - from.y, from.x - x, from.y - y];
  const [a, b, c] = [dx * dx + dy * dy, 2 * (fx * dx + fy * dy), fx * fx + fy * fy - radius * radius];
  const root = b * b - 4 * a * c;
  if (a === 0 || root <= 0) return [];
  return [(-b - Math.sqrt(root)) / (2 * a), (-b + Math.sqrt(root)) / (2 * a)].filter((share) => share > 0 && share < 1);
}

function between(from: Node, to: Node, share: number): Node {
  const mix = (a: number | null, b: number | null): number | null => (a === null || b === null ? null : a + share * (b - a));
  return { x: from.x + share * (to.x - from.x), y: from.y + share * (to.y - from.y), pressure: mix(from.pressure, to.pressure), time: mix(from.time, to.time) };
}

/** An outline that was cut opens there: its last run goes on into its first. */
function joinEnds(runs: Node[][]): Node[][] {
  const first = runs[0];
  const last = runs[runs.length - 1];
  if (!first || !last || first === last || first[0]!.x !== last[last.length - 1]!.x || first[0]!.y !== last[last.length - 1]!.y) return runs;
  return [[...last, ...first.slice(1)], ...runs.slice(1, -1)];
}

function long(run: Node[]): number {
  return run.slice(1).reduce((sum, node, at) => sum + Math.hypot(node.x - run[at]!.x, node.y - run[at]!.y), 0);
}

function piece(stroke: Stroke, run: Node[], id: string): Stroke {
  return {
    ...stroke, id, closed: false, xy: run.flatMap((node) => [node.x, node.y]),
    pressure: stroke.pressure ? run.map((node) => node.pressure ?? 0) : null,
    time: stroke.time && !stroke.closed ? run.map((node) => node.time ?? 0) : null,
  };
}
