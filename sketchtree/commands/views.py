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
@click.option("--engine", type=click.Choice(["auto", "numba", "jax"]), default="auto", show_default=True, help="What finds depths (auto: jax where it has a GPU, else numba).")
@options.standing
@options.common
def views(folder: Path, output: Path, seed: int, quiet: bool, json_log: bool, report: Path | None, db: Path | None, **wanted) -> None:
    """Make the plant that many photos show (Guo et al. 2018).

    FOLDER holds 4 photos or more, taken all round it; needs sketchtree[multiview].
    """
    began = time.perf_counter()
    from sketchtree.commands import writing

    given = _given(folder, wanted["poses"])
    more = {"--cloud": wanted["cloud_file"], "--distances": wanted["distances"]}
    writing.check_outputs(given, output, report, wanted["skeleton"], wanted["preview"], more=more, source="what the plant is made of")
    if wanted["cloud_file"] is not None:
        writing.check_extension(wanted["cloud_file"], (".ply",))
    from sketchtree.clouds.files.write_cloud import write_cloud
    from sketchtree.commands import of_points
    from sketchtree.keys import root_key, stage_key
    from sketchtree.multiview.photos_cloud import photos_cloud
    from sketchtree.watch import Watch

    imported = time.perf_counter() - began
    progress = Progress(_STAGES, quiet=quiet, json_log=json_log)
    watch = Watch(progress, progress.part)
    with progress.running():
        asked = of_points.asked(wanted, given=given, output=output, report=report, seed=seed, db=db, up="y")
        how = {name: wanted[name] for name in ("poses", "quality", "height", "keep_ground", "engine")}
        with watch("read"):
            found = photos_cloud(folder, key=stage_key(root_key(seed), "photos"), watch=Watch(progress, progress.part), **how)
            points, pixel, photos, told = _sized(found)
        follow = None
        if wanted["pixel"] is None:
            if photos is not None:
                from sketchtree.multiview.thin.followed import Following

                follow = Following(photos, pixel)
            asked = asked.with_pixel(0.0 if "carve" in found.seconds else pixel)  # a hull ends where shadows end
        tree = of_points.made(points, asked, watch, follow)
        record = of_points.written(
            tree, asked, "views", watch, began=began, imported=imported, given=given, options=how | {"poses": None if how["poses"] is None else str(how["poses"])},
            beside=lambda: None if wanted["cloud_file"] is None else write_cloud(points, wanted["cloud_file"]),
            told=(*found.notices, *told), blocks={"views": _told(found)},
        )  # fmt: skip
    writing.conclude(record, output, progress)


def _given(folder: Path, poses: Path | None) -> tuple[Path, ...]:
    """Every file that may be read: none of them is written over."""
    inside = [file for place in (folder, folder / "images") if place.is_dir() for file in sorted(place.iterdir()) if file.is_file()]
    return (folder, *inside, *([] if poses is None else [poses]))


_HIGH = 10.0  # metres, where nothing says how large the plant is


def _sized(found):
    """(the points in metres, what a pixel is there, what photos show of thin wood in their frame, what should be known about their size)."""
    from sketchtree.clouds.cloud import PointCloud
    from sketchtree.clouds.prepared.outliers import height_without

    if found.metric:
        return found.cloud, found.size, found.photos, ()
    scale = _HIGH / max(height_without(found.cloud.xyz), 1e-12)
    told = f"Photos don't tell how large the plant is: it was made {_HIGH:g} m high. `--height METRES` says how high it is."
    photos = None if found.photos is None else found.photos.scaled(scale)
    return PointCloud(scale * found.cloud.xyz, found.cloud.colour, found.cloud.normal), scale * found.size, photos, (told,)


def _told(found) -> dict:
    """The report's block about the photos."""
    return {
        "placed": list(found.placed),
        "left_out": list(found.left_out),
        "error": None if found.error is None else round(float(found.error), 4),
        "confirmed": None if found.confirmed is None else round(found.confirmed, 4),
        "seconds": {name: round(value, 3) for name, value in found.seconds.items()},
    }
