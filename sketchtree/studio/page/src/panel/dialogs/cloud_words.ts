// What is chosen when a point cloud is opened, as the program is told; and what is said of it. Words and numbers alone: no element is touched.

import { LOWEST_PLANT, TALLEST_PLANT, type CloudReading } from "../../messages";

export type Up = "auto" | "y" | "z";
export type Unit = "m" | "cm" | "mm" | "height";

export interface Said {
  up: Up;
  unit: Unit;
  height: string; // as it was typed, metres
}

export const HOW_UP: Record<Up, string> = {
  auto: "By what the file says, by ground, trunk and crown.",
  y: "As most modelling programs write it.",
  z: "As most scanners write it.",
};
export const HOW_UNIT: Record<Unit, string> = {
  m: "As most scans are.",
  cm: "As some modelling programs write it.",
  mm: "As scanners of small things write it.",
  height: "Where the unit is not known: points that came of photos, for one.",
};
const METRES: Record<Exclude<Unit, "height">, number> = { m: 1, cm: 0.01, mm: 0.001 };

/** How the points are to be read, or what is wrong with the height that was typed. */
export function reading(said: Said): { reading: CloudReading } | { wrong: string } {
  if (said.unit !== "height") return { reading: { up: said.up, unit: METRES[said.unit] } };
  const height = said.height.trim() === "" ? NaN : Number(said.height);
  if (!Number.isFinite(height)) return { wrong: "How high is the plant? Give metres." };
  if (height < LOWEST_PLANT || height > TALLEST_PLANT) return { wrong: `A plant of ${said.height.trim()} m is out of range: ${LOWEST_PLANT} to ${TALLEST_PLANT} m can be read.` };
  return { reading: { up: said.up, height } };
}
