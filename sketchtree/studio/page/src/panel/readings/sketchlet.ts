// How is one reading shown? Two tiny line drawings on one canvas: from the front, and from above.

import type { Reading } from "../../messages";
import { element } from "../../parts/element";
import { twoViews } from "./two_views";

const WIDTH = 116;
const FRONT = 84; // CSS pixels, height
const ABOVE = 52;
const MARGIN = 5;

/** The canvas, and what draws it again in the colours that hold now. */
export function sketchlet(reading: Reading): { root: HTMLCanvasElement; draw: () => void } {
  const root = element("canvas", { class: "sketchlet", aria: { hidden: "true" } });
  const lines = twoViews(reading.paths, { width: WIDTH, height: FRONT, margin: MARGIN }, { width: WIDTH, height: ABOVE, margin: MARGIN });
  const draw = (): void => {
    const fine = Math.min(3, Math.max(1, devicePixelRatio));
    root.width = WIDTH * fine;
    root.height = (FRONT + ABOVE) * fine;
    const pen = root.getContext("2d");
    if (!pen) return;
    const style = getComputedStyle(root);
    pen.scale(fine, fine);
    pen.lineCap = pen.lineJoin = "round";
    pen.strokeStyle = style.getPropertyValue("--line");
    pen.lineWidth = 1;
    stroke(pen, [MARGIN, FRONT, WIDTH - MARGIN, FRONT], 0);
    pen.strokeStyle = style.color;
    lines.front.forEach((line, order) => { pen.lineWidth = order === 0 ? 2 : 1.2; stroke(pen, line, 0); });
    lines.above.forEach((line, order) => { pen.lineWidth = order === 0 ? 2 : 1.2; stroke(pen, line, FRONT); });
  };
  return { root, draw };
}

function stroke(pen: CanvasRenderingContext2D, line: readonly number[], down: number): void {
  pen.beginPath();
  for (let i = 0; i + 1 < line.length; i += 2) pen.lineTo(line[i]!, line[i + 1]! + down);
  pen.stroke();
}
