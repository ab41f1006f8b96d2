// Where did the hand mean to go? A low-pass on the pen's path: strong while the pen is slow, when the hand shakes, weak while it is fast, when lag would show.
//
//     p ← p + a (raw − p)      a = 1 − exp(−2π c Δt)      c = c₀ + b |v|      c₀, b   cut-off at rest, and its growth with speed, by strength
//
// The filter lags behind the pen. At pen-up it goes over the path from its end as well, and the mean of both lags nowhere: it is steadier than either, begins where
// the pen came down and ends where it was lifted.

import type { Sample } from "./samples";

const FREE = 30; // Hz: cut-off of strength 0, nothing is held back
const HELD = 1.2; // Hz: of strength 1, at rest
const GROWTH = 0.006; // Hz for each px/s
const SPEED_MEMORY = 0.8; // share of the last speed that stays
const MOMENT = 56; // ms at either end
const NEAR = 8; // CSS pixels
const ENDS = 90; // ms: so far from an end the pass that is exact there still counts more

/** `pixel`: CSS pixels a page unit, so that the hand feels the same at any zoom. */
export function stabilise(raw: readonly Sample[], strength: number, pixel: number, lifted: boolean): Sample[] {
  if (raw.length < 3 || strength <= 0) return raw.slice();
  if (!lifted) return passed(raw, raw[0]!, strength, pixel);
  const other = back(raw);
  const mean = meanOf(passed(raw, about(raw, pixel), strength, pixel), back(passed(other, about(other, pixel), strength, pixel)));
  return back(led(back(led(mean, raw[0]!)), other[0]!));
}

/** Where a shaking hand began: the middle of its first moments, as long as it was still near. */
function about(raw: readonly Sample[], pixel: number): Sample {
  const first = raw[0]!;
  const near = raw.filter((sample) => sample.time - first.time < MOMENT && Math.hypot(sample.x - first.x, sample.y - first.y) * pixel < NEAR);
  const mean = (of: (sample: Sample) => number): number => near.reduce((sum, sample) => sum + of(sample), 0) / near.length;
  return { x: mean(({ x }) => x), y: mean(({ y }) => y), pressure: mean(({ pressure }) => pressure), time: first.time };
}

/** The line, led softly to begin at this place. */
function led(line: readonly Sample[], start: Sample): Sample[] {
  const first = line[0]!;
  return line.map((sample) => {
    const share = Math.max(0, 1 - (sample.time - first.time) / MOMENT) ** 2;
    return { ...sample, x: sample.x + share * (start.x - first.x), y: sample.y + share * (start.y - first.y) };
  });
}

/** The filter, once over the path, from this place on. */
function passed(raw: readonly Sample[], start: Sample, strength: number, pixel: number): Sample[] {
  const rest = FREE * (HELD / FREE) ** Math.min(1, strength);
  const steady: Sample[] = [start];
  let [vx, vy] = [0, 0]; // px/s, of the last moment: a shake to and fro is no speed
  for (let at = 1; at < raw.length; at += 1) {
    const now = raw[at]!;
    const before = raw[at - 1]!;
    const last = steady[at - 1]!;
    const seconds = Math.max(now.time - before.time, 1) / 1000;
    const fresh = ((1 - SPEED_MEMORY) * pixel) / seconds;
    vx = SPEED_MEMORY * vx + fresh * (now.x - before.x);
    vy = SPEED_MEMORY * vy + fresh * (now.y - before.y);
    const share = 1 - Math.exp(-2 * Math.PI * (rest + GROWTH * Math.hypot(vx, vy)) * seconds);
    const towards = (from: number, to: number): number => from + share * (to - from);
    steady.push({ x: towards(last.x, now.x), y: towards(last.y, now.y), pressure: towards(last.pressure, now.pressure), time: now.time });
  }
  return steady;
}

/** As if the pen had gone the other way. */
function back(line: readonly Sample[]): Sample[] {
  return line.map((sample) => ({ ...sample, time: -sample.time })).reverse();
}

function meanOf(there: readonly Sample[], again: readonly Sample[]): Sample[] {
  const [start, end] = [there[0]!.time, there[there.length - 1]!.time];
  return there.map((one, at) => {
    const other = again[at]!;
    const share = 0.5 * (1 + Math.max(0, 1 - (one.time - start) / ENDS) - Math.max(0, 1 - (end - one.time) / ENDS)); // of the pass that began here
    const mix = (a: number, b: number): number => share * a + (1 - share) * b;
    return { x: mix(one.x, other.x), y: mix(one.y, other.y), pressure: mix(one.pressure, other.pressure), time: one.time };
  });
}
