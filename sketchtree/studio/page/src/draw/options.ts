// What can be set on the tool in hand? A small bar at the page's foot: the pen's width and steadiness, what the eraser takes, what a drag does.

import { button } from "../parts/button";
import { choice } from "../parts/choice";
import { element } from "../parts/element";
import { slider, type Slider } from "../parts/slider";
import { toggle } from "../parts/toggle";
import { byHand, setPhoto } from "./photo";
import { brushOf } from "./trunk/sizes";
import type { Desk, Eraser } from "./desk";

const POINTS = "Click: remove or add a point · drag: merge";
const POINTS_BY_HAND = "Tap: remove or add a point · drag: merge";
const FIRST = "Scribble on the tree and beside it first";
const FOOT = "Click where the trunk stands";
const THINNEST = 1; // CSS pixels
const THICKEST = 24;
const WIDEST = 120; // of a brush

export function mountOptions(desk: Desk): HTMLElement {
  const { store } = desk;
  const root = element("div", { class: "page-options", role: "group", aria: { label: "Options of the tool" } });
  const pen = penOptions(desk, "width");
  const brush = penOptions(desk, "brush");
  const paint = penOptions(desk, "paint");
  const eraser = choice<Eraser>({
    label: "What the eraser takes", value: desk.erases,
    options: [{ value: "whole", label: "Whole lines", testId: "erase-whole" }, { value: "part", label: "Parts", testId: "erase-part" }],
    onPick: (value) => { desk.erases = value; },
  });
  const hint = element("p", { class: "hint" }, "");
  const underlay = underlayOptions(desk);
  const ofTrunk = (): string => (!store.known.found ? FIRST : store.ui.tool === "foot" ? FOOT : byHand() ? POINTS_BY_HAND : POINTS);
  const show = (): void => {
    const { tool, selectedStrokes } = store.ui;
    const sized = { width: pen, brush, paint }[brushOf(tool)];
    const draws = sized !== pen || tool === "branch" || tool === "crown" || tool === "obstacle";
    const selects = tool === "select";
    const says = selects || tool === "vertices" || tool === "foot";
    hint.textContent = says && !selects ? ofTrunk() : selectedStrokes.length > 1 ? "Drag moves them" : selectedStrokes.length === 1 ? "Drag reshapes · Alt moves" : "Click or encircle lines";
    const parts: HTMLElement[] = draws ? [sized] : tool === "erase" ? [eraser.root] : says ? [hint] : [];
    if (store.known.underlay && (tool === "select" || draws)) parts.splice(tool === "select" ? 0 : 1, 1, underlay); // it says more than the hint
    underlay.classList.toggle("brief", draws);
    root.classList.toggle("brushes", sized !== pen);
    root.hidden = parts.length === 0;
    if (!sameParts(root, parts)) root.replaceChildren(...parts);
    if (tool !== "select" && desk.movesUnderlay) desk.movesUnderlay = false;
  };
  store.on(["tool", "selectedStrokes", "underlay", "trunks"], show);
  show();
  return root;
}

function sameParts(root: HTMLElement, parts: HTMLElement[]): boolean {
  return root.childElementCount === parts.length && parts.every((part, at) => root.children[at] === part);
}

function penOptions(desk: Desk, of: ReturnType<typeof brushOf>): HTMLElement {
  const { store, camera } = desk;
  const shown = (): number => store.ui[of] * camera.scale;
  const pen = of === "width";
  const width: Slider = slider({
    label: pen ? "Width" : "Brush", min: Math.log(THINNEST), max: Math.log(pen ? THICKEST : WIDEST), step: 0.01, value: Math.log(shown()), testId: pen ? undefined : `brush-${of}`,
    hint: pen ? "Width of the pen ([ and ])" : "Size of the brush ([ and ])",
    show: (value) => `${Math.exp(value).toFixed(1)} px`, onInput: (value) => store.set(of, Number((Math.exp(value) / camera.scale).toPrecision(3))),
  });
  const steady = slider({
    label: "Steady", min: 0, max: 1, step: 0.05, value: store.ui.stabiliser, hint: "How much a shaking hand is steadied",
    show: (value) => `${Math.round(100 * value)} %`, onInput: (value) => store.set("stabiliser", value),
  });
  const follow = (): void => { if (!width.input.matches(":focus")) width.set(Math.log(shown()), `${shown().toFixed(1)} px`); };
  store.on(of, follow);
  camera.on(follow);
  follow();
  return element("div", { class: "page-pen" }, width.root, steady.root);
}

function underlayOptions(desk: Desk): HTMLElement {
  const { store } = desk;
  const opacity = slider({
    label: "Picture", min: 0, max: 1, step: 0.05, value: store.known.underlay?.opacity ?? 0.4, hint: "How strong the picture to trace over is",
    show: (value) => `${Math.round(100 * value)} %`,
    onInput: (value) => {
      const { underlay } = store.known;
      if (!underlay) return;
      store.known.underlay = { ...underlay, opacity: value };
      desk.repaint();
    },
  });
  opacity.input.addEventListener("change", () => { if (store.known.underlay) store.send({ type: "setunderlay", underlay: store.known.underlay }); });
  const moves = toggle({ label: "Move", on: false, hint: "Drag the picture, or its lower right corner, with the select tool", onSwitch: (on) => {
    desk.movesUnderlay = on;
    if (on) store.set("tool", "select");
    desk.repaint();
  } });
  const photo = toggle({
    label: "From photo", on: store.known.underlay?.photo ?? false, testId: "photo-mode", hint: "It shows the tree: strokes mark its crown and limbs, and the limbs are traced",
    onSwitch: (on) => setPhoto(store, on),
  });
  photo.root.classList.add("photo-switch");
  store.on("underlay", () => {
    const { underlay } = store.known;
    if (underlay) opacity.set(underlay.opacity);
    photo.set(underlay?.photo ?? false);
  });
  store.on("tool", () => moves.set(desk.movesUnderlay && store.ui.tool === "select"));
  const clear = (): void => store.send({ type: "setunderlay", underlay: null });
  const away = button({ label: "Take the picture away", icon: "trash", iconOnly: true, look: "quiet", testId: "underlay-away", onPress: clear });
  return element("div", { class: "page-picture" }, opacity.root, photo.root, moves.root, away);
}
