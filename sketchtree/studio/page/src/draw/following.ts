// What does the page do by itself? It shows all of a drawing that was opened, keeps what one draws where it is, and lights the stroke that made trouble.

import type { PageCamera } from "./camera";
import { reach } from "./cloud/seen";
import { type Desk, isSamePage } from "./desk";
import { photoHere } from "./photo";
import type { Stroke } from "../messages";
import type { Store } from "../store";
import { around } from "./line/nearness";
import { projected } from "./turned";

export const PEN = 4; // CSS pixels: width of the pen on a drawing just opened
const BRUSH = 5; // of the brush that scribbles
const PAINT = 14; // and of the one that paints the matte
const EMPTY = { left: 0.5, top: 0.86 }; // where on an empty page the tree's root is to be

export function followDrawing(desk: Desk): void {
  const { store, camera } = desk;
  let before = new Set<string>();
  let placed = false;

  /** All of the drawing, and the ground below it. */
  const fit = (): boolean => {
    const box = everything(store);
    if (!box || camera.width < 2) return false;
    camera.fit(box);
    return true;
  };
  camera.on(() => {
    if (placed || camera.width < 2) return;
    placed = true;
    showEmpty(camera);
  });
  store.on("strokes", () => {
    const ids = [...store.known.strokes.keys()];
    const opened = isOpened(before, ids, store.pending.length > 0);
    const alone = ids.length === 1 && before.size === 0; // the first line, drawn here or on another page
    before = new Set(ids);
    if (!opened || (alone && inSight(camera, store.known.strokes.values())) || !fit()) return;
    store.set("width", Number((PEN / camera.scale).toPrecision(2)));
  });
  let photo: string | null = null;
  store.on("underlay", () => {
    const here = photoHere(store)?.digest ?? null;
    if (here !== null && here !== photo && fit()) for (const [name, size] of [["width", PEN], ["brush", BRUSH], ["paint", PAINT]] as const) store.set(name, Number((size / camera.scale).toPrecision(2)));
    photo = here;
  });
  store.on("scan", () => { if (store.known.scan !== null && fit()) store.set("width", Number((PEN / camera.scale).toPrecision(2))); });
  store.on("turn", () => { if (camera.showsAll) fit(); }); // from another side a tree is wider, or narrower
  let wrongAt = -1;
  store.on("trouble", () => {
    desk.trouble = store.known.trouble?.stroke ?? null;
    wrongAt = store.known.revision;
  });
  store.on("tree", () => {
    if (desk.trouble !== null && (store.known.tree?.revision ?? 0) > wrongAt) desk.trouble = null;
  });
}

/** Did these strokes come all at once? Then it is a drawing that was opened, or found again (where some may still be on their way). */
export function isOpened(before: ReadonlySet<string>, ids: readonly string[], underWay: boolean): boolean {
  if (ids.length === 0 || ids.some((id) => before.has(id))) return false;
  return !underWay || (before.size === 0 && ids.length > 1);
}

function inSight(camera: PageCamera, strokes: Iterable<Stroke>): boolean {
  const box = around(strokes);
  if (!box) return true;
  const [left, top] = camera.toScreen(box.left, box.top);
  const [right, foot] = camera.toScreen(box.left + box.width, box.top + box.height);
  return left >= 0 && top >= 0 && right <= camera.width && foot <= camera.height;
}

/** All of the drawing on screen, or the empty page as it was at first. */
export function showAll({ camera, store }: Pick<Desk, "camera" | "store">): void {
  const box = everything(store);
  if (box) camera.fit(box);
  else showEmpty(camera);
}

/** Where on the page, as it is turned now, there is something: its own strokes, and limbs of other sides as they are seen from here. */
function everything(store: Store): ReturnType<typeof around> {
  const { tree, limbs, strokes } = store.known;
  const seen = [...strokes.values()].filter((stroke) => isSamePage(stroke.view_deg, store.ui.turn)).map(({ xy }) => ({ xy }));
  if (tree) for (const limb of limbs) if (!isSamePage(limb.view_deg, store.ui.turn)) seen.push({ xy: projected(limb, tree, store.ui.turn) });
  const photo = photoHere(store);
  const points = store.known.points?.shown ? reach(store) : null;
  if (points) seen.push({ xy: [points.left, points.top, points.left + points.width, points.top + points.height] });
  if (photo) seen.push({ xy: [photo.x, photo.y, photo.x + photo.width, photo.y + photo.height] });
  return around(seen.length ? seen : strokes.values());
}

/** A page on which nothing is drawn yet: its units are CSS pixels, and the root's place is below the middle. */
export function showEmpty(camera: PageCamera): void {
  camera.zoom(1 / camera.scale, 0, 0);
  camera.pan(camera.width * EMPTY.left - camera.x, camera.height * EMPTY.top - camera.y);
}
