// What does the wheel do? A mouse's brings the page closer under the pointer; two fingers on a touchpad shift it, and pinched they bring it closer.

import type { PageCamera } from "../camera";

const CLOSER = 0.0015; // by each pixel of the wheel, as a power of e
const PINCH = 0.01;
const LINE = 16; // pixels, where a wheel counts lines

export function mountWheel(canvas: HTMLCanvasElement, camera: PageCamera): void {
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1;
    const [dx, dy] = [event.deltaX * unit, event.deltaY * unit];
    const box = canvas.getBoundingClientRect();
    if (event.ctrlKey || event.metaKey) camera.zoom(Math.exp(-dy * PINCH), event.clientX - box.left, event.clientY - box.top);
    else if (event.shiftKey) camera.pan(-(dx || dy), 0);
    else if (dx !== 0) camera.pan(-dx, -dy);
    else camera.zoom(Math.exp(-dy * CLOSER), event.clientX - box.left, event.clientY - box.top);
  }, { passive: false });
}
