// Made from sketchtree/studio/messages.py by `python -m sketchtree.studio.typescript`: change that file, not this one.

export const VERSION = 1;
export const MAX_MESSAGE = 4000000;
export const MAX_UPLOAD = 100000000;
export const MAX_POINTS = 20000;
export const MAX_STROKES = 20000;
export const LOWEST_PLANT = 0.05;
export const TALLEST_PLANT = 150.0;

/** Something that can be picked. */
export interface Choice {
  name: string;
  title: string; // for people
  picture: string | null; // address of its thumbnail
}

/** The answer to `Hello`: what there is to choose from. */
export interface Welcome {
  type: "welcome";
  version: number;
  templates: Choice[];
  leaves: Choice[];
  barks: Choice[];
  seasons: string[];
  examples: Choice[];
  formats: Choice[]; // of export; name is the extension with its dot
  folder: string; // its name, not its path
  files: string[]; // drawings and projects in it
  moving: Choice[]; // of export of its growth: files that move, and films that this machine can make
  recovered: boolean; // this drawing comes from a session that ended suddenly
}

/** One line of the pen. */
export interface Stroke {
  id: string;
  kind: "background" | "branch" | "crown" | "foreground" | "matte_add" | "matte_erase" | "obstacle";
  xy: number[]; // x, y, x, y …; the page's units, y down
  pressure: number[] | null; // one a point
  time: number[] | null; // milliseconds since the pen went down
  width: number | null; // of the line, page units
  closed: boolean;
  view_deg: number; // azimuth of the page when it was drawn: 0 the front, 90 from the tree's right (+x)
}

/** What the tree is to be like. `None`, where it may be: what the template says. */
export interface Options {
  template: string; // auto | none | a name
  theta: "fit" | "fixed";
  height: number | null; // metres
  planar: boolean;
  crown: "auto" | "off";
  generations: number | null;
  fill: boolean;
  density: number;
  gravity: number; // how many times their own weight bends undrawn branches (`--sag`)
  light: number;
  seed: number;
  leaf: string | null; // a model, or "none"
  bark: string | null;
  season: "autumn" | "bare" | "spring" | "summer";
  foliage: "contrast" | "paper"; // of a photo, and all that follow: what counts as foliage, what sets it apart or what is green or red
  library: string; // subtrees that grow
  alternate: boolean; // round all sides; False: towards the photo alone
  colours: "photo" | "season"; // of the leaves
  leaf_size: number; // times what covers the foliage
  leaf_density: number;
  leaf_arrangement: "alternate" | "decussate" | "opposite" | "spiral" | "whorled" | null; // about their twig; None: the species'
  bark_colour: "photo" | "species";
}

/** One thing done to the tree by hand, for the page's list. */
export interface Edit {
  what: "adopted" | "cleared" | "held";
  limb: string;
  share: number[]; // held: places along the limb, 0 its foot, 1 its tip
  depth: number[]; // held: depth at each
}

/** How the tree is taken from scribbles on the photo under the page, and what was done to its contour by hand. */
export interface Trunk {
  on: boolean; // it is
  vertices: number | null; // of the contour; None: by its roughness
  gap: number; // pixels over which pieces of the matte belong together
  levels: number; // of branches that are grafted on
  remove: [number, number][]; // the vertex nearest to each
  add: [number, number][]; // the point of the contour nearest to each is one
  merge: [[number, number], [number, number]][]; // those between
  root: [number, number] | null; // where the trunk stands; None: the middle of its foot
  matting: "closed-form" | "layered" | "normalised"; // how the matte is found: ours, Levin's, the paper's
  lift: "elevation" | "siblings"; // how the trunk gets its depths: the paper's turns of siblings, or our inference
}

/** A picture to trace over; its bytes are at /underlay/<digest>. */
export interface Underlay {
  digest: string;
  x: number; // of its top left corner, page units
  y: number;
  width: number; // page units
  height: number;
  opacity: number;
  photo: boolean; // it shows the tree: strokes mark its crown and limbs, and its limbs are traced
}

/** Points of a scan behind the drawing; their bytes are at /cloud/<digest>: x, y, z of each as 32 bits (metres, y UP, the foot at the origin), then red, green, blue of each as 8, where coloured. */
export interface Cloud {
  digest: string;
  x: number; // of the foot, page units
  y: number;
  unit: number; // page units a metre
  count: number; // and what follows: the program says it
  coloured: boolean;
  height: number; // metres
  remarks: string[]; // what was done to the points of the file
}

/** How they are seen, and used. */
export interface Points {
  shown: boolean;
  size: number; // CSS pixels that a point is wide
  traced: boolean; // the tree is the one that stands in them
  turn: number; // the azimuth that the page faced last
}

/** The drawing, or what became different in it since `since` (0: everything; whatever the page has goes). */
export interface Changed {
  type: "changed";
  since: number;
  revision: number;
  put: Stroke[];
  gone: string[];
  order: string[] | null; // ids in drawing order, where they did not just come last
  options: Options | null; // None: as they were
  edits: Edit[] | null;
  trunk: Trunk | null; // None: as it was
  underlay: Underlay | null;
  underlay_changed: boolean;
  cloud: Cloud | null;
  cloud_changed: boolean;
  points: Points | null; // None: as they were
  name: string | null;
  undo: string | null; // what undo takes back; None: nothing to undo
  redo: string | null;
  saved: boolean; // as in its file
}

/** What the program is doing. */
export interface Working {
  type: "working";
  state: "error" | "idle" | "working";
  revision: number;
  stage: string; // read, match, infer, propagate, foliage, mesh, export
  done: number;
}

/** Strokes over points: what finds their depths is being made ready, once a machine. A stroke drawn meanwhile waits for it. */
export interface Warming {
  type: "warming";
  on: boolean;
}

/** Something could not be done: one paragraph, its cause and what to do. */
export interface Trouble {
  type: "trouble";
  message: string;
  remedy: string;
  stroke: string | null; // the stroke at fault
  about: "drawing" | "file" | "message" | "program";
}

/** Several trees stand in that point cloud of the folder: `Open` it again, with one of them. */
export interface Several {
  type: "several";
  name: string;
  trees: string[]; // each in words, the largest first
}

/** How like a template the drawing is. */
export interface Match {
  name: string;
  score: number;
  view_deg: number;
}

/** The templates, best first. */
export interface Matches {
  type: "matches";
  revision: number;
  used: string | null; // the one in use; None: none
  ranked: Match[];
}

/** One tree that the drawing may show. */
export interface Reading {
  odds: number;
  log_posterior: number;
  paths: number[][]; // its drawn limbs, each x, y, z, x, y, z … page units, y down, z towards the viewer
}

/** Other readings of the drawing, the present one first. */
export interface Alternatives {
  type: "alternatives";
  revision: number;
  readings: Reading[];
}

/** The project is on disk, as it was when that was asked. */
export interface Saved {
  type: "saved";
  name: string;
  files: string[]; // what is in the folder now
  drawing: string; // what the drawing is called now: another, where another was opened meanwhile
  saved: boolean; // is the drawing as in the file? Not if it was drawn on meanwhile
}

/** Where a stroke was joined, or what it was taken for: for the page to show. */
export interface Mark {
  stroke: string;
  parent: string | null;
  x: number;
  y: number; // down
  doubtful: boolean;
  reason: string;
}

/** How the drawing was read. */
export interface Read {
  type: "read";
  revision: number;
  marks: Mark[];
  roles: Record<string, string>; // stroke id → crown, obstacle, ground, shadow, leaves, dot …, for those that are no branch
  warnings: string[];
}

/** The limbs of one tree that show in the photo, as joints, parents first. */
export interface TracedTree {
  xy: number[]; // x, y of each joint; page units, y down
  parent: number[]; // number of the joint before; -1 at the root
  width: number[]; // of the limb that ends there, page units
  drawn: boolean[]; // lies on a stroke; the others were found in the photo
}

/** What shows of limbs in the photo under the page, as the strokes mark it; none where no stroke marks any, or the picture is only one to trace over. */
export interface Traced {
  type: "traced";
  revision: number;
  trees: TracedTree[];
  remark: string; // what is missing, or went wrong; empty: nothing
  waits: boolean; // the foliage of a crown is being looked for; then limbs are traced once more, apart from it
}

/** Where foliage shows in the photo, within its crowns. It comes later than the limbs, when a crown is another. */
export interface Foliage {
  type: "foliage";
  revision: number;
  png: string; // base64; as large as the picture, or smaller; opaque where foliage is. Empty: not known
}

/** How much of each pixel of the photo under the page is tree, as scribbles and what is painted in by hand tell. */
export interface Matte {
  type: "matte";
  revision: number;
  png: string; // base64; as large as the photo, or smaller; as opaque as the tree is there. Empty: not known
}

/** The trunk that the matte shows, and its contour's vertices. It comes after the matte, and goes with it. */
export interface Trunks {
  type: "trunks";
  revision: number;
  state: "failed" | "none" | "ready" | "waits" | "works"; // none: nothing is scribbled; waits: for the pen to rest
  trees: TracedTree[]; // its skeleton; all of it `drawn`
  vertices: number[][]; // of each ring of the contour: x, y, x, y …, pixels of the photo, y down
  parts: boolean[][]; // of each vertex: it parts the contour, so that a branch may end there
  contour: number[][]; // each ring itself, to within a pixel: x, y, x, y …
  size: number[]; // width and height of the photo in those pixels
  remark: string; // why there is none, or what a person should know
}

/** Strokes were proposed; they are in the drawing as it is at that revision. */
export interface Proposed {
  type: "proposed";
  revision: number;
  why: string; // what speaks against them; empty: nothing
}

/** How far the tree of the photo is, which grows towards its foliage. It comes as a `Tree` of phase "photo", and stays until another does, or until there is `none`. */
export interface Growing {
  type: "growing";
  revision: number;
  state: "failed" | "grows" | "none" | "ready" | "stopped" | "waits"; // none: nothing to grow; waits: for the foliage, or for the pen to rest
  stage: string;
  done: number;
  remark: string; // why it failed
}

/** How far something is that a page asked for by HTTP, under this id: a growth, a file. */
export interface Making {
  type: "making";
  id: string;
  stage: string;
  done: number;
}

/** The wood of one chunk in one material. Arrays, by `array` + one of these: `position` f4 (vertex 3) metres, `normal` i1 (vertex 4) of 127, `uv` f4 (vertex 2), `limb` u2 (vertex) index of `limbs`, `index` u4 (triangle 3). */
export interface Wood {
  array: string;
  material: string;
  limbs: string[]; // ids of the limbs it holds
}

/** Leaves (or blossoms, or stems) of one chunk: one card at many places. Arrays: `place` f4 (leaf 3) metres, `turn` i2 (leaf 4) quaternion x y z w of 32767, `scale` f4 (leaf 3), `tint` u1 (leaf 3) linear, of 255. */
export interface Leaves {
  array: string;
  card: string;
}

/** All that grows on one drawn limb, up to the next drawn ones. A chunk takes the place of that with the same owner. */
export interface Chunk {
  owner: string; // limb id
  digest: string;
  wood: Wood[];
  leaves: Leaves[];
}

/** A leaf of size 1. Arrays: `position` f4 (vertex 3), `normal` f4 (vertex 3), `uv` f4 (vertex 2), `index` u4 (triangle 3). */
export interface Card {
  name: string;
  array: string;
  material: string;
}

/** What a part wears. Its maps are at /texture/<key>/<map>.png, for those that `maps` names: color, normal, roughness, translucency. */
export interface Material {
  key: string;
  maps: string[];
  color: number[]; // linear factor, 4
  roughness: number;
  cutoff: number | null;
  double_sided: boolean;
  translucency: number;
}

/** A limb that was drawn or adopted. */
export interface Limb {
  id: string;
  strokes: string[]; // ids of the strokes that drew it, the first names it; none: adopted
  parent: string | null;
  order: number;
  locked: boolean; // held at every node
  held: number[]; // places along it that are held, 0-1
  share: number[]; // place of each point of `path`
  path: number[]; // x, y, z … metres, world
  sd: number[]; // of the depth at each point of `path`, metres; -1 unknown
  view_deg: number; // of the page it was drawn on
  was: string | null; // adopted: its id while it was undrawn
}

/** Where an array lies in the frame, and what it is. */
export interface Array {
  name: string;
  dtype: "f4" | "i1" | "i2" | "u1" | "u2" | "u4";
  shape: number[];
  offset: number;
}

/** The tree, or the parts of it that became different: the head of a binary frame. */
export interface Tree {
  type: "tree";
  revision: number;
  phase: "full" | "glance" | "photo" | "quick"; // quick: only what was touched is new, the rest follows; full: as the files will have it; photo: that of the photo, whole
  scale: number; // metres a page unit
  root: number[]; // x, y of the world's origin on the page, y down
  owners: string[]; // of every chunk there is now: others go
  chunks: Chunk[]; // new ones
  cards: Card[];
  materials: Material[];
  limbs: Limb[] | null; // None: as they were
  segments: number; // of the whole tree
  drawn: number; // of them drawn
  leaves: number;
  triangles: number[]; // wood, leaf; as shown
  height: number; // metres
  low: number[]; // corners of its box, metres
  high: number[];
  template: string | null;
  leaf: string | null; // as worn
  bark: string;
  warnings: string[];
  arrays: Array[];
}

/** What the stroke in hand, or the limb being dragged, would be: array `path` f4 (point 3) metres a limb, in order; none: away with it. */
export interface Ghost {
  type: "ghost";
  revision: number;
  radius: number[]; // metres, at the foot, one a path
  arrays: Array[];
}

/** The first message of a page. */
export interface Hello {
  type: "hello";
  version: number;
}

/** One line of the pen. */
export interface SentStroke {
  id: string;
  kind: "background" | "branch" | "crown" | "foreground" | "matte_add" | "matte_erase" | "obstacle";
  xy: number[]; // x, y, x, y …; the page's units, y down
  pressure?: number[] | null; // one a point
  time?: number[] | null; // milliseconds since the pen went down
  width?: number | null; // of the line, page units
  closed?: boolean;
  view_deg?: number; // azimuth of the page when it was drawn: 0 the front, 90 from the tree's right (+x)
}

/** Strokes go, others come, as one step that can be undone: a line drawn, erased, cut in two, moved, closed. */
export interface Strokes {
  type: "strokes";
  label: string; // what undo calls it: "branch", "erase", "move" …
  put?: SentStroke[]; // one with an id that is there already takes its place
  gone?: string[];
}

/** The stroke in hand, now and then: nothing is kept, a `Ghost` comes back. `None`: the pen was lifted. */
export interface Sketching {
  type: "sketching";
  stroke?: SentStroke | null;
}

/** Other options, those named. `label` and a quick succession make one step of undo: a slider being dragged. */
export interface Choose {
  type: "choose";
  options: Record<string, boolean | number | string | null>;
}

/** How the tree is taken from scribbles on the photo under the page, and what was done to its contour by hand. */
export interface SentTrunk {
  on?: boolean; // it is
  vertices?: number | null; // of the contour; None: by its roughness
  gap?: number; // pixels over which pieces of the matte belong together
  levels?: number; // of branches that are grafted on
  remove?: [number, number][]; // the vertex nearest to each
  add?: [number, number][]; // the point of the contour nearest to each is one
  merge?: [[number, number], [number, number]][]; // those between
  root?: [number, number] | null; // where the trunk stands; None: the middle of its foot
  matting?: "closed-form" | "layered" | "normalised"; // how the matte is found: ours, Levin's, the paper's
  lift?: "elevation" | "siblings"; // how the trunk gets its depths: the paper's turns of siblings, or our inference
}

/** Take the tree from the scribbles so, with these edits of its contour. A quick succession under one `label` makes one step of undo. */
export interface ChooseTrunk {
  type: "choosetrunk";
  trunk: SentTrunk;
  label?: string;
}

/** How they are seen, and used. */
export interface SentPoints {
  shown?: boolean;
  size?: number; // CSS pixels that a point is wide
  traced?: boolean; // the tree is the one that stands in them
  turn?: number; // the azimuth that the page faced last
}

/** See the points so, and use them so. A quick succession under one `label` makes one step of undo. */
export interface ChoosePoints {
  type: "choosepoints";
  points: SentPoints;
  label?: string;
}

/** The page faces this azimuth: a drawing with points behind it remembers that. No step. */
export interface Turned {
  type: "turned";
  turn: number;
}

/** Points of a scan behind the drawing; their bytes are at /cloud/<digest>: x, y, z of each as 32 bits (metres, y UP, the foot at the origin), then red, green, blue of each as 8, where coloured. */
export interface SentCloud {
  digest: string;
  x: number; // of the foot, page units
  y: number;
  unit: number; // page units a metre
  count?: number; // and what follows: the program says it
  coloured?: boolean;
  height?: number; // metres
  remarks?: string[]; // what was done to the points of the file
}

/** Another place for the points behind the drawing; `None` takes them away. */
export interface SetCloud {
  type: "setcloud";
  cloud?: SentCloud | null;
}

/** What would it look like with this template? Nothing is kept; a `Tree` of phase "glance" comes. `None`: back to the tree. */
export interface Glance {
  type: "glance";
  template?: string | null;
}

/** A limb's depth at one place is so, whatever else changes. An undrawn limb is adopted first. While `live`, a drag: nothing is kept yet and a `Ghost` comes back. */
export interface Hold {
  type: "hold";
  limb: string;
  share: number;
  depth: number;
  live?: boolean;
}

/** A limb, with all it bears, to the other side of the page. */
export interface Flip {
  type: "flip";
  limb: string;
}

/** The whole tree to the other side. */
export interface Mirror {
  type: "mirror";
}

/** A limb stays as it is, or is free again: an adopted one is given up, one that was deleted may grow again. An undrawn limb is adopted by locking. */
export interface Lock {
  type: "lock";
  limb: string;
  on: boolean;
}

/** A limb and all it bears. Nothing grows again where an undrawn one stood. */
export interface Delete {
  type: "delete";
  limb: string;
}

/** Infer all depths anew that nobody holds, whatever they were. */
export interface Settle {
  type: "settle";
}

/** Which other trees may the drawing show? */
export interface Readings {
  type: "readings";
}

/** Take one of the readings. */
export interface Pick {
  type: "pick";
  reading: number;
  revision: number; // of the `Alternatives` it is one of
}

/** One step back. */
export interface Undo {
  type: "undo";
}

/** One step on. */
export interface Redo {
  type: "redo";
}

/** Stop the work that is going on. */
export interface Cancel {
  type: "cancel";
}

/** An empty page. What was there can be had again by undo. */
export interface New {
  type: "new";
}

/** How the points of a file are to be read. */
export interface CloudReading {
  tree?: number | null; // which of several, 1 the largest
  up?: "auto" | "y" | "z"; // the file's axis that is up
  unit?: number; // metres that 1 in the file means
  height?: number | null; // metres of the plant, which say the unit
}

/** A drawing or project of the folder, or an example. */
export interface Open {
  type: "open";
  name: string;
  example?: boolean;
  cloud?: CloudReading; // if it is one
}

/** The project, under this name in the folder. */
export interface Save {
  type: "save";
  name: string;
  over?: boolean; // even if another file of that name is there
}

/** A picture to trace over; its bytes are at /underlay/<digest>. */
export interface SentUnderlay {
  digest: string;
  x: number; // of its top left corner, page units
  y: number;
  width: number; // page units
  height: number;
  opacity?: number;
  photo?: boolean; // it shows the tree: strokes mark its crown and limbs, and its limbs are traced
}

/** Another place for the picture to trace over; `None` takes it away. */
export interface SetUnderlay {
  type: "setunderlay";
  underlay?: SentUnderlay | null;
}

/** The limbs that were traced in the photo, or in the points, become the drawing, in place of the strokes; the photo is a picture to trace over again, the points are there to draw over. */
export interface UseTraced {
  type: "usetraced";
}

/** Grow the tree of the photo under the page now, without a pause after the last stroke; or stop growing it, until it is to be another. */
export interface Grow {
  type: "grow";
  on?: boolean;
}

/** Mark the main tree of the photo under the page, as a step: one stroke round its crown, one along its trunk, in place of those that mark it. A `Proposed` comes. */
export interface Propose {
  type: "propose";
}

export type Request = Hello | Strokes | Sketching | Choose | ChooseTrunk | ChoosePoints | Turned | SetCloud | Glance | Hold | Flip | Mirror | Lock | Delete | Settle | Readings | Pick | Undo | Redo | Cancel | New | Open | Save | SetUnderlay | UseTraced | Grow | Propose;
export type Event = Welcome | Changed | Working | Warming | Trouble | Several | Matches | Alternatives | Saved | Read | Traced | Foliage | Matte | Trunks | Proposed | Growing | Making | Tree | Ghost;
