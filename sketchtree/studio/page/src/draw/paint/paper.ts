// What does the page look like before anything is drawn? Paper with a quiet grid, the ground as a line, and the picture to trace over.

import type { Underlay } from "../../messages";
import type { PageCamera } from "../camera";
import type { Palette } from "./palette";

const LEAST_APART = 18; // CSS pixels between lines
const EVERY = 5; // each fifth line is stronger

/** The distance of the grid's lines in page units: 1, 2 or 5 times a power of ten. */
export function gridStep(scale: number): number {
  const least = LEAST_APART / scale;
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5, 10].find((times) => times * power >= least) ?? 10);
}

export function paintGrid(on: CanvasRenderingContext2D, camera: PageCamera, palette: Palette): void {
  const step = gridStep(camera.scale);
  const [left, top] = camera.toPage(0, 0);
  const [right, bottom] = camera.toPage(camera.width, camera.height);
  on.lineWidth = 1;
  for (const strong of [false, true]) {
    on.beginPath();
    for (let at = Math.ceil(left / step); at * step <= right; at += 1) if ((at % EVERY === 0) === strong) vertical(on, camera, at * step);
    for (let at = Math.ceil(top / step); at * step <= bottom; at += 1) if ((at % EVERY === 0) === strong) horizontal(on, camera, at * step);
    on.strokeStyle = palette.line;
    on.globalAlpha = strong ? 1 : 0.55;
    on.stroke();
  }
  on.globalAlpha = 1;
}

/** The ground: a line across the page, with short strokes below it as on a drawing of an architect. */
export function paintGround(on: CanvasRenderingContext2D, camera: PageCamera, palette: Palette, y: number): void {
  const level = Math.round(camera.toScreen(0, y)[1]) + 0.5;
  if (level < -20 || level > camera.height + 20) return;
  const apart = 14;
  const first = ((camera.x % apart) + apart) % apart;
  on.strokeStyle = palette.strong;
  on.lineWidth = 1.5;
  on.beginPath();
  on.moveTo(0, level);
  on.lineTo(camera.width, level);
  on.stroke();
  on.lineWidth = 1;
  on.beginPath();
  for (let x = first; x < camera.width + apart; x += apart) {
    on.moveTo(x, level);
    on.lineTo(x - 6, level + 6);
  }
  on.stroke();
}

/** `moves`: it can be moved now, and shows where to take hold of it. */
export function paintUnderlay(
  on: CanvasRenderingContext2D, camera: PageCamera, palette: Palette, underlay: Underlay, picture: HTMLImageElement, moves: boolean,
): void {
  const [x, y] = camera.toScreen(underlay.x, underlay.y);
  const [width, height] = [underlay.width * camera.scale, underlay.height * camera.scale];
  on.globalAlpha = underlay.opacity;
  if (picture.complete && picture.naturalWidth) on.drawImage(picture, x, y, width, height);
  on.globalAlpha = 1;
  if (!moves) return;
  on.strokeStyle = palette.accent;
  on.lineWidth = 1.5;
  on.setLineDash([6, 4]);
  on.strokeRect(x, y, width, height);
  on.setLineDash([]);
  on.fillStyle = palette.accent;
  on.fillRect(x + width - 6, y + height - 6, 12, 12);
}

function vertical(on: CanvasRenderingContext2D, camera: PageCamera, x: number): void {
  const at = Math.round(camera.toScreen(x, 0)[0]) + 0.5;
  on.moveTo(at, 0);
  on.lineTo(at, camera.height);
}

function horizontal(on: CanvasRenderingContext2D, camera: PageCamera, y: number): void {
  const at = Math.round(camera.toScreen(0, y)[1]) + 0.5;
  on.moveTo(0, at);
  on.lineTo(camera.width, at);
}
