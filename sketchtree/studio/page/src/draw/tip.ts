// Why is a joint in doubt? Said beside its mark while the pointer is on it.

import { element } from "../parts/element";
import type { Desk } from "./desk";
import { doubtAt } from "./paint/marks";
import { marksHere } from "./paint/painter";

export function mountTip(root: HTMLElement, canvas: HTMLCanvasElement, desk: Desk): void {
  const tip = element("div", { class: "page-tip", role: "tooltip" });
  tip.hidden = true;
  root.append(tip);
  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const mark = event.buttons === 0 ? doubtAt(marksHere(desk), desk.camera, x, y) : null;
    tip.hidden = mark === null;
    if (!mark) return;
    tip.textContent = mark.reason || "It is not sure which branch this one grows from.";
    tip.style.left = `${Math.min(x + 12, Math.max(8, box.width - 252))}px`;
    tip.style.top = `${y + 14}px`;
  });
  canvas.addEventListener("pointerleave", () => { tip.hidden = true; });
}
