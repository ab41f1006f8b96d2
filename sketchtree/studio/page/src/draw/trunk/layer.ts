// A sheet of its own, to paint on what is laid over the page in one go: evenly strong where lines cross, or with holes.

let sheet: OffscreenCanvas | null = null;

/** Empty, as large as the canvas; it is the same sheet each time. */
export function layerLike(on: CanvasRenderingContext2D): OffscreenCanvasRenderingContext2D | null {
  const { width, height } = on.canvas;
  if (sheet?.width !== width || sheet.height !== height) sheet = new OffscreenCanvas(width, height);
  const layer = sheet.getContext("2d");
  if (!layer) return null;
  layer.setTransform(1, 0, 0, 1, 0, 0);
  layer.globalCompositeOperation = "source-over";
  layer.globalAlpha = 1;
  layer.clearRect(0, 0, width, height);
  layer.lineCap = layer.lineJoin = "round";
  return layer;
}
