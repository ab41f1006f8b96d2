import { describe, expect, test } from "vitest";
import css from "../src/style/tokens.css?raw";

function theme(selector: string): Map<string, string> {
  const block = css.split("}").find((part) => part.includes(`${selector} {`) && part.includes("--ink:"))!;
  return new Map([...block.matchAll(/(--[\w-]+):\s*(#[0-9a-f]{6})/g)].map((found) => [found[1]!, found[2]!]));
}

/** WCAG 2.2, relative luminance. */
function luminance(colour: string): number {
  const [red, green, blue] = [1, 3, 5].map((at) => {
    const value = parseInt(colour.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * red! + 0.7152 * green! + 0.0722 * blue!;
}

function contrast(a: string, b: string): number {
  const [light, dark] = [luminance(a), luminance(b)].sort((x, y) => y - x);
  return (light! + 0.05) / (dark! + 0.05);
}

const GROUNDS = ["--ground", "--panel", "--raised", "--paper"];
const TEXTS = ["--ink", "--ink-soft", "--accent", "--wrong", "--doubt"];

for (const selector of ['[data-theme="light"]', '[data-theme="dark"]']) {
  describe(selector, () => {
    const colours = theme(selector);
    const between = (a: string, b: string): number => contrast(colours.get(a)!, colours.get(b)!);

    for (const text of TEXTS) for (const ground of GROUNDS) {
      test(`${text} can be read on ${ground} (4.5)`, () => expect(between(text, ground)).toBeGreaterThanOrEqual(4.5));
    }
    test("text on what is chosen can be read (4.5)", () => {
      expect(between("--accent", "--accent-soft")).toBeGreaterThanOrEqual(4.5);
      expect(between("--ink", "--accent-soft")).toBeGreaterThanOrEqual(4.5);
      expect(between("--accent-ink", "--accent")).toBeGreaterThanOrEqual(4.5);
      expect(between("--ink", "--wrong-soft")).toBeGreaterThanOrEqual(4.5);
    });
    for (const mark of ["--edge", "--crown", "--obstacle"]) for (const ground of ["--panel", "--raised", "--paper"]) {
      test(`${mark} is seen on ${ground} (3)`, () => expect(between(mark, ground)).toBeGreaterThanOrEqual(3));
    }
  });
}
