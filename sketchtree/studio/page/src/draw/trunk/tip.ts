// What would a press do to the contour? Said beside the pointer.

import { element } from "../../parts/element";
import type { Desk } from "../desk";
import { gridOf } from "./contour";
import { said } from "./points";

const BESIDE = 14; // CSS pixels
const WIDE = 190;

export function mountDeedTip(root: HTMLElement, canvas: HTMLCanvasElement, desk: Desk): void {
  const tip = element("div", { class: "page-tip", role: "status", aria: { live: "polite" }, testId: "point-tip" });
  tip.hidden = true;
  root.append(tip);
  const put = (x: number, y: number, below: number): void => {
    const words = desk.store.ui.tool === "vertices" && desk.deed ? said(desk.deed) : "";
    tip.hidden = words === "";
    if (tip.textContent !== words) tip.textContent = words;
    tip.style.left = `${Math.max(8, Math.min(x + BESIDE, canvas.clientWidth - WIDE))}px`;
    tip.style.top = `${y + below}px`;
  };
  const show = (event: PointerEvent): void => {
    const box = canvas.getBoundingClientRect();
    const touch = event.pointerType === "touch"; // above the finger, while it is down
    put(event.clientX - box.left, event.clientY - box.top, touch ? -4 * BESIDE : BESIDE);
    if (touch && event.type === "pointerup") tip.hidden = true;
  };
  desk.tellDeed = (x, y) => {
    const { found, underlay } = desk.store.known;
    if (!found || !underlay) return;
    const grid = gridOf(found, underlay);
    const [left, top] = desk.camera.toScreen(grid.left + x * grid.unit, grid.top + y * grid.unit);
    put(left, top, BESIDE);
  };
  canvas.addEventListener("pointermove", show); // after the pen's own listener
  canvas.addEventListener("pointerup", show);
  canvas.addEventListener("pointerleave", () => { tip.hidden = true; });
  desk.store.on("tool", () => { tip.hidden = true; });
}
