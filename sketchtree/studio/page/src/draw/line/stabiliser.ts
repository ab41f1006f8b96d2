// Where did the hand mean to go? A low-pass on the pen's path: strong while the pen is slow, when the hand shakes, weak while it is fast, when lag would show.
//
//     p ← p + a (raw − p)      a = 1 − exp(−2π c Δt)      c = c₀ + b |v|      c₀, b   cut-off at rest, and its growth with speed, by strength
//
// The filter lags behind the pen; at pen-up the line is led on to where the pen was lifted.

import type { Sample } from "./samples";

const FREE = 30; // Hz: cut-off of strength 0, nothing is held back
const HELD = 1.2; // Hz: of strength 1, at rest
const GROWTH = 0.006; // Hz for each px/s
const SPEED_MEMORY = 0.8; // share of the last speed that stays
const CATCH_UP = 4; // points that lead the lagging end to the pen

/** `pixel`: CSS pixels a page unit, so that the hand feels the same at any zoom. */
export function stabilise(raw: readonly Sample[], strength: number, pixel: number, lifted: boolean): Sample[] {
  if (raw.length < 3 || strength <= 0) return raw.slice();
  const rest = FREE * (HELD / FREE) ** Math.min(1, strength);
  const steady: Sample[] = [raw[0]!];
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
  return lifted ? leadOn(steady, raw[raw.length - 1]!) : steady;
}

/** From the end that lags to the place where the pen was lifted. */
function leadOn(steady: Sample[], end: Sample): Sample[] {
  const last = steady[steady.length - 1]!;
  for (let step = 1; step <= CATCH_UP; step += 1) {
    const share = step / CATCH_UP;
    steady.push({ x: last.x + share * (end.x - last.x), y: last.y + share * (end.y - last.y), pressure: last.pressure, time: end.time + step });
  }
  return steady;
}
