// In which order do the templates stand in the strip? As the drawing matches them, best first; those that were not compared come last, by their titles.

import type { Choice, Match } from "../../messages";

export interface Ranked {
  choice: Choice;
  bar: number | null; // 0-1, how like it is beside the others; null: not compared
}

export function rank(choices: readonly Choice[], matches: readonly Match[]): Ranked[] {
  const place = new Map(matches.map((match, index) => [match.name, index]));
  const scores = matches.map((match) => match.score);
  const best = Math.max(...scores);
  const worst = Math.min(...scores);
  const bar = (name: string): number | null => {
    const index = place.get(name);
    return index === undefined ? null : best > worst ? (matches[index]!.score - worst) / (best - worst) : 1;
  };
  const order = (choice: Choice): number => place.get(choice.name) ?? Infinity;
  const before = (a: Choice, b: Choice): number => (order(a) === order(b) ? a.title.localeCompare(b.title) : order(a) - order(b));
  return [...choices].sort(before).map((choice) => ({ choice, bar: bar(choice.name) }));
}

/** Does this choice answer what was typed? Every word of it, in title or name, in any case, accents aside. */
export function answers(choice: Choice, typed: string): boolean {
  const text = bare(`${choice.title} ${choice.name.replaceAll("_", " ")}`);
  return bare(typed).split(/\s+/).every((word) => text.includes(word));
}

function bare(text: string): string {
  return text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase().trim();
}

/** A title without what botanists add in brackets: a card has room for two short lines. */
export function commonName(title: string): string {
  return title.replace(/\s*\([^()]*\)\s*$/, "") || title;
}
