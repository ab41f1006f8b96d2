// How does a picture or a film of the tree leave the page? The picture at twice the pixels; the film by the browser's recorder, or, where it has none, as an
// archive of pictures.

import { Color } from "three";
import { zipped } from "./zip";
import type { View } from "../view";

const SECONDS = 6; // of one turn
const FRAMES = 120; // of an archive
const SIZE = 2; // pixels a CSS pixel

export interface PictureWish {
  transparent?: boolean; // without sky and ground
}

/** What is to be out of sight while a picture is taken; returns what brings it back. */
export type Tidy = (transparent: boolean) => () => void;

/** The view as a PNG. */
export async function pictureOf(view: View, tidy: Tidy, { transparent = false }: PictureWish = {}): Promise<Blob> {
  const back = tidy(transparent);
  const { renderer, canvas } = view.stage;
  const ratio = renderer.getPixelRatio();
  renderer.setPixelRatio(SIZE);
  view.stage.whileMoving(false); // all of it, even if it moved just now
  try {
    if (!transparent) {
      view.stage.drawNow();
      return await png(canvas); // taken before anything else can draw
    }
    return await png(cutOut(view));
  } finally {
    renderer.setPixelRatio(ratio);
    back();
    view.stage.draw();
  }
}

/** The tree alone. Drawn once on black and once on white: where they differ one sees through, by as much. */
function cutOut(view: View): HTMLCanvasElement {
  const { renderer, scene, canvas } = view.stage;
  const before = scene.background;
  const [dark, light] = (["#000000", "#ffffff"] as const).map((colour) => {
    scene.background = new Color(colour);
    view.stage.drawNow();
    const flat = document.createElement("canvas");
    [flat.width, flat.height] = [canvas.width, canvas.height];
    const brush = flat.getContext("2d", { willReadFrequently: true })!;
    brush.drawImage(renderer.domElement, 0, 0);
    return { flat, brush, data: brush.getImageData(0, 0, flat.width, flat.height) };
  }) as [Shot, Shot];
  scene.background = before;
  unmixed(dark.data.data, light.data.data);
  dark.brush.putImageData(dark.data, 0, 0);
  return dark.flat;
}

interface Shot {
  flat: HTMLCanvasElement;
  brush: CanvasRenderingContext2D;
  data: ImageData;
}

/** Colour and alpha of what was seen on black and on white, written over the first. */
export function unmixed(onBlack: Uint8ClampedArray, onWhite: Uint8ClampedArray): void {
  for (let k = 0; k < onBlack.length; k += 4) {
    const through = Math.max(0, Math.min(onWhite[k]! - onBlack[k]!, onWhite[k + 1]! - onBlack[k + 1]!, onWhite[k + 2]! - onBlack[k + 2]!));
    const alpha = 255 - through;
    for (let c = 0; c < 3; c++) onBlack[k + c] = alpha ? Math.round((255 * onBlack[k + c]!) / alpha) : 0;
    onBlack[k + 3] = alpha;
  }
}

/** The tree turning once. */
export async function filmOf(view: View, tidy: Tidy): Promise<Blob> {
  const back = tidy(false);
  const start = view.eye;
  view.flight.stop();
  try {
    const kind = ["video/mp4;codecs=avc1.42E01E", "video/webm;codecs=vp9", "video/webm"].find((type) => typeof MediaRecorder !== "undefined" && MediaRecorder.isTypeSupported(type));
    return kind ? await recorded(view, kind) : await pictured(view);
  } finally {
    view.eye = start;
    back();
    view.stage.draw();
  }
}

async function recorded(view: View, kind: string): Promise<Blob> {
  const start = view.eye;
  const stream = view.stage.canvas.captureStream(30);
  const recorder = new MediaRecorder(stream, { mimeType: kind, videoBitsPerSecond: 12_000_000 });
  const parts: Blob[] = [];
  recorder.ondataavailable = (event) => parts.push(event.data);
  const ended = new Promise<void>((done, failed) => { recorder.onstop = () => done(); recorder.onerror = () => failed(new Error("The recorder stopped.")); });
  recorder.start();
  const began = performance.now();
  for (let share = 0; share < 1; share = (performance.now() - began) / 1000 / SECONDS) {
    view.eye = { ...start, azimuth: start.azimuth + 360 * share };
    view.stage.drawNow();
    await new Promise(requestAnimationFrame);
  }
  recorder.stop();
  await ended;
  stream.getTracks().forEach((track) => track.stop());
  return new Blob(parts, { type: kind.split(";")[0]! });
}

async function pictured(view: View): Promise<Blob> {
  const start = view.eye;
  const files: { name: string; data: Uint8Array<ArrayBuffer> }[] = [];
  for (let k = 0; k < FRAMES; k++) {
    view.eye = { ...start, azimuth: start.azimuth + (360 * k) / FRAMES };
    view.stage.drawNow();
    files.push({ name: `turn_${String(k).padStart(3, "0")}.png`, data: new Uint8Array(await (await png(view.stage.canvas)).arrayBuffer()) });
  }
  return zipped(files);
}

function png(canvas: HTMLCanvasElement): Promise<Blob> {
  return new Promise((done, failed) => canvas.toBlob((blob) => (blob ? done(blob) : failed(new Error("The browser made no picture."))), "image/png"));
}
