// And where there is no 3D? A plain word of why and what to do; drawing goes on all the same.

import { element } from "../../parts/element";

const MISSING = ["There is no 3D here", "This browser shows no WebGL 2. Turn on hardware acceleration in its settings, update it, or open the studio in another browser. You can draw and export all the same."] as const;
const LOST = ["The graphics card let go of the picture", "It comes back by itself in a moment. If it does not, close other tabs that show 3D, then reload the page: the drawing is kept."] as const;

export function noWebgl(root: HTMLElement): void {
  root.append(card(...MISSING));
}

/** Says so while the graphics context is lost; `back` is called when it is there again. */
export function watchContext(root: HTMLElement, canvas: HTMLCanvasElement, back: () => void): void {
  const lost = card(...LOST);
  canvas.addEventListener("webglcontextlost", (event) => { event.preventDefault(); root.append(lost); }); // prevented: the browser gives another
  canvas.addEventListener("webglcontextrestored", () => { lost.remove(); back(); });
}

function card(title: string, text: string): HTMLElement {
  return element("div", { class: "tree-trouble", role: "alert" }, element("strong", {}, title), element("p", {}, text));
}
