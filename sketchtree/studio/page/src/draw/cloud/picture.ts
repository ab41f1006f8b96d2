// The points of a scan as a picture under the page, from the side that the page faces: near ones in their colour, far ones fading into the paper. Written pixel by pixel: tens of thousands of points
// are drawn at each step of the view.

import type { Store } from "../../store";
import type { PageCamera } from "../camera";
import { layerLike } from "../trunk/layer";
import { seenFrom, stand, type Seen } from "./seen";

const FAR = 0.62; // how much of the paper's colour the farthest points have
const STRENGTH = 0.9;
const LIFT = 1.45; // of a colour, on dark paper
const PLAIN = [116, 108, 96] as const; // points without a colour

export class CloudPicture {
  private seen: Seen | null = null;
  private of = ""; // what was seen
  private pixels: ImageData | null = null;
  private painted = ""; // and painted

  /** Paint it, if there is one and it is to be seen. `paper`: the page's colour, as CSS has it. */
  paint(on: CanvasRenderingContext2D, ratio: number, camera: PageCamera, store: Store, paper: string): void {
    const { cloud, scan, points } = store.known;
    const layer = cloud && scan && points?.shown ? layerLike(on) : null;
    if (!cloud || !scan || !points || !layer) return;
    const axis = stand(store).root[0] ?? cloud.x;
    const of = [scan.digest, cloud.x, cloud.y, cloud.unit, axis, store.ui.turn].join(" ");
    if (of !== this.of) this.seen = seenFrom(scan, cloud, axis, store.ui.turn);
    this.of = of;
    const { width, height } = layer.canvas;
    const painted = [of, camera.scale, camera.x, camera.y, ratio, width, height, points.size, store.ui.theme, paper].join(" ");
    if (painted !== this.painted || !this.pixels) this.pixels = pixelsOf(layer.createImageData(width, height), this.seen!, scan.rgb, camera, ratio, points.size ?? 2, rgbOf(paper), store.ui.theme);
    this.painted = painted;
    layer.putImageData(this.pixels, 0, 0);
    on.save();
    on.globalAlpha = STRENGTH;
    on.setTransform(1, 0, 0, 1, 0, 0);
    on.drawImage(layer.canvas, 0, 0);
    on.restore();
  }
}

function pixelsOf(image: ImageData, seen: Seen, rgb: Uint8Array | null, camera: PageCamera, ratio: number, size: number, paper: readonly number[], theme: string): ImageData {
  const { width, height, data } = image;
  const wide = Math.max(1, Math.round(size * ratio));
  const half = Math.floor(wide / 2);
  const words = new Uint32Array(data.buffer);
  const lift = theme === "dark" ? LIFT : 1;
  for (const k of seen.order) {
    const left = Math.round((seen.xy[2 * k]! * camera.scale + camera.x) * ratio) - half;
    const top = Math.round((seen.xy[2 * k + 1]! * camera.scale + camera.y) * ratio) - half;
    if (left + wide <= 0 || top + wide <= 0 || left >= width || top >= height) continue;
    const far = FAR * (1 - seen.near[k]!);
    const mixed = (channel: 0 | 1 | 2): number => {
      const own = Math.min(255, lift * (rgb ? rgb[3 * k + channel]! : PLAIN[channel]));
      return Math.round(own + (paper[channel]! - own) * far);
    };
    const word = (255 << 24) | (mixed(2) << 16) | (mixed(1) << 8) | mixed(0);
    for (let y = Math.max(0, top); y < Math.min(height, top + wide); y++) words.fill(word, y * width + Math.max(0, left), y * width + Math.min(width, left + wide));
  }
  return image;
}

/** Of a colour as tokens.css has it. */
function rgbOf(colour: string): readonly number[] {
  const found = /^#([0-9a-f]{6})$/i.exec(colour);
  if (!found) return [250, 248, 243];
  const number = parseInt(found[1]!, 16);
  return [number >> 16, (number >> 8) & 255, number & 255];
}
