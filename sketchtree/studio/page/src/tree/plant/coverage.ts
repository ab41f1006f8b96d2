// Why do leaves not dissolve when they are far away? Averaged alpha falls below the cut, so each smaller picture's alpha is scaled until as large a share of it
// passes the cut as of the first (Castaño, "Computing Alpha Mipmaps", 2010).

export interface Picture {
  width: number;
  height: number;
  data: Uint8Array<ArrayBuffer>; // RGBA, sRGB, alpha not multiplied in
}

const LINEAR = Float32Array.from({ length: 256 }, (_, v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));

/** The picture and its halves down to one pixel. `cut`: alpha (0-1) below it is not drawn; null: alpha is left alone. */
export function mipmaps(picture: Picture, cut: number | null): Picture[] {
  const wanted = cut === null ? 0 : coverage(picture.data, cut, 1);
  const levels = [picture];
  for (let last = picture; last.width > 1 || last.height > 1; ) {
    last = halved(last); // halves are made of halves whose alpha is unscaled, so that no scaling is scaled again
    const shown = { ...last, data: last.data.slice() };
    if (cut !== null) scaleAlpha(shown.data, scaleFor(last.data, cut, wanted));
    levels.push(shown);
  }
  return levels;
}

/** The share of pixels whose alpha, times `scale`, reaches the cut. */
export function coverage(data: Uint8Array, cut: number, scale: number): number {
  let passing = 0;
  const least = (cut * 255) / scale;
  for (let k = 3; k < data.length; k += 4) if (data[k]! >= least) passing++;
  return (4 * passing) / data.length;
}

function scaleFor(data: Uint8Array, cut: number, wanted: number): number {
  let [low, high] = [0, 8];
  for (let step = 0; step < 12; step++) {
    const middle = (low + high) / 2;
    if (coverage(data, cut, middle) < wanted) low = middle;
    else high = middle;
  }
  return high;
}

function scaleAlpha(data: Uint8Array, scale: number): void {
  for (let k = 3; k < data.length; k += 4) data[k] = Math.min(255, Math.round(data[k]! * scale));
}

/** Half as wide and high. Colours are averaged as light, each pixel as much as it covers. */
function halved({ width, height, data }: Picture): Picture {
  const [w, h] = [Math.max(1, width >> 1), Math.max(1, height >> 1)];
  const half = new Uint8Array(4 * w * h);
  for (let y = 0; y < h; y++)
    for (let x = 0; x < w; x++) {
      const rows = [Math.min(2 * y, height - 1), Math.min(2 * y + 1, height - 1)];
      const columns = [Math.min(2 * x, width - 1), Math.min(2 * x + 1, width - 1)];
      average(data, rows.flatMap((row) => columns.map((column) => 4 * (row * width + column))), half, 4 * (y * w + x));
    }
  return { width: w, height: h, data: half };
}

function average(data: Uint8Array, from: number[], into: Uint8Array, at: number): void {
  let [red, green, blue, alpha, weights] = [0, 0, 0, 0, 0];
  for (const k of from) {
    const weight = data[k + 3]! + 0.5; // a little, so that what is all clear keeps its colour
    red += weight * LINEAR[data[k]!]!;
    green += weight * LINEAR[data[k + 1]!]!;
    blue += weight * LINEAR[data[k + 2]!]!;
    alpha += data[k + 3]!;
    weights += weight;
  }
  [into[at], into[at + 1], into[at + 2], into[at + 3]] = [encoded(red / weights), encoded(green / weights), encoded(blue / weights), Math.round(alpha / from.length)];
}

function encoded(light: number): number {
  return Math.round(255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055));
}
