// What could be drawn? A faint tree of a few lines, in the order one would draw it: trunk, branches, crown.

const SVG = "http://www.w3.org/2000/svg";
const LINES: [string, string][] = [
  ["ghost-trunk", "M151 268C150 230 147 196 150 160 152 128 149 100 152 66"],
  ["ghost-branch", "M149 190C128 172 106 160 80 152"],
  ["ghost-branch", "M150 165C172 146 198 134 226 128"],
  ["ghost-branch", "M151 128C134 112 116 98 96 88"],
  ["ghost-branch", "M151 108C166 92 182 80 204 70"],
  ["ghost-crown", "M92 190C52 184 44 146 62 120 48 84 82 48 116 46 138 18 184 24 200 48 238 56 258 96 244 130 258 164 232 190 204 188"],
  ["ghost-ground", "M96 269C124 266 178 266 210 269"],
];
const NUMBERS: [string, number, number][] = [["1", 168, 236], ["2", 70, 140], ["3", 250, 84]];

export function ghostDrawing(): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "30 10 240 270");
  svg.setAttribute("class", "ghost-drawing");
  svg.setAttribute("aria-hidden", "true");
  for (const [name, d] of LINES) {
    const line = document.createElementNS(SVG, "path");
    line.setAttribute("d", d);
    line.setAttribute("class", name);
    svg.append(line);
  }
  for (const [text, x, y] of NUMBERS) svg.append(number(text, x, y));
  return svg;
}

function number(text: string, x: number, y: number): SVGElement {
  const mark = document.createElementNS(SVG, "g");
  const ring = document.createElementNS(SVG, "circle");
  const figure = document.createElementNS(SVG, "text");
  for (const [name, value] of [["cx", x], ["cy", y], ["r", 9]] as const) ring.setAttribute(name, String(value));
  for (const [name, value] of [["x", x], ["y", y + 4], ["text-anchor", "middle"]] as const) figure.setAttribute(name, String(value));
  figure.textContent = text;
  mark.append(ring, figure);
  return mark;
}
