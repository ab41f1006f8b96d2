// How does a season look in one small drawing? A twig: in blossom, in leaf, in colour, bare. Colours are in panel.css.

const SVG = "http://www.w3.org/2000/svg";
const TWIG = "M6 27C12 22 17 17 26 6 M14 20C14 16 13 13 11 10 M19 15C22 15.500 24.500 15.500 27 15";
const BLADE = "M0 0C2-3.200 6-3.200 8 0 6 3.200 2 3.200 0 0Z";
const LEAVES: [number, number, number][] = [[26, 6, -45], [11, 10, -110], [27, 15, 5], [10, 23, -150], [20, 21, 40], [17, 8, -80]];

export function seasonDrawing(season: string): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "0 0 32 32");
  svg.setAttribute("class", `season ${season}`);
  svg.setAttribute("aria-hidden", "true");
  svg.append(drawn("path", { d: TWIG, class: "twig" }));
  if (season !== "bare") svg.append(...LEAVES.map((leaf, index) => (season === "spring" && index % 2 === 0 ? blossom(leaf) : blade(leaf))));
  return svg;
}

function blade([x, y, turn]: [number, number, number]): SVGElement {
  return drawn("path", { d: BLADE, class: "blade", transform: `translate(${x} ${y}) rotate(${turn}) translate(-3 0)` });
}

function blossom([x, y]: [number, number, number]): SVGElement {
  return drawn("circle", { cx: String(x), cy: String(y), r: "3", class: "blossom" });
}

function drawn(tag: "path" | "circle", attributes: Record<string, string>): SVGElement {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}
