// What do the colours of doubt mean? A strip with its two ends, while they are shown.

import { element } from "../../parts/element";
import type { Store } from "../../store";
import { most, RAMP } from "../plant/doubt";

export function legend(root: HTMLElement, store: Store): void {
  const high = element("span", {});
  const strip = element("canvas", { width: 120, height: 1, "aria-hidden": "true" });
  const box = element("div", { class: "tree-legend", "data-testid": "uncertainty-legend", hidden: true }, element("strong", {}, "Depth known to"), element("span", {}, "± 0"), strip, high, element("span", { class: "grown" }, "not drawn"));
  root.append(box);
  const brush = strip.getContext("2d")!;
  const colours = brush.createLinearGradient(0, 0, strip.width, 0);
  RAMP.forEach((colour, k) => colours.addColorStop(k / (RAMP.length - 1), `rgb(${colour.join(" ")})`));
  brush.fillStyle = colours;
  brush.fillRect(0, 0, strip.width, 1);
  const follow = (): void => {
    box.hidden = !store.ui.uncertainty;
    const end = most(store.known.limbs);
    high.textContent = end < 1 ? `± ${Math.round(100 * end)} cm` : `± ${Number(end.toPrecision(2))} m`;
  };
  store.on(["uncertainty", "limbs"], follow);
  follow();
}
