"""`sketchtree grow INPUT -o GROWTH.glb`: a picture with scribbles, a drawing, or any tree, as a tree that grows."""

import time
from pathlib import Path

import click

from sketchtree.commands import options
from sketchtree.commands.progress import Progress

_FILE = click.Path(path_type=Path)


@click.command("grow")
@click.argument("source", metavar="INPUT", type=_FILE)
@click.option("-o", "--output", required=True, type=_FILE, metavar="GROWTH", help="Growing: .glb .gltf .usd .usda .usdc .usdz. Grown up, or at --time: .obj .ply .stl .3mf .swc .mtg .json .h5 .png too.")
@click.option("--scribbles", type=_FILE, metavar="S.json|S.svg", help="Lines on the tree (foreground) and beside it (background), in the picture's pixels.")
@click.option("--use-matte", type=_FILE, metavar="A.png", help="Take the matte from a picture of the same size, white where the tree is.")
@click.option("--matting", type=click.Choice(["layered", "normalised", "closed-form"]), default="layered", show_default=True, help="How the matte is found.")
@click.option("--edit-matte", type=_FILE, metavar="E.svg|E.png", help="Add or erase branches: strokes in layers `add` and `erase`, or a picture (white adds, black erases, grey leaves alone).")
@click.option("--vertices", type=_FILE, metavar="EDITS.json", help="Vertices of the contour: how many, and which to remove, add or merge (docs/formats.md).")
@click.option("--gap", type=float, default=3.0, show_default=True, metavar="PX", help="Pieces of the matte so near to the trunk belong to it.")
@click.option("--root", nargs=2, type=float, metavar="X Y", help="Where the trunk stands, pixels (default: the middle of its foot).")
@click.option("--lift", type=click.Choice(["siblings", "elevation"]), default="siblings", show_default=True, help="How the trunk gets its depths: the paper's turns of siblings, or our inference.")
@click.option("--matte", type=_FILE, metavar="A.png", help="Write the matte, with its edits.")
@click.option("--trunk", type=_FILE, metavar="TRUNK.swc", help="Write the trunk (pixels, y negated).")
@click.option("--levels", type=int, metavar="0-5", help="Levels of branches that are grafted on (default: 3 on a picture's trunk, else 0).")
@click.option("--mode", type=click.Choice(["age", "full", "scale"]), default="full", show_default=True, help="Branches by age; the same and the tree small while young; or the whole tree scaled.")
@click.option("--bend", type=float, default=0.0, show_default=True, metavar="DEGREES", help="-60 (branches come to hang) to 60 (they rise); the paper's pictures go from -25 to 20.")
@click.option("--time", "moment", type=float, metavar="0-1", help="The tree at that time of its growth, not moving.")
@click.option("--seconds", type=float, default=10.0, show_default=True, metavar="S", help="How long it grows, 0.1 to 600.")
@click.option("--joints", type=int, metavar="N", help="At most so many joints move it, 64 to 60,000 (default: 3,000; of `--lod 2` 1,500, of `--lod 3` 750): fewer open faster in other programs, more move more finely.")
@click.option("--movie", type=_FILE, metavar="M.mp4", help="Write a film too: .mp4 .gif .webp .apng.")
@click.option("--series", type=_FILE, metavar="DIR", help="Write the tree at even times too: NAME_0000.glb ... in this folder.")
@click.option("--frames", type=int, metavar="N", help="Pictures of the film (default 72), trees of the series (default 24): 2 to 720.")
@click.option("--variations", type=int, default=1, show_default=True, metavar="N", help="So many crowns on one trunk, 1 to 64: NAME_1.glb, NAME_2.glb ...; the first is the one without this option.")
@options.lod
@click.option("--compact", is_flag=True, help="Of glTF: vertices in small numbers, a third less of them (KHR_mesh_quantization: three.js, Blender and game engines read it).")
@options.reading
@options.tree(200_000, "the tree")
@options.common
def grow(source: Path, output: Path, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
    """Make a tree that grows (single-image growth).

    INPUT is a picture of a tree, with --scribbles or --use-matte; a drawing or a project, as `build` reads; a skeleton (.swc .mtg .json .h5 .npz .csv .txt); or a .glb .gltf .usd file of ours.
    """
    began = time.perf_counter()
    from sketchtree import options as choices
    from sketchtree.commands import grow_asked, grow_read, grow_write, writing

    kind = grow_asked.kind_of(source, wanted)
    grow_asked.check_options(kind, source, output, wanted, grow_asked.given(click.get_current_context()))
    grow_asked.check_outputs(source, output, report, wanted)
    from sketchtree import pipeline
    from sketchtree.growth_tree import GrowthOptions, TrunkOptions, check_tree
    from sketchtree.templates.store.database import Database
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    reading, tree, growth, trunk = writing.split_options(wanted, choices.ReadingOptions, choices.TreeOptions, GrowthOptions, TrunkOptions)
    progress = Progress(pipeline.STAGES, quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        templates = None if db is None and reading.template == "none" else Database.open(db)
        check_tree(tree, templates)
        chosen = "seed" in grow_asked.given(click.get_current_context())
        begun, seed = grow_read.read(kind, source, wanted, templates, seed=seed, seed_chosen=chosen, reading=reading, tree=tree, trunk=trunk, watch=watch)
        trunk = trunk if begun.trunk is None else begun.trunk.wanted  # a project has its own
        run = writing.Run("grow", seed, imported, began, watch, choices.options_as_dict(reading, tree, growth, trunk) | {name: wanted[name] for name in ("moment", "seconds", "variations", "lod", "joints", "compact")})
        record = grow_write.grow_all(begun, growth, tree, output, run, wanted, kept=grow_asked.inputs(source, wanted))
        writing.write_report(report, record)
    writing.conclude(record, output, progress)
