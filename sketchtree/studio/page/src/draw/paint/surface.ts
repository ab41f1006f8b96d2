// What is painted on? Two canvases of the screen's own pixels: the drawing below, what is in hand above, so that the pen never waits for the drawing.

export interface Surface {
  drawing: CanvasRenderingContext2D;
  live: CanvasRenderingContext2D;
  top: HTMLCanvasElement; // takes the pointer
  ratio: () => number; // screen pixels a CSS pixel
  repaint: () => void; // with the next frame
  repaintLive: () => void;
}

export interface SurfaceEvents {
  onPaint: () => void; // the drawing, and what is in hand
  onPaintLive: () => void; // only what is in hand
  onSize: (width: number, height: number) => void; // CSS pixels
}

const MOST_PIXELS = 3; // no screen needs more

export function makeSurface(root: HTMLElement, below: HTMLCanvasElement, top: HTMLCanvasElement, events: SurfaceEvents): Surface {
  root.append(below, top);
  const ratio = (): number => Math.min(MOST_PIXELS, devicePixelRatio || 1);
  let due: "nothing" | "live" | "all" = "nothing";
  const ask = (what: "live" | "all"): void => {
    if (due === "nothing") requestAnimationFrame(paint);
    if (due !== "all") due = what;
  };
  const paint = (): void => {
    const what = due;
    due = "nothing";
    if (what === "all") events.onPaint();
    events.onPaintLive();
  };
  const size = (): void => {
    const box = root.getBoundingClientRect();
    for (const canvas of [below, top]) {
      canvas.width = Math.max(1, Math.round(box.width * ratio()));
      canvas.height = Math.max(1, Math.round(box.height * ratio()));
    }
    events.onSize(Math.max(1, box.width), Math.max(1, box.height));
    events.onPaint(); // at once: a canvas that was given a size is empty
    events.onPaintLive();
  };
  new ResizeObserver(size).observe(root);
  return { drawing: below.getContext("2d")!, live: top.getContext("2d")!, top, ratio, repaint: () => ask("all"), repaintLive: () => ask("live") };
}
