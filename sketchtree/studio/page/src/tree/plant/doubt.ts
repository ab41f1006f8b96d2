// How sure is each limb's depth? A colour from its standard deviation: blue where it is known, through pale, to orange where it is anybody's guess. The ramp can
// be told apart by colour-blind eyes. What was not drawn is grey.

import type { Limb } from "../../messages";
import type { Merged, MergedWood } from "./merge";

export const RAMP: readonly (readonly [number, number, number])[] = [[0x3b, 0x7d, 0xb8], [0x8f, 0xb8, 0xd3], [0xee, 0xe6, 0xd2], [0xee, 0xa0, 0x45], [0xcc, 0x52, 0x10]]; // sRGB
const GROWN: readonly [number, number, number] = [0x8c, 0x90, 0x8e];

/** The sd (metres) that wears the ramp's last colour: a round number that few limbs pass. */
export function most(limbs: readonly Limb[]): number {
  const all = limbs.flatMap((limb) => limb.sd).filter((sd) => sd > 0).sort((a, b) => a - b);
  const high = all[Math.floor(0.95 * (all.length - 1))] ?? 0.1;
  const step = 10 ** Math.floor(Math.log10(Math.max(high, 1e-3)));
  return [1, 2, 5, 10].map((times) => times * step).find((round) => round >= high) ?? high;
}

/** Colours of the vertices of each mesh of wood, linear, of 255. */
export function doubtColours(now: Merged, limbs: readonly Limb[]): Uint8Array[] {
  const drawn = new Map(limbs.map((limb) => [limb.id, limb] as const));
  const end = most(limbs);
  return now.wood.map((wood) => meshColours(wood, now.limbs.map((id) => drawn.get(id) ?? null), end));
}

function meshColours(wood: MergedWood, limbOf: readonly (Limb | null)[], end: number): Uint8Array {
  const colours = new Uint8Array(3 * wood.limb.length);
  const grown = linear(GROWN);
  for (let k = 0; k < wood.limb.length; k++) {
    const limb = limbOf[wood.limb[k]!];
    const sd = limb ? limb.sd[nearest(limb.path, wood.position, 3 * k)]! : -1;
    colours.set(sd < 0 ? grown : linear(ramp(sd / end)), 3 * k);
  }
  return colours;
}

/** Which point of the path is nearest to a vertex? */
function nearest(path: readonly number[], position: Float32Array, at: number): number {
  let [best, least] = [0, Infinity];
  for (let k = 0; k < path.length; k += 3) {
    const far = (path[k]! - position[at]!) ** 2 + (path[k + 1]! - position[at + 1]!) ** 2 + (path[k + 2]! - position[at + 2]!) ** 2;
    if (far < least) [best, least] = [k / 3, far];
  }
  return best;
}

/** The ramp's colour, sRGB, at 0-1. */
export function ramp(share: number): [number, number, number] {
  const at = Math.min(Math.max(share, 0), 1) * (RAMP.length - 1);
  const low = Math.min(Math.floor(at), RAMP.length - 2);
  return [0, 1, 2].map((k) => RAMP[low]![k]! + (RAMP[low + 1]![k]! - RAMP[low]![k]!) * (at - low)) as [number, number, number];
}

function linear(colour: readonly [number, number, number]): [number, number, number] {
  return colour.map((v) => Math.round(255 * (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4))) as [number, number, number];
}
