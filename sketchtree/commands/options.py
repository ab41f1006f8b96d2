"""Options that every command, or every command that reads a sketch, has."""

from pathlib import Path

import click

METHODS = ("elevation", "chen", "chen-fixed", "okabe", "random-sign", "flat")
SEASONS = ("spring", "summer", "autumn", "bare")

_COMMON = (
    click.option("--seed", type=click.IntRange(0, 2**31 - 1), default=0, show_default=True, help="Same seed, same bytes."),
    click.option("--quiet", is_flag=True, help="Say nothing but errors."),
    click.option("--json-log", is_flag=True, help="Progress as one JSON object a line, on stderr."),
    click.option("--report", type=click.Path(path_type=Path), help="Write what was done, as JSON."),
    click.option("--db", type=click.Path(path_type=Path), help="Template database (default: the shipped one)."),
)
_DRAWING = (
    click.option("--crown", type=click.Choice(["auto", "off"]), default="auto", show_default=True, help="Use a drawn crown outline, or leave it out."),
    click.option("--max-strokes", type=click.IntRange(1), default=20_000, show_default=True, help="Refuse a sketch with more strokes."),
    click.option("--max-mb", type=click.FloatRange(0, min_open=True), default=100.0, show_default=True, help="Refuse a larger file (MB)."),
    click.option("--max-megapixels", type=click.FloatRange(0, min_open=True), default=200.0, show_default=True, help="Refuse a larger picture."),
)  # fmt: skip
_PHOTO = click.option("--max-megapixels", type=click.FloatRange(0, min_open=True), default=64.0, show_default=True, help="Refuse a larger photo (it takes some 30 bytes a pixel).")
_READING = (
    click.option("--template", default="auto", show_default=True, metavar="auto|none|NAME", help="Exemplar that supplies the prior."),
    click.option("--theta", type=click.Choice(["fit", "fixed"]), default="fit", show_default=True, help="Learn Θ from the sketch, or hold the template's."),
    click.option("--method", type=click.Choice(METHODS), default="elevation", show_default=True, help="How depths are inferred."),
    click.option("--height", type=float, metavar="METRES", help="Height of the tree (default: the template's)."),
    click.option("--planar", is_flag=True, help="An espalier or a fan: hold the depths small."),
    *_DRAWING,
)  # fmt: skip
_TREE = (
    click.option("--generations", type=float, metavar="N", help="Generations of undrawn branches, 0-50 (default 5; up to 12 inside a crown; 0: none; 3.5: half of the fourth)."),
    click.option("--fill", is_flag=True, help="Grow on until the crown is evenly filled."),
    click.option("--density", type=float, default=1.0, show_default=True, metavar="TIMES", help="Laterals a metre of limb, over the species': 0.01 to 10."),
    click.option("--light", type=float, default=0.0, metavar="0-1", help="Turn twigs towards the light and open fewer buds in the shade."),
    click.option("--obstacle", multiple=True, metavar="MESH", help="Nothing grows through it: .glb .obj .ply .stl, metres, root at the origin; may be repeated."),
    click.option("--sag", type=float, default=0.0, metavar="0-5", help="Bend undrawn branches under their own weight (1: as physics says)."),
    click.option("--shed", type=float, default=0.0, metavar="0-1", help="Drop undrawn branches that get less than this share of the light."),
    click.option("--shed-twigs", type=float, default=0.0, metavar="0-20", help="Drop undrawn branches that bear none and are shorter than this many twigs."),
    click.option("--untangle/--no-untangle", default=True, show_default=True, help="Part undrawn branches that run through others."),
    click.option("--prune", multiple=True, metavar="SHAPE", help="Cut the tree to a mesh (FILE; outside:FILE) or a plane (y<4.5, 1,1,0<3; metres). Repeatable."),
    click.option("--leaf", metavar="MODEL|EXEMPLAR|none", help="Leaf model (default: the template's)."),
    click.option("--season", type=click.Choice(SEASONS), default="summer", show_default=True),
    click.option("--bark", metavar="NAME", help="Bark (default: the template's)."),
    click.option("--wood", type=click.Choice(["one-piece", "tubes"]), help="Limbs joined into one closed surface, or a light tube each (default: one-piece up to 2,000 limbs)."),
    click.option("--solid", is_flag=True, help="Unite the wood into one solid for printing (needs sketchtree[solid])."),
)  # fmt: skip
_POINTS = (
    click.option("--method", type=click.Choice(["traced", "grown"]), default="traced", show_default=True, help="Wood where the points are; or a tree of the species, grown toward them (Guo et al. 2018)."),
    click.option("--species", default="auto", show_default=True, metavar="auto|NAME|R.toml", help="How the plant grows where it was not seen, or all of it if it is `grown`: a species, or a recipe of your own."),
    click.option("--roots", type=click.IntRange(1), metavar="K", help="How many stems come out of the ground (default: as many as are found)."),
    click.option("--keep-pot", is_flag=True, help="Don't look for a pot, or a lump of ground, under the stem."),
    click.option("--inside/--no-inside", default=None, help="Fill the inside of a crown (default: where the points leave it out)."),
    click.option("--pixel", type=float, metavar="METRES", help="How much of the plant a pixel of its photos is: twigs go on beyond what shows of them, by Eq. 5; 0: they end there (default: `views` follows them in its photos; of a scan, 0)."),
    click.option("--in-leaf", type=click.Choice(["auto", "yes", "no"]), default="auto", show_default=True, help="Whether some of the points are leaves, which are no wood."),
    click.option("--template", metavar="NAME", help="Exemplar whose leaves and bark it wears (default: bare, unless `--leaf` names some)."),
    click.option("--set", "figures", multiple=True, metavar="NAME=VALUE", help="Another figure of what is `grown`: branching=55, internode=0.8x (so many times), tropism=up (docs/clouds.md). Repeatable."),
    click.option("--vary", multiple=True, metavar="NAME=V1,V2", help="Write what is `grown` with each of these values too: TREE_NAME_V1.glb ... Repeatable."),
    click.option("--series", type=click.Path(path_type=Path), metavar="DIR", help="Write what is `grown` from its first shoot on too: TREE_0000.glb ... in this folder."),
    click.option("--frames", type=click.IntRange(2, 720), metavar="N", help="Trees of the series (default 24)."),
    click.option("--distances", type=click.Path(path_type=Path), metavar="D.ply", help="Write the points too, each with its distance from the tree as a colour and a number."),
)  # fmt: skip
_BESIDE = (
    click.option("--skeleton", type=click.Path(path_type=Path), metavar="T.swc", help="Write the complete skeleton too."),
    click.option("--preview", type=click.Path(path_type=Path), metavar="P.png", help="Write a picture of the result too."),
)  # fmt: skip
_LEAVES = click.option("--leaves", type=click.Choice(["merged", "instanced"]), default="merged", show_default=True, help="One mesh, or a few drawn at many places (.glb .gltf .usd).")
_FILES = (
    click.option("--lod", type=click.IntRange(0, 3), default=0, show_default=True, help="Level of detail to write: 1, 2, 3 have at most 50, 20, 6 % of the triangles."),
    click.option("--triangles", type=int, metavar="N", help="Write a level of detail that has so many triangles at most, leaves and all."),
    click.option("--levels", type=click.Choice(["one", "together", "apart"]), default="one", show_default=True, help="All levels and an impostor: in one file, or each in its own."),
    click.option("--pixel-error", type=float, default=1.0, show_default=True, metavar="PX", help="What an outline may be off where a coarser level takes over."),
    _LEAVES,
    click.option("--pack", type=click.Choice(["game"]), help="All that a game needs, beside TREE: levels, wind, pivots, bones, collision (docs/game.md)."),
)  # fmt: skip


def limits(command):
    """How large a picture may be, of commands that read one that is no drawing."""
    return _apply((*(option for option in _DRAWING if _named(option, "max_mb")), _PHOTO), command)


def dress(command):
    """What a tree wears, how it is pruned and what is written beside it, of commands that grow it in another way than `build`."""
    chosen = [option for option in _TREE if _named(option, "sag", "shed", "shed_twigs", "untangle", "prune", "leaf", "season", "bark", "wood", "solid")]
    return _apply((*chosen, *_BESIDE), command)


def standing(command):
    """How a plant is made of points, what it wears, and what is written beside it, of commands that begin with points."""
    worn = (option for option in _TREE if _named(option, "prune", "leaf", "season", "bark", "wood", "solid"))
    return _apply((*_POINTS, *worn, *_BESIDE, *(option for option in _FILES if _named(option, "lod", "triangles"))), command)


def leaves(command):
    """--leaves merged|instanced, of commands whose files hold one level of detail."""
    return _LEAVES(command)


def lod(command):
    """--lod 0-3, of commands whose files hold one level of detail."""
    return _apply(tuple(option for option in _FILES if _named(option, "lod")), command)


def files(command):
    """Options of what goes into a mesh file."""
    return _apply(_FILES, command)


def common(command):
    """--seed --quiet --json-log --report --db (INTERFACES: every command has them)."""
    return _apply(_COMMON, command)


def drawing(command):
    """Options of every command that reads a drawing."""
    return _apply(_DRAWING, command)


def reading(command):
    """Options of every command that turns a sketch into branches."""
    return _apply(_READING, command)


def tree(max_segments: int, of_what: str, *, beside: bool = True):
    """Options of every command that makes complete trees; `max_segments` is the default, and counts `of_what`. With those of
    what to write `beside` the one output, unless left out."""
    most = click.option("--max-segments", type=click.IntRange(1), default=max_segments, show_default=True, help=f"Segments of {of_what} at most.")
    return lambda command: _apply((*_TREE, *(_BESIDE if beside else ()), most), command)


def _named(option, *names: str) -> bool:
    """Whether a decorator adds one of the options of these names."""

    def bare() -> None:
        pass

    option(bare)
    return bare.__click_params__[0].name in names


def _apply(options, command):
    for option in reversed(options):
        command = option(command)
    return command
