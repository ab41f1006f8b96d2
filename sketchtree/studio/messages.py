"""What do the page and the program say to each other? Every message is here; the page's types (`page/src/messages.ts`) are made from this file.

    page → program   `Request`, JSON text       program → page   `Event`, JSON text, but `Tree` and `Ghost`, which are binary:

    binary frame     uint32 little-endian: length of the head     the head, JSON (a `Tree` or `Ghost`)     zeros up to a multiple of 8     the arrays

`Array.offset` counts bytes from where the arrays start. Limb ids have 63 bits, more than a number of JavaScript holds, so they are decimal text. On the
wire the page's y points down, as a canvas has it; depths are in the page's units, towards the viewer.

What breaks a rule of its type (a field too long, a number out of range, an unknown field) is refused with a `Trouble`, and nothing else happens.
"""

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

VERSION = 1
MAX_MESSAGE = 4_000_000  # bytes of one message of the page
MAX_UPLOAD = 100_000_000  # bytes of one file
MAX_POINTS = 20_000  # of one stroke
LOWEST_PLANT, TALLEST_PLANT = 0.05, 150.0  # metres that a plant in a point cloud may be said to be high
MAX_STROKES = 20_000  # of one drawing

Id = Annotated[str, Meta(min_length=1, max_length=64, pattern=r"^[^\x00-\x1f\x7f]+$")]
LimbId = Annotated[str, Meta(pattern=r"^[0-9]{1,20}$")]
Name = Annotated[str, Meta(min_length=1, max_length=120, pattern=r"^[^/\\\x00-\x1f\x7f]+$")]
Coordinate = Annotated[float, Meta(ge=-1e6, le=1e6)]
Share = Annotated[float, Meta(ge=0, le=1)]
Degrees = Annotated[float, Meta(ge=-360, le=360)]
Kind = Literal["branch", "crown", "obstacle", "foreground", "background", "matte_add", "matte_erase"]  # the last four: scribbles that say what is tree in a photo
Season = Literal["spring", "summer", "autumn", "bare"]


class _Record(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """Fields by name; any other is refused."""


class _Said(_Record, tag_field="type", tag=str.lower):
    """A message: its field `type` is its class's name in small letters."""


# What both sides speak of


class Stroke(_Record):
    """One line of the pen."""

    id: Id
    kind: Kind
    xy: Annotated[list[Coordinate], Meta(min_length=2, max_length=2 * MAX_POINTS)]  # x, y, x, y …; the page's units, y down
    pressure: Annotated[list[Share], Meta(max_length=MAX_POINTS)] | None = None  # one a point
    time: Annotated[list[Annotated[float, Meta(ge=0, le=1e9)]], Meta(max_length=MAX_POINTS)] | None = None  # milliseconds since the pen went down
    width: Annotated[float, Meta(ge=0, le=1e4)] | None = None  # of the line, page units
    closed: bool = False
    view_deg: Degrees = 0.0  # azimuth of the page when it was drawn: 0 the front, 90 from the tree's right (+x)


class Options(_Record):
    """What the tree is to be like. `None`, where it may be: what the template says."""

    template: Annotated[str, Meta(max_length=80)] = "auto"  # auto | none | a name
    theta: Literal["fit", "fixed"] = "fit"
    height: Annotated[float, Meta(gt=0, le=1000)] | None = None  # metres
    planar: bool = False
    crown: Literal["auto", "off"] = "auto"
    generations: Annotated[float, Meta(ge=0, le=50)] | None = None
    fill: bool = False
    density: Annotated[float, Meta(ge=0.01, le=10)] = 1.0
    gravity: Annotated[float, Meta(ge=0, le=5)] = 0.0  # how many times their own weight bends undrawn branches (`--sag`)
    light: Share = 0.0
    seed: Annotated[int, Meta(ge=0, le=2**31 - 1)] = 0
    leaf: Annotated[str, Meta(max_length=80)] | None = None  # a model, or "none"
    bark: Annotated[str, Meta(max_length=80)] | None = None
    season: Season = "summer"
    foliage: Literal["contrast", "paper"] = "contrast"  # of a photo, and all that follow: what counts as foliage, what sets it apart or what is green or red
    library: Annotated[str, Meta(pattern=r"^(visible|I|II)(,(visible|I|II)){0,2}$")] = "visible,I,II"  # subtrees that grow
    alternate: bool = True  # round all sides; False: towards the photo alone
    colours: Literal["photo", "season"] = "photo"  # of the leaves
    leaf_size: Annotated[float, Meta(ge=0.1, le=10)] = 1.0  # times what covers the foliage
    leaf_density: Annotated[float, Meta(ge=0.1, le=10)] = 1.0
    leaf_arrangement: Literal["alternate", "opposite", "decussate", "whorled", "spiral"] | None = None  # about their twig; None: the species'
    bark_colour: Literal["photo", "species"] = "photo"


Pixel = tuple[Coordinate, Coordinate]  # x, y of a photo, y down


class Trunk(_Record):
    """How the tree is taken from scribbles on the photo under the page, and what was done to its contour by hand."""

    on: bool = False  # it is
    vertices: Annotated[int, Meta(ge=3, le=10_000)] | None = None  # of the contour; None: by its roughness
    gap: Annotated[float, Meta(ge=0, le=1000)] = 3.0  # pixels over which pieces of the matte belong together
    levels: Annotated[int, Meta(ge=0, le=5)] = 3  # of branches that are grafted on
    remove: Annotated[list[Pixel], Meta(max_length=2000)] = []  # the vertex nearest to each
    add: Annotated[list[Pixel], Meta(max_length=2000)] = []  # the point of the contour nearest to each is one
    merge: Annotated[list[tuple[Pixel, Pixel]], Meta(max_length=2000)] = []  # those between
    root: Pixel | None = None  # where the trunk stands; None: the middle of its foot
    matting: Literal["layered", "closed-form", "normalised"] = "layered"  # how the matte is found: ours, Levin's, the paper's
    lift: Literal["siblings", "elevation"] = "siblings"  # how the trunk gets its depths: the paper's turns of siblings, or our inference


class Underlay(_Record):
    """A picture to trace over; its bytes are at /underlay/<digest>."""

    digest: Annotated[str, Meta(pattern=r"^[0-9a-f]{16,64}$")]
    x: Coordinate  # of its top left corner, page units
    y: Coordinate
    width: Annotated[float, Meta(gt=0, le=1e6)]  # page units
    height: Annotated[float, Meta(gt=0, le=1e6)]
    opacity: Share = 0.4
    photo: bool = False  # it shows the tree: strokes mark its crown and limbs, and its limbs are traced


class Cloud(_Record):
    """Points of a scan behind the drawing; their bytes are at /cloud/<digest>: x, y, z of each as 32 bits (metres, y UP, the foot at the origin), then red, green, blue of each as 8, where coloured."""

    digest: Annotated[str, Meta(pattern=r"^[0-9a-f]{16,64}$")]
    x: Coordinate  # of the foot, page units
    y: Coordinate
    unit: Annotated[float, Meta(gt=0, le=1e9)]  # page units a metre
    count: int = 0  # and what follows: the program says it
    coloured: bool = False
    height: float = 0.0  # metres
    remarks: list[str] = []  # what was done to the points of the file


class Points(_Record):
    """How they are seen, and used."""

    shown: bool = True
    size: Annotated[float, Meta(ge=0.5, le=8)] = 2.0  # CSS pixels that a point is wide
    traced: bool = False  # the tree is the one that stands in them
    turn: Degrees = 0.0  # the azimuth that the page faced last


class Edit(_Record):
    """One thing done to the tree by hand, for the page's list."""

    what: Literal["held", "cleared", "adopted"]
    limb: LimbId
    share: list[float] = []  # held: places along the limb, 0 its foot, 1 its tip
    depth: list[float] = []  # held: depth at each


# page → program


class Hello(_Said):
    """The first message of a page."""

    version: int


class Strokes(_Said):
    """Strokes go, others come, as one step that can be undone: a line drawn, erased, cut in two, moved, closed."""

    label: Annotated[str, Meta(max_length=40)]  # what undo calls it: "branch", "erase", "move" …
    put: Annotated[list[Stroke], Meta(max_length=MAX_STROKES)] = []  # one with an id that is there already takes its place
    gone: Annotated[list[Id], Meta(max_length=MAX_STROKES)] = []


class Sketching(_Said):
    """The stroke in hand, now and then: nothing is kept, a `Ghost` comes back. `None`: the pen was lifted."""

    stroke: Stroke | None = None


class Choose(_Said):
    """Other options, those named. `label` and a quick succession make one step of undo: a slider being dragged."""

    options: dict[Annotated[str, Meta(max_length=20)], None | bool | int | float | Annotated[str, Meta(max_length=80)]]


class ChooseTrunk(_Said):
    """Take the tree from the scribbles so, with these edits of its contour. A quick succession under one `label` makes one step of undo."""

    trunk: Trunk
    label: Annotated[str, Meta(max_length=40)] = "trunk"


class ChoosePoints(_Said):
    """See the points so, and use them so. A quick succession under one `label` makes one step of undo."""

    points: Points
    label: Annotated[str, Meta(max_length=40)] = "points"


class Turned(_Said):
    """The page faces this azimuth: a drawing with points behind it remembers that. No step."""

    turn: Degrees


class SetCloud(_Said):
    """Another place for the points behind the drawing; `None` takes them away."""

    cloud: Cloud | None = None


class Glance(_Said):
    """What would it look like with this template? Nothing is kept; a `Tree` of phase "glance" comes. `None`: back to the tree."""

    template: Annotated[str, Meta(max_length=80)] | None = None


class Hold(_Said):
    """A limb's depth at one place is so, whatever else changes. An undrawn limb is adopted first. While `live`, a drag: nothing is kept yet and a
    `Ghost` comes back."""

    limb: LimbId
    share: Share
    depth: Coordinate
    live: bool = False


class Flip(_Said):
    """A limb, with all it bears, to the other side of the page."""

    limb: LimbId


class Mirror(_Said):
    """The whole tree to the other side."""


class Lock(_Said):
    """A limb stays as it is, or is free again: an adopted one is given up, one that was deleted may grow again. An undrawn limb is adopted by locking."""

    limb: LimbId
    on: bool


class Delete(_Said):
    """A limb and all it bears. Nothing grows again where an undrawn one stood."""

    limb: LimbId


class Settle(_Said):
    """Infer all depths anew that nobody holds, whatever they were."""


class Readings(_Said):
    """Which other trees may the drawing show?"""


class Pick(_Said):
    """Take one of the readings."""

    reading: Annotated[int, Meta(ge=0, le=63)]
    revision: int  # of the `Alternatives` it is one of


class Undo(_Said):
    """One step back."""


class Redo(_Said):
    """One step on."""


class Cancel(_Said):
    """Stop the work that is going on."""


class New(_Said):
    """An empty page. What was there can be had again by undo."""


class CloudReading(_Record):
    """How the points of a file are to be read."""

    tree: Annotated[int, Meta(ge=1, le=10_000)] | None = None  # which of several, 1 the largest
    up: Literal["auto", "y", "z"] = "auto"  # the file's axis that is up
    unit: Annotated[float, Meta(ge=1e-6, le=1e4)] = 1.0  # metres that 1 in the file means
    height: Annotated[float, Meta(ge=LOWEST_PLANT, le=TALLEST_PLANT)] | None = None  # metres of the plant, which say the unit


class Open(_Said):
    """A drawing or project of the folder, or an example."""

    name: Name
    example: bool = False
    cloud: CloudReading = CloudReading()  # if it is one


class Save(_Said):
    """The project, under this name in the folder."""

    name: Name
    over: bool = False  # even if another file of that name is there


class SetUnderlay(_Said):
    """Another place for the picture to trace over; `None` takes it away."""

    underlay: Underlay | None = None


class Grow(_Said):
    """Grow the tree of the photo under the page now, without a pause after the last stroke; or stop growing it, until it is to be another."""

    on: bool = True


class Propose(_Said):
    """Mark the main tree of the photo under the page, as a step: one stroke round its crown, one along its trunk, in place of those that mark it. A `Proposed` comes."""


class UseTraced(_Said):
    """The limbs that were traced in the photo, or in the points, become the drawing, in place of the strokes; the photo is a picture to trace over again, the points are there to draw over."""


Request = (
    Hello | Strokes | Sketching | Choose | ChooseTrunk | ChoosePoints | Turned | SetCloud | Glance | Hold | Flip | Mirror | Lock | Delete | Settle | Readings | Pick | Undo | Redo | Cancel | New
    | Open | Save | SetUnderlay | UseTraced | Grow | Propose
)  # fmt: skip


# program → page


class Choice(_Record):
    """Something that can be picked."""

    name: str
    title: str  # for people
    picture: str | None = None  # address of its thumbnail


class Welcome(_Said):
    """The answer to `Hello`: what there is to choose from."""

    version: int
    templates: list[Choice]
    leaves: list[Choice]
    barks: list[Choice]
    seasons: list[str]
    examples: list[Choice]
    formats: list[Choice]  # of export; name is the extension with its dot
    folder: str  # its name, not its path
    files: list[str]  # drawings and projects in it
    moving: list[Choice] = []  # of export of its growth: files that move, and films that this machine can make
    recovered: bool = False  # this drawing comes from a session that ended suddenly


class Changed(_Said):
    """The drawing, or what became different in it since `since` (0: everything; whatever the page has goes)."""

    since: int
    revision: int
    put: list[Stroke] = []
    gone: list[str] = []
    order: list[str] | None = None  # ids in drawing order, where they did not just come last
    options: Options | None = None  # None: as they were
    edits: list[Edit] | None = None
    trunk: Trunk | None = None  # None: as it was
    underlay: Underlay | None = None
    underlay_changed: bool = False
    cloud: Cloud | None = None
    cloud_changed: bool = False
    points: Points | None = None  # None: as they were
    name: str | None = None
    undo: str | None = None  # what undo takes back; None: nothing to undo
    redo: str | None = None
    saved: bool = False  # as in its file


class Working(_Said):
    """What the program is doing."""

    state: Literal["idle", "working", "error"]
    revision: int
    stage: str = ""  # read, match, infer, propagate, foliage, mesh, export
    done: Annotated[float, Meta(ge=0, le=1)] = 0.0


class Warming(_Said):
    """Strokes over points: what finds their depths is being made ready, once a machine. A stroke drawn meanwhile waits for it."""

    on: bool


class Trouble(_Said):
    """Something could not be done: one paragraph, its cause and what to do."""

    message: str
    remedy: str
    stroke: str | None = None  # the stroke at fault
    about: Literal["drawing", "message", "file", "program"] = "drawing"


class Match(_Record):
    """How like a template the drawing is."""

    name: str
    score: float
    view_deg: float


class Several(_Said):
    """Several trees stand in that point cloud of the folder: `Open` it again, with one of them."""

    name: str
    trees: list[str]  # each in words, the largest first


class Matches(_Said):
    """The templates, best first."""

    revision: int
    used: str | None  # the one in use; None: none
    ranked: list[Match]


class Reading(_Record):
    """One tree that the drawing may show."""

    odds: float
    log_posterior: float
    paths: list[list[float]]  # its drawn limbs, each x, y, z, x, y, z … page units, y down, z towards the viewer


class Alternatives(_Said):
    """Other readings of the drawing, the present one first."""

    revision: int
    readings: list[Reading]


class Saved(_Said):
    """The project is on disk, as it was when that was asked."""

    name: str
    files: list[str]  # what is in the folder now
    drawing: str  # what the drawing is called now: another, where another was opened meanwhile
    saved: bool  # is the drawing as in the file? Not if it was drawn on meanwhile


class Mark(_Record):
    """Where a stroke was joined, or what it was taken for: for the page to show."""

    stroke: str
    parent: str | None
    x: float
    y: float  # down
    doubtful: bool
    reason: str


class Read(_Said):
    """How the drawing was read."""

    revision: int
    marks: list[Mark]
    roles: dict[str, str]  # stroke id → crown, obstacle, ground, shadow, leaves, dot …, for those that are no branch
    warnings: list[str]


class TracedTree(_Record):
    """The limbs of one tree that show in the photo, as joints, parents first."""

    xy: list[float]  # x, y of each joint; page units, y down
    parent: list[int]  # number of the joint before; -1 at the root
    width: list[float]  # of the limb that ends there, page units
    drawn: list[bool]  # lies on a stroke; the others were found in the photo


class Traced(_Said):
    """What shows of limbs in the photo under the page, as the strokes mark it; none where no stroke marks any, or the picture is only one to trace over."""

    revision: int
    trees: list[TracedTree]
    remark: str  # what is missing, or went wrong; empty: nothing
    waits: bool = False  # the foliage of a crown is being looked for; then limbs are traced once more, apart from it


class Foliage(_Said):
    """Where foliage shows in the photo, within its crowns. It comes later than the limbs, when a crown is another."""

    revision: int
    png: str  # base64; as large as the picture, or smaller; opaque where foliage is. Empty: not known


class Matte(_Said):
    """How much of each pixel of the photo under the page is tree, as scribbles and what is painted in by hand tell."""

    revision: int
    png: str  # base64; as large as the photo, or smaller; as opaque as the tree is there. Empty: not known


class Trunks(_Said):
    """The trunk that the matte shows, and its contour's vertices. It comes after the matte, and goes with it."""

    revision: int
    state: Literal["none", "waits", "works", "ready", "failed"]  # none: nothing is scribbled; waits: for the pen to rest
    trees: list[TracedTree] = []  # its skeleton; all of it `drawn`
    vertices: list[list[float]] = []  # of each ring of the contour: x, y, x, y …, pixels of the photo, y down
    parts: list[list[bool]] = []  # of each vertex: it parts the contour, so that a branch may end there
    contour: list[list[float]] = []  # each ring itself, to within a pixel: x, y, x, y …
    size: list[int] = []  # width and height of the photo in those pixels
    remark: str = ""  # why there is none, or what a person should know


class Proposed(_Said):
    """Strokes were proposed; they are in the drawing as it is at that revision."""

    revision: int
    why: str  # what speaks against them; empty: nothing


class Growing(_Said):
    """How far the tree of the photo is, which grows towards its foliage. It comes as a `Tree` of phase "photo", and stays until another does, or until there is `none`."""

    revision: int
    state: Literal["none", "waits", "grows", "ready", "stopped", "failed"]  # none: nothing to grow; waits: for the foliage, or for the pen to rest
    stage: str = ""
    done: Share = 0.0
    remark: str = ""  # why it failed


class Making(_Said):
    """How far something is that a page asked for by HTTP, under this id: a growth, a file."""

    id: Id
    stage: str
    done: Share


class Array(_Record):
    """Where an array lies in the frame, and what it is."""

    name: str
    dtype: Literal["f4", "u4", "u2", "u1", "i2", "i1"]
    shape: list[int]
    offset: int


class Limb(_Record):
    """A limb that was drawn or adopted."""

    id: str
    strokes: list[str]  # ids of the strokes that drew it, the first names it; none: adopted
    parent: str | None
    order: int
    locked: bool  # held at every node
    held: list[float]  # places along it that are held, 0-1
    share: list[float]  # place of each point of `path`
    path: list[float]  # x, y, z … metres, world
    sd: list[float]  # of the depth at each point of `path`, metres; -1 unknown
    view_deg: float  # of the page it was drawn on
    was: str | None = None  # adopted: its id while it was undrawn


class Material(_Record):
    """What a part wears. Its maps are at /texture/<key>/<map>.png, for those that `maps` names: color, normal, roughness, translucency."""

    key: str
    maps: list[str]
    color: list[float]  # linear factor, 4
    roughness: float
    cutoff: float | None
    double_sided: bool
    translucency: float


class Wood(_Record):
    """The wood of one chunk in one material. Arrays, by `array` + one of these: `position` f4 (vertex 3) metres, `normal` i1 (vertex 4) of 127,
    `uv` f4 (vertex 2), `limb` u2 (vertex) index of `limbs`, `index` u4 (triangle 3)."""

    array: str
    material: str
    limbs: list[str]  # ids of the limbs it holds


class Leaves(_Record):
    """Leaves (or blossoms, or stems) of one chunk: one card at many places. Arrays: `place` f4 (leaf 3) metres, `turn` i2 (leaf 4) quaternion x y z w of
    32767, `scale` f4 (leaf 3), `tint` u1 (leaf 3) linear, of 255."""

    array: str
    card: str


class Card(_Record):
    """A leaf of size 1. Arrays: `position` f4 (vertex 3), `normal` f4 (vertex 3), `uv` f4 (vertex 2), `index` u4 (triangle 3)."""

    name: str
    array: str
    material: str


class Chunk(_Record):
    """All that grows on one drawn limb, up to the next drawn ones. A chunk takes the place of that with the same owner."""

    owner: str  # limb id
    digest: str
    wood: list[Wood]
    leaves: list[Leaves]


class Tree(_Said):
    """The tree, or the parts of it that became different: the head of a binary frame."""

    revision: int
    phase: Literal["quick", "full", "glance", "photo"]  # quick: only what was touched is new, the rest follows; full: as the files will have it; photo: that of the photo, whole
    scale: float  # metres a page unit
    root: list[float]  # x, y of the world's origin on the page, y down
    owners: list[str]  # of every chunk there is now: others go
    chunks: list[Chunk]  # new ones
    cards: list[Card]
    materials: list[Material]
    limbs: list[Limb] | None  # None: as they were
    segments: int  # of the whole tree
    drawn: int  # of them drawn
    leaves: int
    triangles: list[int]  # wood, leaf; as shown
    height: float  # metres
    low: list[float]  # corners of its box, metres
    high: list[float]
    template: str | None
    leaf: str | None  # as worn
    bark: str
    warnings: list[str]
    arrays: list[Array]


class Ghost(_Said):
    """What the stroke in hand, or the limb being dragged, would be: array `path` f4 (point 3) metres a limb, in order; none: away with it."""

    revision: int
    radius: list[float]  # metres, at the foot, one a path
    arrays: list[Array]


Event = Welcome | Changed | Working | Warming | Trouble | Several | Matches | Alternatives | Saved | Read | Traced | Foliage | Matte | Trunks | Proposed | Growing | Making | Tree | Ghost
