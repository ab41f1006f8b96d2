// What the page knows, and who is told when it changes. Nothing here touches the document or a canvas.
//
//     link/  →  Store.take(event)  →  listeners (draw/, tree/, panel/)          listeners  →  Store.send(request)  →  link/
//
// `known` mirrors what the program said last; `ui` is this page's own and is never sent.

import type {
  Alternatives, Changed, Cloud, Edit, Event, Foliage, Ghost, Growing, Limb, Making, Matches, Matte, Options, Points, Proposed, Read, Request, Several, Stroke, Strokes, Traced, Tree, Trouble,
  Trunk, Trunks, Underlay, Warming, Welcome, Working,
} from "./messages";
import type { Scan } from "./draw/cloud/scan";
import { Echo } from "./link/echo";
import { STRAIGHT, type Ageing } from "./tree/growth/ageing";

export type Tool = "branch" | "crown" | "obstacle" | "foreground" | "background" | "matte_add" | "matte_erase" | "vertices" | "foot" | "erase" | "select" | "pan";

/** Arrays of a binary frame by name. */
export type Arrays = Map<string, Float32Array | Uint32Array | Uint16Array | Uint8Array | Int16Array | Int8Array>;

export interface Known {
  welcome: Welcome | null;
  connected: boolean;
  strokes: Map<string, Stroke>; // in drawing order; y down
  options: Options | null;
  edits: Edit[];
  underlay: Underlay | null;
  cloud: Cloud | null; // points behind the drawing
  points: Points | null; // how they are seen, and used
  scan: Scan | null; // the points themselves, once they are here
  several: Several | null; // trees in a cloud that was asked for
  name: string | null;
  revision: number;
  undo: string | null;
  redo: string | null;
  saved: boolean;
  file: string | null; // the project that was written last; told whenever one was
  working: Working | null;
  warming: Warming | null; // whether strokes over points would wait
  matches: Matches | null;
  alternatives: Alternatives | null;
  read: Read | null;
  traced: Traced | null; // in the photo under the page
  foliage: Foliage | null;
  proposed: Proposed | null; // strokes that nobody drew
  growing: Growing | null; // how far the photo's tree is
  making: Making | null; // how far something is that was asked for by its id
  trunk: Trunk | null; // how it is taken from scribbles
  matte: Matte | null; // that they tell
  trunks: Trunks | null; // what is said of the trunk in it
  found: Trunks | null; // the trunk itself, that was found last
  tree: Tree | null; // head of the frame that is shown; its meshes are tree/'s
  drawnTree: Tree | null; // of the last frame of the drawing's tree; a photo's tree stands in its place
  photoTree: Tree | null; // of the photo's
  limbs: Limb[]; // that were drawn, of the last frame that had any; a photo's tree has none to edit
  trouble: Trouble | null;
}

export interface Ui {
  tool: Tool;
  layout: "beside" | "over"; // page and tree side by side, or the page over the tree
  turn: number; // degrees: azimuth the tree is seen from and drawn on; 0 the front
  selected: string | null; // limb id
  pointed: string | null; // limb id: under the pointer, on the page or in the tree
  selectedStrokes: string[]; // ids
  uncertainty: boolean;
  figure: boolean; // the 1.8 m person
  tint: boolean; // what is foliage in a photo is tinted
  matteView: "tint" | "alone" | "off"; // over the photo, or white on black in its place
  matteStrength: number; // 0-1, of the tint
  skeleton: boolean; // of the trunk in a photo
  ageing: Ageing; // how the tree grows that is looked at, or exported
  theme: "light" | "dark";
  palm: boolean; // a pen was seen: fingers pan and never draw
  stabiliser: number; // 0-1
  width: number; // of the pen, page units
  brush: number; // that scribbles
  paint: number; // that paints the matte
}

export type Topic = keyof Known | keyof Ui | "frame" | "ghost" | "changed";

type Listener = () => void;

export class Store {
  readonly known: Known = {
    welcome: null, connected: false, strokes: new Map(), options: null, edits: [], underlay: null, cloud: null, points: null, scan: null, several: null, name: null, revision: 0, undo: null, redo: null,
    saved: true, file: null, working: null, warming: null, matches: null, alternatives: null, read: null, traced: null, foliage: null, proposed: null, growing: null, making: null,
    trunk: null, matte: null, trunks: null, found: null, tree: null, drawnTree: null, photoTree: null, limbs: [], trouble: null,
  };
  readonly ui: Ui = {
    tool: "branch", layout: "beside", turn: 0, selected: null, pointed: null, selectedStrokes: [], uncertainty: false, figure: true, tint: true, matteView: "tint",
    matteStrength: 0.5, skeleton: true, ageing: STRAIGHT, theme: "light", palm: false, stabiliser: 0.5, width: 4, brush: 4, paint: 10,
  };
  frame: { head: Tree; arrays: Arrays } | null = null; // the frame just come; listeners of "frame" take it at once
  ghost: { head: Ghost; arrays: Arrays } | null = null;
  send: (request: Request) => void = () => {}; // set by link/
  bytes: (path: string) => Promise<ArrayBuffer> = async (path) => { // of the program ("/cloud/…")
    const answer = await fetch(this.address(path), { credentials: "same-origin" });
    if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
    return answer.arrayBuffer();
  };
  address: (path: string) => string = (path) => path; // of a picture of the program ("/texture/…", "/underlay/…"); a notebook has no server, and others

  pending: Strokes[] = []; // sent and not confirmed yet; link/ keeps it
  private readonly echo = new Echo(); // what the program has, and what is on its way

  private drawnLimbs: Limb[] = [];
  private saidTrunk: Trunk | null = null; // as the program has it
  private readonly listeners = new Map<Topic, Set<Listener>>();

  /** Be told whenever one of these changes; returns what ends it. */
  on(topics: Topic | Topic[], listener: Listener): () => void {
    const all = Array.isArray(topics) ? topics : [topics];
    for (const topic of all) {
      if (!this.listeners.has(topic)) this.listeners.set(topic, new Set());
      this.listeners.get(topic)!.add(listener);
    }
    return () => all.forEach((topic) => this.listeners.get(topic)?.delete(listener));
  }

  /** Tell the listeners, each once; one that fails keeps none of the others from hearing it. */
  tell(...topics: Topic[]): void {
    const called = new Set<Listener>();
    for (const topic of topics) for (const listener of this.listeners.get(topic) ?? []) called.add(listener);
    for (const listener of called) {
      try {
        listener();
      } catch (error) {
        reportError(error);
      }
    }
  }

  /** Something of this page's own is different. */
  set<K extends keyof Ui>(name: K, value: Ui[K]): void {
    if (this.ui[name] === value) return;
    this.ui[name] = value;
    this.tell(name);
  }

  /** The connection came or went. */
  connected(is: boolean): void {
    this.known.connected = is;
    this.tell("connected");
  }

  /** Strokes are on their way, or were refused: show it. `added`: the only one that is new. */
  setPending(pending: Strokes[], added?: Strokes): void {
    this.pending = pending;
    this.echo.send(pending, added);
    this.known.strokes = this.echo.shown;
    this.tell("strokes");
  }

  /** Take what the program said. */
  take(event: Event, arrays: Arrays = new Map()): void {
    const known = this.known;
    switch (event.type) {
      case "welcome": known.welcome = event; this.tell("welcome"); break;
      case "changed": this.tell("changed", ...this.change(event)); break;
      case "working": known.working = event; this.tell("working"); break;
      case "warming": known.warming = event; this.tell("warming"); break;
      case "trouble":
        known.trouble = event;
        if (known.trunk !== this.saidTrunk) { known.trunk = this.saidTrunk; this.tell("trunk"); } // it may be what was refused
        this.tell("trouble");
        break;
      case "several": known.several = event; this.tell("several"); break;
      case "matches": known.matches = event; this.tell("matches"); break;
      case "alternatives": known.alternatives = event; this.tell("alternatives"); break;
      case "read": known.read = event; this.tell("read"); break;
      case "traced": known.traced = event; this.tell("traced"); break;
      case "foliage": known.foliage = event; this.tell("foliage"); break;
      case "matte": known.matte = event; this.tell("matte"); break;
      case "trunks": this.trunks(event); break;
      case "saved":
        if (known.welcome) known.welcome = { ...known.welcome, files: event.files };
        known.name = event.drawing;
        known.saved = event.saved;
        known.file = event.name;
        this.tell("saved", "name", "welcome", "file");
        break;
      case "proposed": known.proposed = event; this.tell("proposed"); break;
      case "growing":
        known.growing = event;
        if (event.state === "none") this.leavePhoto();
        this.tell("growing");
        break;
      case "making": known.making = event; this.tell("making"); break;
      case "tree": this.tree(event, arrays); break;
      case "ghost": this.ghost = { head: event, arrays }; this.tell("ghost"); this.ghost = null; break;
    }
  }

  /** Take the tree from scribbles so: shown at once, and said. A quick succession under one label is one step. */
  chooseTrunk(change: Partial<Trunk>, label: string): void {
    if (!this.known.trunk) return;
    this.known.trunk = { ...this.known.trunk, ...change };
    this.tell("trunk");
    this.send({ type: "choosetrunk", trunk: this.known.trunk, label });
  }

  /** See the points behind the drawing so, and use them so; likewise. */
  choosePoints(change: Partial<Points>, label: string): void {
    if (!this.known.points) return;
    this.known.points = { ...this.known.points, ...change };
    this.tell("points");
    this.send({ type: "choosepoints", points: this.known.points, label });
  }

  /** The points behind the drawing are here, or gone. */
  scanned(scan: Scan | null): void {
    if (this.known.scan === scan) return;
    this.known.scan = scan;
    this.tell("scan");
  }

  /** What is said of the trunk; the one that was found stays until there is another, or none. */
  private trunks(event: Trunks): void {
    this.known.trunks = event;
    if (event.state === "ready" && event.trees.length) this.known.found = event;
    else if (event.state === "none") this.known.found = null;
    this.tell("trunks");
  }

  /** A frame: the photo's tree stands in the place of the drawing's, which goes on behind it. */
  private tree(event: Tree, arrays: Arrays): void {
    const known = this.known;
    const hadPhoto = known.photoTree !== null;
    if (event.phase === "photo") known.photoTree = event;
    else if (event.phase !== "glance") known.drawnTree = event;
    known.tree = event.phase === "glance" ? event : (known.photoTree ?? event);
    if (event.phase !== "photo" && event.limbs) this.drawnLimbs = event.limbs;
    const limbs = known.photoTree ? !hadPhoto : event.limbs !== null;
    if (limbs) this.limbs(known.photoTree ? [] : this.drawnLimbs);
    this.frame = { head: event, arrays };
    this.tell("frame", "tree", ...(hadPhoto !== (known.photoTree !== null) ? (["photoTree"] as Topic[]) : []), ...(limbs ? (["limbs"] as Topic[]) : []));
    this.frame = null;
  }

  /** There is no tree of a photo any more. */
  private leavePhoto(): void {
    const known = this.known;
    if (!known.photoTree) return;
    known.photoTree = null;
    known.tree = known.drawnTree;
    this.limbs(this.drawnLimbs);
    this.tell("photoTree", "tree", "limbs");
  }

  /** The limbs as they are now; a selected limb that was adopted goes by another id. */
  private limbs(limbs: Limb[]): void {
    this.known.limbs = limbs;
    const selected = this.ui.selected;
    const adopted = selected === null || limbs.some((limb) => limb.id === selected) ? undefined : limbs.find((limb) => limb.was === selected);
    if (adopted) this.set("selected", adopted.id);
  }

  private change(event: Changed): Topic[] {
    const known = this.known;
    const topics: Topic[] = ["revision", "undo", "redo", "saved"];
    const before = known.strokes;
    this.echo.changed(event, this.pending);
    known.strokes = this.echo.shown;
    if (known.strokes !== before || event.put.length || event.gone.length) topics.push("strokes");
    if (event.options) { known.options = event.options; topics.push("options"); }
    if (event.edits) { known.edits = event.edits; topics.push("edits"); }
    if (event.trunk) { known.trunk = this.saidTrunk = event.trunk; topics.push("trunk"); }
    if (event.underlay_changed || event.since === 0) { known.underlay = event.underlay ?? null; topics.push("underlay"); }
    if (event.cloud_changed || event.since === 0) { known.cloud = event.cloud ?? null; topics.push("cloud"); }
    if (event.points) { known.points = event.points; topics.push("points"); }
    if (event.name != null) { known.name = event.name; topics.push("name"); }
    known.revision = event.revision;
    known.undo = event.undo ?? null;
    known.redo = event.redo ?? null;
    known.saved = event.saved ?? false;
    return topics;
  }
}
