// How many frames a second, and how soon after the pen is up is there another tree? Asked only by benchmarks, with `?bench` in the address.

import type { Store } from "../../store";
import type { View } from "../view";

export interface Bench {
  fps: (seconds?: number, part?: "all" | "wood" | "leaves" | "none") => Promise<{ fps: number; p95: number; ratio: number; software: boolean }>;
  lifted: () => Lifted[]; // since it was asked last
  tree: () => { triangles: number; calls: number };
}

/** Milliseconds from pen up until the first tree has come, is taken in, and is on the screen. */
export interface Lifted {
  phase: string;
  came: number;
  taken: number;
  shown: number;
}

declare global {
  interface Window {
    __studio?: Bench;
  }
}

export function mountBench(view: View, parts: () => { wood: { visible: boolean }[]; leaves: { visible: boolean }[] }, store: Store): void {
  if (!new URLSearchParams(location.search).has("bench")) return;
  const lifted = listenForPen(view, store);
  window.__studio = {
    lifted: () => lifted.splice(0),
    tree: () => ({ triangles: view.stage.renderer.info.render.triangles, calls: view.stage.renderer.info.render.calls }),
    fps: async (seconds = 3, part = "all") => {
      const { wood, leaves } = parts();
      wood.forEach((mesh) => { mesh.visible = part === "all" || part === "wood"; });
      leaves.forEach((mesh) => { mesh.visible = part === "all" || part === "leaves"; });
      const times = await turning(view, seconds);
      [...wood, ...leaves].forEach((mesh) => { mesh.visible = true; });
      const sorted = [...times].sort((a, b) => a - b);
      const mean = times.reduce((sum, time) => sum + time, 0) / times.length;
      return { fps: 1000 / mean, p95: sorted[Math.floor(0.95 * (sorted.length - 1))]!, ratio: view.stage.renderer.getPixelRatio(), software: view.stage.pace.software };
    },
  };
}

function listenForPen(view: View, store: Store): Lifted[] {
  const found: Lifted[] = [];
  let up: number | null = null;
  addEventListener("pointerup", () => { up = performance.now(); }, { capture: true });
  const gl = view.stage.renderer.getContext();
  store.on("frame", () => {
    if (up === null || store.frame === null) return;
    const [began, came, phase] = [up, performance.now(), store.frame.head.phase];
    up = null;
    setTimeout(() => {
      const taken = performance.now();
      requestAnimationFrame(() => requestAnimationFrame(() => {
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        found.push({ phase, came: came - began, taken: taken - began, shown: performance.now() - began });
      }));
    });
  });
  return found;
}

/** Milliseconds of every frame of a turn. Reading a pixel back waits until it is really drawn. */
async function turning(view: View, seconds: number): Promise<number[]> {
  const times: number[] = [];
  const gl = view.stage.renderer.getContext();
  const pixel = new Uint8Array(4);
  const began = performance.now();
  let last = began;
  while (last - began < 1000 * seconds) {
    view.look({ ...view.eye, azimuth: view.eye.azimuth + 3 });
    await new Promise(requestAnimationFrame);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    const now = performance.now();
    times.push(now - last);
    last = now;
  }
  return times.slice(1);
}
