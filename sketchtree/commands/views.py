"""`sketchtree views FOLDER -o TREE`: photos taken all round a plant in, the plant out."""

import time
from pathlib import Path

import click

from sketchtree.commands import options
from sketchtree.commands.progress import Progress

_FILE = click.Path(path_type=Path)
_STAGES = ("read", "infer", "propagate", "foliage", "mesh", "export")


@click.command("views")
@click.argument("folder", metavar="FOLDER", type=_FILE)
@click.option("-o", "--output", required=True, type=_FILE, metavar="TREE", help=".glb .gltf .usd .usdz .obj .ply .stl .3mf, .swc .mtg .json .h5, or .png")
@click.option("--poses", type=_FILE, metavar="FILE|FOLDER", help="Where the photos were taken from: transforms.json, a COLMAP model's folder, bundle.out (default: found in the photos).")
@click.option("--quality", type=click.Choice(["preview", "full"]), default="preview", show_default=True, help="Photos at 480 pixels, or at 1000.")
@click.option("--height", type=float, metavar="METRES", help="How high the plant is: photos don't know (default: as the poses say, else 10).")
@click.option("--cloud", "cloud_file", type=_FILE, metavar="C.ply", help="Write the points too.")
@click.option("--keep-ground", is_flag=True, help="Don't look for ground among the points.")
@options.standing
@options.common
def views(folder: Path, output: Path, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
    """Make the plant that many photos show (Guo et al. 2018).

    FOLDER holds 4 photos or more, taken all round it; needs sketchtree[multiview].
    """
    began = time.perf_counter()
    from sketchtree import options as choices
    from sketchtree.commands import writing
    from sketchtree.export.files import MESHES, SKELETONS, check_extension

    check_extension(output, MESHES + SKELETONS + writing.PICTURES)
    writing.check_outputs(folder, output, report, wanted["skeleton"], wanted["preview"], more={"--cloud": wanted["cloud_file"]})
    if wanted["cloud_file"] is not None:
        check_extension(wanted["cloud_file"], (".ply",))
    from sketchtree.cloud_report import cloud_report
    from sketchtree.cloud_tree import CloudOptions, cloud_to_tree
    from sketchtree.clouds.files.write_cloud import write_cloud
    from sketchtree.growth_tree import check_tree
    from sketchtree.keys import root_key, stage_key
    from sketchtree.multiview.photos_cloud import photos_cloud
    from sketchtree.templates.store.database import Database
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    tree, files = writing.split_options(wanted, choices.TreeOptions, choices.FileOptions)
    how = CloudOptions(up="y", **{name: wanted[name] for name in ("method", "species", "roots", "inside")})
    progress = Progress(_STAGES, quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        templates = Database.open(db)
        check_tree(tree, templates)
        if wanted["template"] is not None:
            templates.exemplar(wanted["template"])
        key = root_key(seed)
        with watch("read"):
            found = photos_cloud(
                folder, key=stage_key(key, "photos"), poses=wanted["poses"], quality=wanted["quality"], height=wanted["height"], keep_ground=wanted["keep_ground"], watch=Watch(progress, progress.part)
            )
            points, told = _sized(found)
        made = cloud_to_tree(points, templates, key=key, wanted=how, tree=tree, template=wanted["template"], watch=watch)
        asked = {name: wanted[name] for name in ("quality", "height", "keep_ground", "template")} | {"poses": None if wanted["poses"] is None else str(wanted["poses"])}
        run = writing.Run("views", seed, imported, began, watch, choices.options_as_dict(how, tree, files) | asked)
        with watch("export"):
            if wanted["cloud_file"] is not None:
                write_cloud(points, wanted["cloud_file"])
            unseen = writing.write_tree(made.model, output, run, skeleton=wanted["skeleton"], preview=wanted["preview"], files=files)
        record = cloud_report(made, **writing.of_run(run), warnings=(*found.notices, *told, *unseen)) | {"views": _told(found)}
        writing.write_report(report, record)
    writing.conclude(record, output, progress)


_HIGH = 10.0  # metres, where nothing says how large the plant is


def _sized(found):
    """(the points in metres, what should be known about their size)."""
    from sketchtree.clouds.cloud import PointCloud

    if found.metric:
        return found.cloud, ()
    scale = _HIGH / max(found.cloud.height, 1e-12)
    told = f"Photos don't tell how large the plant is: it was made {_HIGH:g} m high. `--height METRES` says how high it is."
    return PointCloud(scale * found.cloud.xyz, found.cloud.colour, found.cloud.normal), (told,)


def _told(found) -> dict:
    """The report's block about the photos."""
    return {
        "placed": list(found.placed),
        "left_out": list(found.left_out),
        "error": None if found.error is None else round(float(found.error), 4),
        "seconds": {name: round(value, 3) for name, value in found.seconds.items()},
    }
