"""Where were the photos taken from, if nobody says? Structure from motion with COLMAP (Schönberger & Frahm 2016, incremental), on the CPU → Poses.

Photos of other sizes, other cameras and without EXIF may be mixed: photos of one size and, by their EXIF, of one camera and focal length share a camera (if
each had its own, small sets would bend), and a focal length that is not told is taken as 1.2 times the longer side and found with the rest. Its threads add
numbers in no fixed order, so that two runs agree to about a thousandth of a pixel, not to the last bit. What COLMAP finds is held against what every two photos
say by themselves (`agreement`).
"""

import tempfile
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from PIL import Image, ImageOps

from sketchtree.errors import ViewsError
from sketchtree.multiview.agreement import Pair, agreeing, contradictions
from sketchtree.multiview.photos import blurred, photo_files, read_photo
from sketchtree.multiview.poses.colmap import read_colmap
from sketchtree.multiview.poses.posed import Poses
from sketchtree.watch import Pulse, no_pulse, shared

LEAST = 4  # photos that must be placed
ADVICE = (
    "Walk round the plant and take a photo every 10-15° (24-36 in all), a second round higher up for tall ones; keep the whole plant in the picture and the zoom as it is, "
    "have still, textured ground or a printed page around it, no wind and no blur."
)


_PHOTO, _MODEL, _FOCAL = 0x8769, 0x0110, (0x920A, 0xA405)  # EXIF: the block of the photo, the camera's model, focal length and what it were on 35 mm film


@dataclass(frozen=True)
class Found:
    """What structure from motion found."""

    poses: Poses
    left_out: tuple[str, ...]  # photos that could not be placed
    notices: tuple[str, ...]  # sentences for the user
    contradicted: float  # share of pairs of photos that did not fit the cameras


def structure_from_motion(
    folder, *, longest: int = 1600, details: int = 8192, seed: int = 0, part: Callable[[float], None] | None = None, pulse: Pulse = no_pulse
) -> Found:
    """Cameras of the photos in a folder, at most `longest` pixels a side, from about so many `details` of each. Raises ViewsError where too few belong together."""
    colmap = _colmap()
    files = photo_files(folder)
    if len(files) < LEAST:
        raise ViewsError(f"There are only {len(files)} photos.", remedy=f"{LEAST} are the least that can be placed. {ADVICE}")
    part = part or (lambda done: None)
    with tempfile.TemporaryDirectory(prefix="sketchtree-views-") as place:
        place = Path(place)
        unsharp = blurred(files)
        shrunk, groups, silent = _copied(files, place / "photos", longest, shared(part, 0.0, 0.1), pulse)
        _matched(colmap, place, groups, details, seed, part, pulse)
        poses, pairs = _mapped(colmap, place, len(files), seed, shared(part, 0.5, 1.0), pulse)
    return _found(poses, pairs, files, shrunk, unsharp, silent)


def _colmap():
    try:
        import pycolmap
    except ImportError:
        raise ViewsError("Finding where photos were taken from needs the package `pycolmap`.", remedy="Install it: pip install 'sketchtree[multiview]'.") from None
    pycolmap.logging.minloglevel = 3
    return pycolmap


def _copied(files: list[Path], place: Path, longest: int, part, pulse: Pulse) -> tuple[dict[str, float], list[list[str]], int]:
    """Upright copies of at most so many pixels a side; (by how much each is smaller, the copies that share a camera, how many tell no focal length)."""
    place.mkdir()
    by, groups, silent = {}, {}, 0
    for k, file in enumerate(files):
        pulse()
        stored = read_photo(file)
        told = stored.getexif()
        exif = _focal_only(told)
        picture = ImageOps.exif_transpose(stored).convert("RGB")
        size = picture.size
        picture.thumbnail((longest, longest), Image.Resampling.LANCZOS)
        by[file.name] = size[0] / picture.size[0]
        copy = f"{file.name}.jpg"
        picture.save(place / copy, quality=95, subsampling=0, exif=exif)
        own = (size, told.get(_MODEL), *(told.get_ifd(_PHOTO).get(tag) for tag in _FOCAL))
        groups.setdefault(own, []).append(copy)
        silent += not any(own[2:])
        part((k + 1) / len(files))
    return by, list(groups.values()), silent


def _focal_only(told: Image.Exif) -> Image.Exif:
    """What tells the focal length, and not how the photo is to be turned."""
    kept = Image.Exif()
    if _MODEL in told:
        kept[_MODEL] = told[_MODEL]
    kept.get_ifd(_PHOTO).update({tag: value for tag, value in told.get_ifd(_PHOTO).items() if tag in _FOCAL})
    return kept


def _matched(colmap, place: Path, groups: list[list[str]], details: int, seed: int, part, pulse: Pulse) -> None:
    colmap.set_random_seed(seed)
    extraction, reader = colmap.FeatureExtractionOptions(), colmap.ImageReaderOptions()
    extraction.use_gpu, reader.camera_model = False, "SIMPLE_RADIAL"
    extraction.sift.darkness_adaptivity, extraction.sift.max_num_features = True, details
    for k, names in enumerate(groups):
        colmap.extract_features(
            place / "points.db", place / "photos", names, camera_mode=colmap.CameraMode.SINGLE, reader_options=reader, extraction_options=extraction, device=colmap.Device.cpu
        )
        pulse()
        part(0.1 + 0.2 * (k + 1) / len(groups))
    matching = colmap.FeatureMatchingOptions()
    matching.use_gpu = False
    colmap.match_exhaustive(place / "points.db", matching_options=matching, device=colmap.Device.cpu)
    part(0.5)
    pulse()


def _mapped(colmap, place: Path, count: int, seed: int, part, pulse: Pulse) -> tuple[Poses, list[Pair]]:
    """The largest model, and what every two of its photos share."""
    placed = [0]

    def one_more() -> None:
        pulse()
        placed[0] += 1
        part(min(1.0, placed[0] / count))

    options = colmap.IncrementalPipelineOptions()
    options.random_seed, options.extract_colors = seed, False
    (place / "model").mkdir()
    models = colmap.incremental_mapping(place / "points.db", place / "photos", place / "model", options=options, next_image_callback=one_more)
    if not models:
        raise ViewsError(f"None of the {count} photos could be placed: too few of their details were found again in others.", remedy=ADVICE)
    best = max(models, key=lambda number: models[number].num_reg_images())
    models[best].write_binary(place / "model")
    try:
        poses = read_colmap(place / "model")
    except ViewsError:  # a focal length below 0: what was found is no picture of a world
        raise ViewsError(f"None of the {count} photos could be placed: the cameras found make no sense.", remedy=ADVICE) from None
    return poses, pairs_of(colmap, place / "points.db", models[best], poses)


def pairs_of(colmap, database: Path, model, poses: Poses) -> list[Pair]:
    """What every two photos share that COLMAP has verified by the two alone."""
    row_of, shared_by = {photo.name: row for row, photo in enumerate(poses.photos)}, []
    with closing(colmap.Database.open(database)) as told:
        xy = {
            image.image_id: model.cameras[model.images[image.image_id].camera_id].cam_from_img(told.read_keypoints(image.image_id)[:, :2].astype(np.float64))
            for image in told.read_all_images() if image.name in row_of
        }
        row_of = {number: row_of[model.images[number].name] for number in xy}
        for number, geometry in zip(*told.read_two_view_geometries(), strict=True):
            one, other = colmap.pair_id_to_image_pair(number)
            if one in xy and other in xy and len(geometry.inlier_matches):
                first, second = geometry.inlier_matches.T
                shared_by.append(Pair((row_of[one], row_of[other]), xy[one][first], xy[other][second]))
    return shared_by


def _found(poses: Poses, pairs: list[Pair], files: list[Path], shrunk: dict[str, float], unsharp: list[str], silent: int) -> Found:
    left, doubtful = agreeing(len(poses), *contradictions([photo.camera for photo in poses.photos], pairs))
    if len(left) < max(LEAST, len(poses) / 2):
        raise ViewsError(
            f"The cameras that were found can't be true: {doubtful:.0%} of the pairs of photos that share details tell other places than all of them together.",
            remedy=f"Alike parts of the plant were taken for one another. {ADVICE} Or give the poses, if something else knows them.",
        )
    photos, against = [], [photo.name.removesuffix(".jpg") for k, photo in enumerate(poses.photos) if k not in set(left)]
    for photo in (poses.photos[row] for row in left):
        name = photo.name.removesuffix(".jpg")
        size = tuple(round(side * shrunk[name]) for side in photo.camera.size)
        photos.append(replace(photo, name=name, camera=photo.camera.resized(size)))
    names = {photo.name for photo in photos}
    if len(photos) < LEAST or len(photos) < len(files) / 3:
        raise ViewsError(
            f"Only {len(photos)} of {len(files)} photos belong together: {', '.join(sorted(names)[:6])}{' …' if len(names) > 6 else ''}.",
            remedy=f"Leave out photos of other things. {ADVICE}",
        )
    notices = [f"{len(photos)} of {len(files)} photos were placed, {len(poses.points):,} points, {poses.error:.2f} px."]
    if silent:
        notices.append(f"{silent} photos don't tell their focal length (EXIF); it was found with the rest.")
    left_out = tuple(file.name for file in files if file.name not in names)
    if nothing := [name for name in left_out if name not in against]:
        notices.append(f"Left out, since too little in them was found again: {', '.join(nothing)}.")
    if against:
        notices.append(f"Left out, since what they share with other photos contradicts where they were placed: {', '.join(against)}.")
    if unsharp:
        notices.append(f"Less sharp than the others: {', '.join(unsharp)}.")
    return Found(replace(poses, photos=tuple(photos)), left_out, tuple(notices), doubtful)
