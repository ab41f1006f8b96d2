// How does the tree come on the screen? Frames become a plant, the plant becomes scenery, and around it stand sky, ground, person, drawing and what a hand can do.

import { element } from "../parts/element";
import { camera as pageCamera } from "../draw/camera";
import { stand as standOn } from "../draw/cloud/seen";
import { ScanPoints } from "./cloud/scan_points";
import type { Tree } from "../messages";
import type { Store } from "../store";
import { byHand } from "./eye/flight";
import { listen } from "./eye/gestures";
import { panned, shortest, zoomed } from "./eye/eye";
import { Chosen } from "./hand/chosen";
import { Guide } from "./hand/guide";
import { Handles } from "./hand/handles";
import { listenKeys } from "./hand/keys";
import { Toolbar } from "./hand/toolbar";
import { described } from "./hand/wood_of";
import { Ghosts } from "./page/ghosts";
import { Ink } from "./page/ink";
import { doubtColours } from "./plant/doubt";
import { Marks } from "./plant/marks";
import type { Plant } from "./plant/plant";
import { Plants } from "./plant/plants";
import { Scenery } from "./plant/scenery";
import { topOf } from "./plant/spots";
import { Sky, type Lighting } from "./plant/surface";
import { Textures } from "./plant/textures";
import { Wardrobe } from "./plant/wardrobe";
import { mountBench } from "./show/bench";
import { filmOf, pictureOf, type PictureWish, type Tidy } from "./show/capture";
import { firstTouch } from "./show/first_touch";
import { Labels } from "./show/labels";
import { legend } from "./show/legend";
import { noWebgl, watchContext } from "./show/trouble";
import { turnDial } from "./show/turn_dial";
import { viewBar } from "./show/view_bar";
import { Figure } from "./stage/figure";
import { Ground } from "./stage/ground";
import { Weather } from "./stage/weather";
import { View } from "./view";
import "./tree.css";

export interface TreeViews {
  screenshot: (wish?: PictureWish) => Promise<Blob>; // PNG
  turntable: () => Promise<Blob>; // a film, or an archive of pictures
  stand: Stand | null; // null: there is no 3D here
}

/** Where another plant may take the tree's place for a while. */
export interface Stand {
  view: View;
  bar: HTMLElement; // the buttons at the foot
  scenery: Scenery;
  lighting: Lighting;
  textures: Textures;
  aside: (is: boolean) => void; // the tree, with what hangs on its limbs, is not seen
}

const THINNED = 0.3; // of the leaves, while the view moves and no graphics card draws it
const SEEN_THROUGH = 0.2; // of the leaves, while wood is chosen or its doubt shown

export function mountTree(root: HTMLElement, store: Store): TreeViews {
  const about = "Tree in 3D. Arrows turn, plus and minus come nearer. Tab walks through the limbs, Enter takes a limb's handle, Escape lets go.";
  const box = element("div", { class: "tree-view", tabindex: 0, role: "application", "aria-label": about, "data-testid": "tree-view" });
  root.append(box);
  try {
    return fill(new View(box), store);
  } catch (error) {
    if (!(error instanceof Error) || !/webgl/i.test(error.message)) throw error;
    noWebgl(box);
    const none = (): Promise<Blob> => Promise.reject(new Error("There is no 3D here."));
    return { screenshot: none, turntable: none, stand: null };
  }
}

function fill(view: View, store: Store): TreeViews {
  const { stage } = view;
  const weather = new Weather(stage.scene, stage.pace.software);
  const ground = new Ground(stage.scene);
  const figure = new Figure(stage.scene);
  const ink = new Ink(stage.scene);
  const ghosts = new Ghosts(stage.scene);
  const scan = new ScanPoints(stage.scene);
  const lighting: Lighting = { sky: new Sky(), marks: new Marks(), doubt: { value: 0 }, sunByGrid: stage.pace.software, leafShare: { value: 1 } };
  const textures = new Textures((key, kind) => store.address(`./texture/${key}/${kind}.png`), stage.pace.software ? 1 : Math.min(8, stage.renderer.capabilities.getMaxAnisotropy()));
  const scenery = new Scenery(lighting, new Wardrobe(lighting, textures, stage.pace.software, () => stage.shadows()), stage.pace.software, () => stage.shadows());
  stage.scene.add(scenery.group);
  if (stage.pace.software) stage.whileMoving = (moving) => scenery.thin(Math.min(moving ? THINNED : 1, lighting.leafShare.value));
  const chosen = new Chosen(view, scenery, lighting.marks, store);
  const handles = new Handles(view, chosen, store, new Guide(view, stage.scene));
  const toolbar = new Toolbar(view, chosen, store);
  const labels = new Labels(view, figure, store);
  const shown = { ink: true, grid: false };
  const inked = (): boolean => shown.ink && !view.grows; // over a young tree the drawing would hang in the air
  const bar = viewBar(view, store, shown, () => { ink.visible = inked(); ground.grid(shown.grid); stage.draw(); });
  turnDial(view, store);
  legend(view.root, store);
  firstTouch(view.root, store);
  listenKeys(view, store, toolbar, handles);
  followHand(view, store, chosen);
  sayChosen(view, store, chosen);

  view.spots = () => [...scenery.spots, ...scan.spots, ...figure.ends, 0, 0, 0];
  view.top = () => topOf(scenery.spots);
  followFrames(view, store, { scenery, chosen, weather, ground, figure, ghosts, scan });
  followLooks(view, store, { weather, ground, figure, ink, ghosts, lighting, scenery, scan });
  followPoints(view, store, { scan, scenery, weather, ground, figure });
  followPage(view, store, ink);
  labels.renew();
  watchContext(view.root, stage.canvas, () => stage.shadows());
  mountBench(view, () => ({ wood: scenery.meshes.filter((mesh) => mesh.userData.wood), leaves: scenery.meshes.filter((mesh) => !mesh.userData.wood) }), store);
  const tidy: Tidy = (transparent) => {
    if (transparent) weather.visible = ground.visible = ink.visible = figure.group.visible = false;
    return () => {
      weather.visible = ground.visible = true;
      ink.visible = inked();
      figure.wanted = store.ui.figure;
    };
  };
  const aside = (is: boolean): void => {
    view.grows = is;
    scenery.group.visible = !is;
    ink.visible = inked();
    view.root.toggleAttribute("data-grows", is);
  };
  const stand: Stand = { view, bar, scenery, lighting, textures, aside };
  return { screenshot: (wish) => pictureOf(view, tidy, wish), turntable: () => filmOf(view, tidy), stand };
}

interface Standing {
  scenery: Scenery;
  chosen: Chosen;
  weather: Weather;
  ground: Ground;
  figure: Figure;
  ghosts: Ghosts;
  scan: ScanPoints;
}

/** What the program sends is shown. */
function followFrames(view: View, store: Store, { scenery, chosen, weather, ground, figure, ghosts, scan }: Standing): void {
  const plants = new Plants();
  let stood = false; // there was a tree before
  let scale = 0; // its metres a page unit
  const show = (plant: Plant, of: Tree): void => {
    if (stood && scale && of.scale !== scale) view.rescale(of.scale / scale);
    scale = of.scale;
    scenery.show(plant, of.phase === "quick");
    placeScan(store, scan);
    view.box = scan.box?.union(scenery.box) ?? scenery.box;
    if (!scenery.box.isEmpty()) {
      weather.light(scenery.box);
      ground.under(scenery.box, trunkOf(store));
      figure.beside(scenery.box, scenery.spots);
      figure.stands = true;
      if (of.phase !== "glance") view.follow(!stood);
    }
    stood = !scenery.box.isEmpty();
    ground.bare = !stood && !scan.visible;
    if (!stood && !scan.visible) figure.stands = false;
    if (store.ui.uncertainty) scenery.doubt(doubtColours(scenery.now, store.known.limbs));
    ghosts.show([], 0); // what was to come is there
    chosen.renew();
    view.stage.shadows();
  };
  store.on("frame", () => {
    const plant = store.frame && plants.take(store.frame.head, store.frame.arrays);
    if (store.frame && plant) show(plant, store.frame.head);
  });
  store.on("photoTree", () => {
    const { photoTree, drawnTree } = store.known;
    if (!photoTree && drawnTree) show(plants.leavePhoto(), drawnTree);
  });
  store.on("ghost", () => {
    if (!store.ghost) return;
    const { head, arrays } = store.ghost;
    const paths = head.arrays.map(({ name }, k) => ({ points: arrays.get(name) as Float32Array, radius: head.radius[k] ?? 0 }));
    ghosts.show(paths, 0.0022 * view.reach);
    view.stage.draw(true);
  });
  store.on("trouble", () => { // nothing comes of it
    ghosts.show([], 0);
    view.stage.draw();
  });
}

/** A guess at the trunk's radius: it decides how wide the ground darkens at its foot. */
function trunkOf(store: Store): number {
  return 0.02 * (store.known.tree?.height ?? 5);
}

interface Looks extends Omit<Standing, "chosen"> {
  ink: Ink;
  lighting: Lighting;
}

/** Day and night, the person, doubt, and leaves that let one see the wood. */
function followLooks(view: View, store: Store, { weather, ground, figure, ink, ghosts, lighting, scenery, scan }: Looks): void {
  const theme = (): void => {
    [weather, ground, figure, ink, ghosts, scan].forEach((part) => part.wear(store.ui.theme));
    view.stage.draw();
  };
  const doubt = (): void => scenery.doubt(store.ui.uncertainty ? doubtColours(scenery.now, store.known.limbs) : null);
  const through = (): void => {
    lighting.leafShare.value = store.ui.uncertainty ? 0 : store.ui.selected !== null || store.ui.tool === "select" ? SEEN_THROUGH : 1;
    view.stage.draw();
  };
  store.on("theme", theme);
  store.on("uncertainty", doubt);
  store.on(["uncertainty", "selected", "tool"], through);
  store.on("figure", () => { figure.wanted = store.ui.figure; view.stage.draw(); });
  view.stage.beforeDraw.push(() => { figure.face(view.stage.camera(view.stage.wide, view.stage.high)); return false; });
  figure.wanted = store.ui.figure;
  theme();
}

/** Where the points of a scan are, beside the tree that is shown. */
function placeScan(store: Store, scan: ScanPoints): void {
  const { known } = store;
  scan.show(known.scan, known.cloud, standOn(store), known.points?.shown ?? true, known.points?.size ?? 2);
}

/** Points come and go; alone they are what there is to see. */
function followPoints(view: View, store: Store, { scan, scenery, weather, ground, figure }: Pick<Standing, "scan" | "scenery" | "weather" | "ground" | "figure">): void {
  let before: string | null = null;
  store.on(["scan", "cloud", "points"], () => {
    placeScan(store, scan);
    const box = scan.box?.union(scenery.box) ?? scenery.box;
    view.box = box;
    if (!box.isEmpty() && scenery.box.isEmpty()) {
      weather.light(box);
      ground.under(box, trunkOf(store));
      figure.beside(box, scan.spots);
    }
    ground.bare = box.isEmpty();
    figure.stands = !box.isEmpty();
    const now = store.known.scan?.digest ?? null;
    if (now !== before && !box.isEmpty()) view.follow(true);
    before = now;
    view.stage.shadows();
  });
}

/** The drawing on its pages; the view turns with the page, and lies exactly under it where the page is over the tree. */
function followPage(view: View, store: Store, ink: Ink): void {
  const plane = () => standOn(store);
  let stale = true; // lines are made with the next frame, however many steps come before it
  store.on(["strokes", "tree"], () => { stale = true; view.stage.draw(); });
  view.overPage = () => (store.ui.layout === "over" && (store.known.tree ?? store.known.cloud) ? { page: pageCamera, plane: plane(), azimuth: view.flight.moving ? view.eye.azimuth : store.ui.turn } : null);
  view.stage.beforeDraw.push(() => {
    if (stale && store.known.tree) ink.show(store.known.strokes.values(), plane());
    stale = false;
    ink.seen(view.overPage()?.azimuth ?? view.eye.azimuth, view.stage.wide, view.stage.high);
    ink.without(store.ui.layout === "over" ? store.ui.turn : null); // the page itself shows that sheet
    return false;
  });
  pageCamera.on(() => { if (store.ui.layout === "over") view.stage.draw(true); });
  store.on(["turn", "layout"], () => {
    if (store.ui.layout === "over" || Math.abs(shortest(view.eye.azimuth - store.ui.turn)) > 0.5) view.turnTo(store.ui.turn, Math.min(view.eye.elevation, 12));
  });
}

/** Pointer and fingers on the view. */
function followHand(view: View, store: Store, chosen: Chosen): void {
  const within = (event: PointerEvent): [number, number] => {
    const box = view.root.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  listen(view.root, {
    turn: (right, down) => view.look(byHand(view.eye, right, down), true),
    move: (right, down) => view.look(panned(view.eye, right, down, view.stage.high)),
    near: (factor, x, y) => view.look(zoomed(view.eye, factor, x, y, view.stage.high)),
    flung: (right, down) => { view.flight.fling(view.eye, right, down, performance.now()); view.stage.draw(true); },
    taken: () => { view.flight.stop(); view.root.focus({ preventScroll: true }); },
    clicked: (event) => store.set("selected", store.known.photoTree || view.grows ? null : chosen.at(...within(event))),
    hovered: (event) => {
      const onView = event.target === view.root || event.target === view.stage.canvas;
      const slow = view.stage.pace.software && store.ui.tool !== "select" && !event.altKey && !store.ui.uncertainty; // each limb passed over would cost a picture
      const id = onView && !slow && !store.known.photoTree && !view.grows && event.pointerType !== "touch" ? chosen.at(...within(event)) : null;
      store.set("pointed", id);
      view.root.toggleAttribute("data-pointing", id !== null);
    },
  });
  view.root.addEventListener("pointerleave", () => store.set("pointed", null));
}

/** What is chosen is said aloud. */
function sayChosen(view: View, store: Store, chosen: Chosen): void {
  const said = element("p", { class: "tick", "aria-live": "polite", "data-testid": "chosen-limb" });
  view.root.append(said);
  store.on(["selected", "limbs"], () => {
    const one = chosen.now;
    said.textContent = one ? described(one, store.known.limbs) : "";
  });
}
