"""Where were the photos taken from, if nobody says? Structure from motion with COLMAP (Schönberger & Frahm 2016, incremental), on the CPU → Poses.

Photos of other sizes, other cameras and without EXIF may be mixed: photos of one size and, by their EXIF, of one camera and focal length share a camera (if
each had its own, small sets would bend), and a focal length that is not told is taken as 1.2 times the longer side and found with the rest. Its threads add
numbers in no fixed order, so that two runs agree to about a thousandth of a pixel, not to the last bit. What COLMAP finds is held against what every two photos
say by themselves (`agreement`). COLMAP works in a process of its own (`placing`, `apart`), so that Ctrl-C, or a pulse that raises, ends it at once.
"""

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path

from PIL import Image, ImageOps

from sketchtree.errors import ViewsError
from sketchtree.multiview.agreement import Pair, agreeing, contradictions
from sketchtree.multiview.apart import Lost, apart
from sketchtree.multiview.photos import blurred, photo_files, read_photo
from sketchtree.multiview.placing import placed
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
    _check_colmap()
    files = photo_files(folder)
    if len(files) < LEAST:
        raise ViewsError(f"There are only {len(files)} photos.", remedy=f"{LEAST} are the least that can be placed. {ADVICE}")
    part = part or (lambda done: None)
    with tempfile.TemporaryDirectory(prefix="sketchtree-views-") as place:
        place = Path(place)
        unsharp = blurred(files)
        shrunk, groups, silent = _copied(files, place / "photos", longest, shared(part, 0.0, 0.1), pulse)
        poses, pairs = _placed(place, groups, details, seed, shared(part, 0.1, 1.0), pulse)
    return _found(poses, pairs, files, shrunk, unsharp, silent)


def _check_colmap() -> None:
    if find_spec("pycolmap") is None:
        raise ViewsError("Finding where photos were taken from needs the package `pycolmap`.", remedy="Install it: pip install 'sketchtree[multiview]'.")


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


def _placed(place: Path, groups: list[list[str]], details: int, seed: int, part, pulse: Pulse) -> tuple[Poses, list[Pair]]:
    """The cameras that COLMAP finds, and what every two of its photos share."""
    count = sum(len(names) for names in groups)
    try:
        told = apart(placed, place, groups, details, seed, part=part, pulse=pulse)
    except Lost as lost:
        raise ViewsError(
            f"COLMAP, which finds where photos were taken from, ended before it was done ({lost}).",
            remedy="If memory ran out: close other programs, or give fewer or smaller photos. Or give the poses, if something else knows them.",
        ) from lost
    if told is None:
        raise ViewsError(f"None of the {count} photos could be placed: too few of their details were found again in others.", remedy=ADVICE)
    try:
        poses = read_colmap(place / "model")
    except ViewsError:  # a focal length below 0: what was found is no picture of a world
        raise ViewsError(f"None of the {count} photos could be placed: the cameras found make no sense.", remedy=ADVICE) from None
    row_of = {photo.name: row for row, photo in enumerate(poses.photos)}
    return poses, [Pair((row_of[one], row_of[other]), first, second) for one, other, first, second in told]


def _found(poses: Poses, pairs: list[Pair], files: list[Path], shrunk: dict[str, float], unsharp: list[str], silent: int) -> Found:
    left, doubtful = agreeing(len(poses), *contradictions([photo.camera for photo in poses.photos], pairs))
    if len(poses) >= LEAST and len(left) < max(LEAST, len(poses) / 2):
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
