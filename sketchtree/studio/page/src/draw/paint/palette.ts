// Which colours does the canvas paint with? Those of style/tokens.css, read when the theme changes.

const NAMES = {
  paper: "--paper", line: "--paper-line", strong: "--paper-line-strong", ink: "--ink", soft: "--ink-soft", guide: "--ink-guide", accent: "--accent",
  crown: "--crown", crownFill: "--crown-fill", obstacle: "--obstacle", doubt: "--doubt-fill", wrong: "--wrong", traced: "--traced", tree: "--tree", beside: "--beside", matte: "--matte", handle: "--handle", handleEdge: "--handle-edge", raised: "--raised",
} as const;

export type Palette = Record<keyof typeof NAMES, string>;

export function readPalette(from: Element = document.documentElement): Palette {
  const style = getComputedStyle(from);
  return Object.fromEntries(Object.entries(NAMES).map(([name, variable]) => [name, style.getPropertyValue(variable).trim()])) as Palette;
}
