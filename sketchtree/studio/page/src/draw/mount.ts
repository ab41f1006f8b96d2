// The page one draws on: canvases, the pen and its tools, the view of it, and what is said over it.

import { element } from "../parts/element";
import type { Store } from "../store";
import { camera } from "./camera";
import { CloudPicture } from "./cloud/picture";
import { followScan } from "./cloud/scan";
import { rememberTurn } from "./cloud/turn";
import type { Desk } from "./desk";
import { followDrawing } from "./following";
import { drawing } from "./hand/drawing";
import { erasing } from "./hand/erasing";
import { panning } from "./hand/panning";
import { Pen } from "./hand/pen";
import { selecting } from "./hand/selecting";
import type { Tool } from "./hand/touch";
import { mountWheel } from "./hand/wheel";
import { listenKeys } from "./keys";
import { mountOptions } from "./options";
import { followPhoto, photoHere } from "./photo";
import { paintDrawing, paintLive } from "./paint/painter";
import { readPalette } from "./paint/palette";
import { makeSurface } from "./paint/surface";
import { tinted } from "./paint/tint";
import { pairSelections } from "./selection";
import { mountTip } from "./tip";
import { brush } from "./trunk/brush";
import { standing } from "./trunk/foot";
import { decoded } from "./trunk/mask";
import { points } from "./trunk/points";
import { mountDeedTip } from "./trunk/tip";
import { followWay, way } from "./trunk/way";
import { mountViewCorner } from "./view_corner";

const ROOM = 4; // CSS pixels above the controls
const ABOUT = "Drawing page. Draw with a pen, mouse or finger; press ? for the keys.";

export function mountDraw(root: HTMLElement, store: Store): void {
  const below = element("canvas", { class: "page-layer", aria: { hidden: "true" } });
  const top = element("canvas", { class: "page-layer", testId: "page-canvas", tabindex: 0, role: "application", aria: { label: ABOUT } });
  let palette = readPalette(root);
  const picture = new Image();
  const cloud = new CloudPicture();
  let tint: OffscreenCanvas | null = null;
  let mask: ImageBitmap | null = null;
  const desk: Desk = {
    store, camera, live: null, instead: new Map(), hovered: null, lasso: [], eraser: null, ring: null, deed: null, erases: "whole", underlay: null, movesUnderlay: false, trouble: null,
    letGo: () => tools[store.ui.tool].cancel(), tellDeed: () => {}, repaint: () => surface.repaint(), repaintLive: () => surface.repaintLive(),
  };
  const surface = makeSurface(root, below, top, {
    onPaint: () => paintDrawing(surface.drawing, surface.ratio(), desk, palette, picture.src ? picture : null, tint, mask, cloud),
    onPaintLive: () => paintLive(surface.live, surface.ratio(), desk, palette),
    onSize: (width, height) => camera.resize(width, height),
  });
  const tools = {
    branch: drawing(desk, "branch"), crown: drawing(desk, "crown"), obstacle: drawing(desk, "obstacle"),
    foreground: brush(desk, "foreground"), background: brush(desk, "background"), matte_add: brush(desk, "matte_add"), matte_erase: brush(desk, "matte_erase"),
    vertices: points(desk), foot: standing(desk), erase: erasing(desk), select: selecting(desk), pan: panning(desk),
  } satisfies Record<Store["ui"]["tool"], Tool>;
  const pen = new Pen(top, desk, {
    current: () => tools[store.ui.tool], eraser: tools.erase, panning: tools.pan, second: () => { const other = photoHere(store) ? secondOf(store) : null; return other && tools[other]; },
  });

  camera.on(desk.repaint);
  camera.on(() => { top.dataset["camera"] = `${camera.scale} ${camera.x} ${camera.y}`; }); // for programs and tests: page units to CSS pixels
  pairSelections(store);
  followDrawing(desk);
  followPhoto(store);
  followScan(store);
  rememberTurn(store);
  followWay(store);
  mountWheel(top, camera);
  mountTip(root, top, desk);
  mountDeedTip(root, top, desk);
  listenKeys(root, desk, pen);
  const foot = element("div", { class: "page-foot" }, mountOptions(desk), mountViewCorner(desk));
  root.append(foot);
  const covered = (): void => camera.cover("foot", root.clientHeight - foot.offsetTop + ROOM);
  new ResizeObserver(covered).observe(foot);
  store.on("layout", covered); // there it stands higher, or lower

  store.on("tool", () => {
    pen.cancel();
    for (const one of [tools.erase, tools.select, tools.foreground, tools.vertices]) if (one !== tools[store.ui.tool]) one.hover(null);
    desk.repaint();
    pen.showCursor();
  });
  store.on("theme", () => {
    palette = readPalette(root);
    desk.repaint();
    dye();
  });
  const dye = (): void => {
    const { foliage } = store.known;
    void tinted(foliage?.png ?? "", palette.crown).then((made) => {
      if (store.known.foliage !== foliage) return; // a newer one is on its way
      tint = made;
      desk.repaint();
    });
  };
  store.on("foliage", dye);
  store.on("matte", () => {
    const { matte } = store.known;
    void decoded(matte).then((made) => {
      if (store.known.matte !== matte) return made?.close();
      mask?.close();
      mask = made;
      desk.repaint();
    });
  });
  store.on("underlay", () => {
    const digest = store.known.underlay?.digest;
    if (digest) picture.src = store.address(`/underlay/${digest}`);
    else picture.removeAttribute("src");
  });
  picture.addEventListener("load", desk.repaint);
  store.on(["strokes", "read", "limbs", "tree", "selected", "selectedStrokes", "pointed", "turn", "layout", "underlay", "trouble", "traced", "tint", "cloud", "scan", "points"], desk.repaint);
  store.on(["trunk", "trunks", "matteView", "matteStrength", "skeleton"], desk.repaint);
  pen.showCursor();
}

/** What the right button draws on a photo: the other of a pair. */
function secondOf(store: Store): Store["ui"]["tool"] | null {
  if (way(store) === "crown") return "branch";
  switch (store.ui.tool) {
    case "foreground": return "background";
    case "background": return "foreground";
    case "matte_add": return "matte_erase";
    case "matte_erase": return "matte_add";
    default: return null;
  }
}
