// Controls at the side, the strip of templates, the status line, the dialogs, and what is said in the first minute.

import { exportTree } from "./dialogs/export";
import { gallery } from "./dialogs/gallery";
import { mountDrop } from "./dialogs/drop";
import { openFile } from "./dialogs/open";
import { saveProject } from "./dialogs/save";
import type { Views } from "./dialogs/views";
import { emptyPage } from "./first/empty";
import { emptyTree } from "./first/empty_tree";
import { goneBanner } from "./first/gone";
import { hintCard } from "./first/hint";
import { hintButton } from "./first/hint_button";
import { turnedNote } from "./first/turned_note";
import { welcomeBack } from "./first/welcome_back";
import { cloudCard } from "./cloud/card";
import { photoCard } from "./photo/card";
import { mountSide } from "./side/mount";
import { mountStatus } from "./status/mount";
import { troubleCard } from "./status/trouble";
import { trunkCard } from "./trunk/card";
import { mountStrip } from "./strip/strip";
import { camera } from "../draw/camera";
import { way } from "../draw/trunk/way";
import { newPage } from "../draw/new_page";
import type { Store } from "../store";
import "./panel.css";

const LOW = 340; // CSS pixels: where the page is no higher, a drawing below what is said on it would be too small to draw on
const LOW_SCRIBBLED = 240; // the same of a photo that is scribbled on, or of points: all of it has to be seen
const WIDE = 1100; // over a page as wide as this there is room beside what is said

export type Dialog = "open" | "save" | "gallery" | "export";

export interface PanelRoots {
  side: HTMLElement;
  strip: HTMLElement;
  status: HTMLElement;
  page: HTMLElement; // what is said about the drawing stands on it
  tree: HTMLElement;
}

const dialogs = new Map<Dialog, () => void>();

export function mountPanels(roots: PanelRoots, store: Store, views: Views): void {
  dialogs.set("open", openFile(store));
  dialogs.set("save", saveProject(store));
  dialogs.set("gallery", gallery(store));
  dialogs.set("export", exportTree(store, views));
  mountStrip(roots.strip, store); // its pictures come first
  mountSide(roots.side, store);
  mountStatus(roots.status, store);
  const hint = hintCard(store, () => newPage(store));
  const words = document.createElement("div");
  words.className = "page-words";
  words.append(goneBanner(store), troubleCard(store), hint.root, photoCard(store), trunkCard(store), cloudCard(store), turnedNote(store));
  const hides = (): boolean => words.offsetHeight > 0 && roots.page.clientHeight > (way(store) === "scribbles" || store.known.cloud ? LOW_SCRIBBLED : LOW) && (store.ui.layout === "beside" || roots.page.clientWidth < WIDE);
  const covered = (): void => camera.cover("head", hides() ? words.offsetTop + words.offsetHeight : 0);
  new ResizeObserver(covered).observe(words);
  store.on(["layout", "trunk", "underlay", "cloud"], covered);
  store.on(["trunk", "underlay"], () => { document.body.dataset["way"] = way(store); });
  roots.page.append(emptyPage(store, { gallery: () => openDialog("gallery"), open: () => openDialog("open") }), words, hintButton(store, hint));
  roots.tree.append(emptyTree(store));
  welcomeBack(store, () => newPage(store));
  mountDrop(store);
}

/** Show one of the dialogs. */
export function openDialog(which: Dialog): void {
  dialogs.get(which)?.();
}
