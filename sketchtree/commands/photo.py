"""`sketchtree photo IMAGE --strokes S.svg|--auto -o TREE`: one photo and a few strokes in, a complete textured tree out."""

import time
from pathlib import Path

import click
from click.core import ParameterSource

from sketchtree.commands import options
from sketchtree.commands.progress import Progress

_PICTURE = click.Path(path_type=Path)


@click.command("photo")
@click.argument("image", type=_PICTURE)
@click.option("--strokes", type=_PICTURE, metavar="S.svg", help="A stroke round the crown, one along the trunk, others along limbs; any sketch file, in the photo's pixels.")
@click.option("--auto", is_flag=True, help="Propose crown and trunk without strokes.")
@click.option("-o", "--output", required=True, type=_PICTURE, metavar="TREE", help=".glb .gltf .usd .usdz .obj .ply .stl .3mf, .swc .mtg .json .h5, or .png")
@click.option("--mask", type=_PICTURE, metavar="M.png", help="Write where the foliage is, white.")
@click.option("--use-mask", type=_PICTURE, metavar="M.png", help="Take the foliage from a mask of the photo's size, white where it is.")
@click.option("--traced", type=_PICTURE, metavar="VISIBLE.swc", help="Write the limbs that show in the photo (pixels, y negated).")
@click.option("--compare", type=_PICTURE, metavar="C.png", help="Write the photo beside the tree, seen from where the photo was taken.")
@click.option("--library", "libraries", multiple=True, default=("all",), show_default=True, metavar="visible|I|II|all", help="Subtrees that grow: of the visible limbs, predefined of type I, of type II; several with commas. Again for the second tree of a photo, the third ...")
@click.option("--lift", type=click.Choice(["okabe", "elevation"]), default="elevation", show_default=True, help="How the visible limbs get their depths.")
@click.option("--foliage", type=click.Choice(["contrast", "paper"]), default="contrast", show_default=True, help="What counts as foliage: what differs from round the crown, or the paper's colours.")
@click.option("--trace/--no-trace", default=True, show_default=True, help="Follow the wood in the photo on from the strokes.")
@click.option("--rounds", "--replacements", "replacements", type=click.IntRange(0, 10_000), default=100, show_default=True, help="Rounds of growth, at most. In each up to three branches are replaced, so 100 rounds are up to 300 of the paper's replacements; growth ends sooner where nothing gains. 0: the visible limbs alone.")
@click.option("--alternate/--image-only", default=True, help="Grow round all sides, or (as a comparison) towards the image alone.")
@click.option("--colours", type=click.Choice(["photo", "season"]), default="photo", show_default=True, help="Leaves as the photo shows them, or in the season's colours.")
@click.option("--bark-colour", type=click.Choice(["photo", "species"]), default="photo", show_default=True, help="Bark as the photo shows it, or in the species' own colour.")
@click.option("--fit-leaves/--no-fit-leaves", default=True, show_default=True, help="As large and dense as it takes to cover the foliage.")
@click.option("--leaf-size", type=float, default=1.0, show_default=True, metavar="TIMES", help="Larger or smaller leaves than that: 0.1 to 10.")
@click.option("--leaf-density", type=float, default=1.0, show_default=True, metavar="TIMES", help="More or fewer leaves: 0.1 to 10.")
@click.option("--leaf-arrangement", type=click.Choice(["alternate", "opposite", "decussate", "whorled", "spiral"]), help="How leaves stand about their twig (default: the species').")
@click.option("--depth", "depths", multiple=True, type=float, metavar="METRES", help="How far the second tree of a photo stands in front of the first; again for the third ...")
@click.option("--template", default="auto", show_default=True, metavar="auto|none|NAME", help="Exemplar that supplies prior, bark and leaves.")
@click.option("--height", type=float, metavar="METRES", help="Height of the (first) tree (default: the template's).")
@options.limits
@options.dress
@options.files
@options.common
def photo(image: Path, strokes: Path | None, auto: bool, output: Path, seed: int, quiet: bool, json_log: bool, report, db, **wanted) -> None:
    """Turn the tree in IMAGE, marked with a few STROKES, into a complete tree (Tan et al. 2008)."""
    began = time.perf_counter()
    from sketchtree import options as choices
    from sketchtree.commands import photo_files, writing
    from sketchtree.export.files import check_extension
    from sketchtree.photo.wanted import PhotoOptions

    photo_files.check_strokes(strokes, auto)
    asked = click.get_current_context().get_parameter_source("season") is not ParameterSource.DEFAULT
    library, *further = (photo_files.libraries(names) for names in wanted["libraries"])
    named = ("foliage", "trace", "replacements", "alternate", "colours", "fit_leaves", "leaf_size", "leaf_density", "leaf_arrangement", "bark_colour")
    how = PhotoOptions(library=library, libraries=tuple(further), bare_as_seen=not asked, **{name: wanted[name] for name in named})
    (files,) = writing.split_options(wanted, choices.FileOptions)
    check_extension(output, writing.WHOLE)
    writing.check_files(output, files)
    photo_files.check(image, strokes, output, report, wanted, files)
    from sketchtree import pipeline
    from sketchtree.keys import root_key
    from sketchtree.photo_tree import photo_to_tree
    from sketchtree.templates.store.database import Database
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    reading, tree = writing.split_options(wanted | {"method": wanted["lift"]}, choices.ReadingOptions, choices.TreeOptions)
    progress = Progress(pipeline.STAGES, quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        templates = None if db is None and reading.template == "none" else Database.open(db)
        with watch("read"):
            seen, marked, mask = photo_files.read(image, strokes, wanted["use_mask"], reading, key=root_key(seed))
            photo_files.check_trees(output, seen, len(marked))
        made = photo_to_tree(
            seen, marked, templates, key=root_key(seed), wanted=how, reading=reading, tree=tree, mask=mask, depths=wanted["depths"] or None, watch=watch
        )
        run = writing.Run("photo", seed, imported, began, watch, choices.options_as_dict(reading, tree, files, how) | {"auto": auto})
        with watch("export"):
            unseen = photo_files.write(made, output, run, wanted, files, kept=photo_files.inputs(image, strokes, wanted))
        record = photo_files.record(run, made, extra_warnings=unseen)
        writing.write_report(report, record)
    writing.conclude(record, output, progress)
