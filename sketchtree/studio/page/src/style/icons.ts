// The studio's icons: lines on a 20 × 20 grid, drawn for it, in the colour of the text.

const PATHS = {
  branch: "M10 18c0-6 0-9-1-16 M9.6 11C7 9.5 5.5 8 4.5 5 M10 8.5c2.5-1 4-2.5 5.2-5",
  crown: "M6 15.5C2.5 15 2 11 4.5 9.5 3.5 6 6.5 3.5 9 4.5c2-2.5 6.5-1 6 2.5 3 1 3 5-.5 6-1 2.8-3.5 3.5-5 2-1 1-2.5 1.2-3.5.5Z",
  obstacle: "M3 16.5V7l7-3.5L17 7v9.5Z M3.5 13 10 6 M6 16 15 6.5 M11.5 16l5-5.5",
  erase: "M7.5 16.5 3 12l8.5-8.5 5.5 5.5-7.5 7.5Z M7.2 7.8l5.5 5.5 M7.5 16.5H17",
  select: "M5 3v12.5l3.3-3.2 2.2 4.7 2-.9-2.2-4.6H15Z",
  pan: "M6 10.5V5.8a1.2 1.2 0 0 1 2.4 0V9.5 4a1.2 1.2 0 0 1 2.4 0v5.5-4.3a1.2 1.2 0 0 1 2.4 0V10.5 7.3a1.2 1.2 0 0 1 2.3 0V12c0 3.5-2"
    + " 5.5-5 5.5-2.5 0-3.6-1-4.7-3L4 11.5c-.6-1.2.8-2 1.6-1.1L7 12",
  foreground: "M10 17.5V11 M10 13.5 6.5 10 M10 11c1.5-1 2.5-2 3-3.5 M3 6.5c1-2.5 3.5-4 7-4s6 1.5 7 4 M15 14h4 M17 12v4",
  background: "M10 17.5V11 M10 13.5 6.5 10 M10 11c1.5-1 2.5-2 3-3.5 M3 6.5c1-2.5 3.5-4 7-4s6 1.5 7 4 M15 14h4",
  paintIn: "M11.5 3.5l4 4-6.5 6.5c-1 1-3 1.5-5 1.5 0-2 .5-4 1.5-5Z M13.5 16h5 M16 13.5v5",
  paintOut: "M11.5 3.5l4 4-6.5 6.5c-1 1-3 1.5-5 1.5 0-2 .5-4 1.5-5Z M13.5 16h5",
  points: "M4.5 15.5 8 6.5 15 4.5 15.5 14Z M8 4.7a1.8 1.8 0 1 1 0 3.6 1.8 1.8 0 0 1 0-3.6 M4.5 13.7a1.8 1.8 0 1 1 0 3.6 1.8 1.8 0 0 1 0-3.6 M15.5 12.2a1.8 1.8 0 1 1 0 3.6 1.8 1.8 0 0 1 0-3.6",
  flip: "M10 2.5v15 M7.5 5.5 2.5 14.5h5Z M12.5 5.5l5 9h-5Z",
  mirror: "M10 3v2 M10 7.5v2 M10 12v2 M10 16v1.5 M7 6 3 10l4 4 M13 6l4 4-4 4",
  lock: "M4.5 9h11v8h-11Z M7 9V6.5a3 3 0 0 1 6 0V9 M10 12v2",
  unlock: "M4.5 9h11v8h-11Z M7 9V5.5a3 3 0 0 1 5.7-1.3 M10 12v2",
  new: "M5 2.5h6.5L15 6v11.5H5Z M11.5 2.5V6H15 M10 9.5v5 M7.5 12h5",
  open: "M2.5 16V4.5H8L9.5 6.5H16v2.5 M2.5 16 5 9h13l-2.5 7Z",
  save: "M3.5 3.5H13l3.5 3.5v9.5h-13Z M6.5 3.5V8h6V3.5 M6 16.5V11.5h8v5",
  undo: "M7 4 3.5 7.5 7 11 M3.5 7.5H12a4.2 4.2 0 0 1 0 8.5H7.5",
  redo: "M13 4l3.5 3.5L13 11 M16.5 7.5H8a4.2 4.2 0 0 0 0 8.5h4.5",
  beside: "M2.5 4h15v12h-15Z M10 4v12",
  over: "M2.5 3h10.5v9.5H2.5Z M7 7.5h10.5V17H7Z",
  sun: "M10 6.5a3.5 3.5 0 1 1 0 7 3.5 3.5 0 0 1 0-7 M10 2v1.5 M10 16.5V18 M2 10h1.5 M16.5 10H18 M4.3 4.3l1.1 1.1 M14.6 14.6l1.1 1.1 M15.7"
    + " 4.3l-1.1 1.1 M5.4 14.6l-1.1 1.1",
  moon: "M16.5 12.2A7 7 0 0 1 7.8 3.5a7 7 0 1 0 8.7 8.7Z",
  gallery: "M3 3.5h6v6H3Z M11.5 3.5h5.5v6h-5.5Z M3 12h6v5H3Z M11.5 12h5.5v5h-5.5Z",
  export: "M10 12.5V3 M6.5 6.5 10 3l3.5 3.5 M3.5 11v6h13v-6",
  settings: "M3 5.5h7 M14 5.5h3 M3 10h2 M9 10h8 M3 14.5h8 M15 14.5h2 M12 3.5v4 M7 8v4 M13 12.5v4",
  help: "M7 7.5a3 3 0 1 1 4.2 2.8c-.8.4-1.2.9-1.2 1.9 M10 15.2v.3",
  close: "M5 5l10 10 M15 5 5 15",
  fit: "M3 7V3h4 M13 3h4v4 M17 13v4h-4 M7 17H3v-4",
  plus: "M10 4v12 M4 10h12",
  minus: "M4 10h12",
  camera: "M2.5 6h3.5l1.5-2h5L14 6h3.5v10h-15Z M10 8a2.7 2.7 0 1 1 0 5.4A2.7 2.7 0 0 1 10 8",
  film: "M3 4h14v12H3Z M6 4v12 M14 4v12 M3 8h3 M3 12h3 M14 8h3 M14 12h3",
  copy: "M7 7h10v10H7Z M13 7V3H3v10h4",
  check: "M4 10.5l4 4 8-9",
  warn: "M10 3 2.5 16.5h15Z M10 8v4 M10 14.3v.2",
  dice: "M4 4h12v12H4Z M7.5 7.5h.01 M12.5 7.5h.01 M10 10h.01 M7.5 12.5h.01 M12.5 12.5h.01",
  eye: "M2 10c4-6.5 12-6.5 16 0-4 6.5-12 6.5-16 0Z M10 7.5a2.5 2.5 0 1 1 0 5 2.5 2.5 0 0 1 0-5",
  person: "M10 2.5a2 2 0 1 1 0 4 2 2 0 0 1 0-4 M6.5 12V8.5h7V12 M8.2 9v8.5 M11.8 9v8.5",
  trash: "M3.5 5.5h13 M7.5 5.5V3h5v2.5 M5 5.5l.8 12h8.4l.8-12 M8.5 9v5 M11.5 9v5",
  leaf: "M4 16C4 8 8 4 16.5 3.5 16.5 12 12 16 4 16Z M4 16 11.5 8.5",
  picture: "M3 4h14v12H3Z M3 13.5l4-4 3.5 3.5 2.5-2.5 4 4 M12.5 7.3h.01",
  cloud: "M10 3h.01 M7 6h.01 M11 7h.01 M14 6h.01 M5 9h.01 M9 10h.01 M13 10h.01 M16 9h.01 M7 12.5h.01 M11 13h.01 M10 16h.01 M9.5 18h.01",
  pin: "M7 3h6l-1 5 2.5 3h-9L8 8Z M10 11v6.5",
  play: "M6 4v12l10-6Z",
  pause: "M6.5 4v12 M13.5 4v12",
  loop: "M4 9a4.5 4.5 0 0 1 4.5-4.5H15 M12.5 2 15 4.5 12.5 7 M16 11a4.5 4.5 0 0 1-4.5 4.5H5 M7.5 18 5 15.5 7.5 13",
  sprout: "M10 17.5V9 M10 12.5C6 12.5 3.5 10 3.5 6 7.5 6 10 8.5 10 12.5Z M10 9.5C10 5.5 12.5 3 16.5 3c0 4-2.5 6.5-6.5 6.5Z",
  stop: "M5 5h10v10H5Z",
  left: "M12.5 4 6.5 10l6 6",
  right: "M7.5 4l6 6-6 6",
  down: "M4 7.5l6 6 6-6",
  turn: "M3 10c0-2 3-3.5 7-3.5s7 1.5 7 3.5-3 3.5-6 3.5 M13.5 11 11 13.5l2.5 2.5",
  scissors: "M5.5 4a2 2 0 1 1 0 4 2 2 0 0 1 0-4 M5.5 12a2 2 0 1 1 0 4 2 2 0 0 1 0-4 M7.2 7 17 14.5 M7.2 13 17 5.5",
  reset: "M4 4v4.5h4.5 M4.3 8.3A6.5 6.5 0 1 1 3.6 12",
} as const;

export type IconName = keyof typeof PATHS;

const SVG = "http://www.w3.org/2000/svg";

/** One icon, hidden from screen readers: what bears it has a name of its own. */
export function icon(name: IconName): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "0 0 20 20");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", PATHS[name]);
  svg.append(path);
  return svg;
}
