// How does a tree grow, as the program's `Ageing` has it, and in words?

export type Mode = "age" | "full" | "scale";

export interface Ageing {
  mode: Mode;
  bend: number; // degrees; above 0 branches rise
}

export const STRAIGHT: Ageing = { mode: "full", bend: 0 };
export const SECONDS = 10; // from seed to tree, unless said otherwise
export const BEND = 60; // degrees either way
const CATCH = 3; // so close to straight it is straight

export const MODES: { value: Mode; label: string; title: string }[] = [
  { value: "full", label: "Seedling", title: "The tree is small while it is young, and branches come by their age" },
  { value: "age", label: "By age", title: "Branches come by their age, and have their full size at once" },
  { value: "scale", label: "Larger", title: "The whole tree, from small to large" },
];

/** Straight, where a hand all but lets go of it. */
export function caught(degrees: number): number {
  return Math.abs(degrees) < CATCH ? 0 : degrees;
}

export function bendInWords(degrees: number): string {
  return degrees === 0 ? "straight on" : `${Math.abs(degrees)}° ${degrees > 0 ? "up" : "down"}`;
}
