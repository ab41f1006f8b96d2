"""How good is a tree made of one photo and a few strokes? Every bar of the one-photo way in one table (Tan et al. 2008).

    python -m benchmarks.photo [--photos DIR] [--cases DIR] [--skeletons DIR] [--only NAME]... [--compare] [--size N] [--json OUT]

Without options: trees painted here. `--photos` holds the photos that `data/photo_strokes` has strokes for, `--cases` truth by hand (`NAME.json`), `--skeletons` measured trees of
`pair_*` (`NAME.npz`). `--compare` also grows by image attractors alone, lifts as the paper does, and takes one library at a time. `--size` scales photos to N pixels.

    mask, trace, grow, leaf   CPU seconds of the foliage, of one stroke's trace, of growth, of leaves                ≤ 3, 0.1, 5, 1
    IoU       of what is seen of leaves and wood, and the foliage's mask; what leaves it counts, the trunk below not   ≥ 0.85 (median)
    wood      the same of the branches, dilated by a leaf length (0.0125 of the height)                              ≥ 0.75
    near      share of attractors on the page within a leaf length of the tree                                       ≥ 0.95
    twig      share of leaves whose foot is within a petiole (a third of a leaf) of the wood or its short shoot       ≥ 0.95
    deep      depth / width of what grew                                                                             0.75-1.33
    gap       largest empty azimuth of the outer crown, in any third of its height, degrees                          ≤ 120
    E2D, E3D  energy at the end / at the first iteration: both fall                                                  < 1
"""

import argparse
import json
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from benchmarks.attractor_cases import Case
from benchmarks.attractors import measured as measured_wood
from benchmarks.painted_trees import painted
from benchmarks.photo_truth import against_hand, against_measured
from sketchtree.keys import root_key
from sketchtree.levels.raster import View, silhouette
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.photo.foliage_mask import foliage_mask
from sketchtree.photo.photo import Photo
from sketchtree.photo.read_photo import read_photo
from sketchtree.photo.read_strokes import read_strokes
from sketchtree.photo.trace.palette import Palette
from sketchtree.photo.wanted import LIBRARIES, PhotoOptions
from sketchtree.photo_tree import PhotoModel, PhotoTree, photo_to_tree, target_of
from sketchtree.skeleton import Kind
from sketchtree.watch import Watch

STROKES = Path(__file__).parent / "data" / "photo_strokes"
_PETIOLE = 1 / 3  # of a leaf
_COLUMNS = {"mask": "{:5.2f}", "trace": "{:5.3f}", "grow": "{:5.1f}", "leaf": "{:5.2f}", "IoU": "{:5.3f}", "wood": "{:5.3f}", "near": "{:5.3f}", "twig": "{:5.3f}",
            "deep": "{:5.2f}", "gap": "{:4.0f}", "E2D": "{:5.2f}", "E3D": "{:5.2f}", "leaves": "{:6d}", "segments": "{:6d}"}  # fmt: skip


class CpuWatch(Watch):
    """Seconds of processor, not of the clock."""

    def __call__(self, stage: str):
        watch = self

        class Lap:
            def __enter__(self):
                self.began = time.process_time()

            def __exit__(self, *_):
                watch.seconds[stage] = watch.seconds.get(stage, 0.0) + time.process_time() - self.began

        return Lap()


def photos(folder: Path | None, only=None, size: int | None = None):
    """(name, photo, strokes of each tree): painted ones, and those of the folder that there are strokes for, in `data/photo_strokes` or beside them."""
    for name, photo, marked in painted():
        if name in only if only else folder is None:
            yield name, photo, marked
    for strokes in [*sorted(STROKES.glob("*.svg")), *sorted(folder.glob("*.svg"))] if folder else []:
        found = next((path for path in sorted(folder.glob(f"{strokes.stem}*")) if path.suffix != ".svg"), None)
        if found is None or only and strokes.stem not in only:
            continue
        photo = read_photo(found)
        marked = read_strokes(strokes, photo)
        yield strokes.stem, *(scaled(photo, marked, size) if size else (photo, marked))


def scaled(photo: Photo, marked, longer: int):
    """The same with so many pixels on the longer side."""
    from PIL import Image

    factor = longer / max(photo.width, photo.height)
    image = Image.fromarray(photo.rgb).resize((round(photo.width * factor), round(photo.height * factor)), Image.Resampling.LANCZOS)
    more = tuple(replace(one, crown=one.crown * factor, branches=tuple(line * factor for line in one.branches)) for one in marked)
    return Photo(np.asarray(image), name=photo.name), more


def made(photo: Photo, marked, *, wanted=PhotoOptions(), reading=ReadingOptions(), tree=TreeOptions(), seed: int = 0) -> tuple[PhotoModel, dict[str, float]]:
    """(the trees of a photo, CPU seconds of every stage)."""
    watch = CpuWatch()
    model = photo_to_tree(photo, marked, key=root_key(seed), wanted=wanted, reading=reading, tree=tree, watch=watch)
    return model, watch.seconds


def seconds_of_reading(photo: Photo, marked) -> dict[str, float]:
    """CPU seconds of the mask and of one trace, the palette at hand."""
    key, palette = root_key(0), Palette.of(photo)
    began = time.process_time()
    foliage = foliage_mask(photo, marked, key=key)
    mask = time.process_time() - began
    tracing = PhotoOptions().tracing
    tracing(photo, marked, foliage, key=key, palette=palette)
    began = time.process_time()
    tracing(photo, marked, foliage, key=key, palette=palette)
    return {"mask": mask, "trace": time.process_time() - began}


def seen_at(photo: Photo, tree: PhotoTree, meshes) -> np.ndarray:
    """Where meshes are seen in the photo; rows × columns."""
    scale, pixels = tree.seen.similarity.scale, max(photo.height, photo.width)
    half = 0.5 * pixels * scale
    left, top = tree.seen.similarity.to_world(np.zeros((1, 2)))[0]
    view = View(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([left + half, top - half, 0.0]), half, pixels)
    return silhouette(meshes, view)[: photo.height, : photo.width]


def overlap(photo: Photo, tree: PhotoTree) -> float:
    """IoU of what is seen of a tree and its foliage; wood outside the region where foliage was looked for (the trunk) is left out."""
    wood = [mesh for mesh in tree.model.meshes if not mesh.name.startswith("leaf")]
    leaves = [mesh for mesh in tree.model.meshes if mesh.name.startswith("leaf")]
    shown = seen_at(photo, tree, wood) & tree.foliage.region
    if leaves:
        shown |= seen_at(photo, tree, leaves)
    return float((shown & tree.foliage.mask).sum() / (shown | tree.foliage.mask).sum())


def on_twigs(tree: PhotoTree) -> float:
    """The share of leaves within a petiole of a twig."""
    leaves, skeleton = tree.model.leaves, tree.model.skeleton
    if len(leaves) == 0:
        return 1.0
    step = 0.1 * float(np.median(leaves.size))
    points, radius = [], []
    for row in np.flatnonzero(~skeleton.is_base):
        line = skeleton.curve(row)
        run = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]
        at = np.linspace(0.0, run[-1], max(int(run[-1] / step), 1) + 1)
        points.append(np.column_stack([np.interp(at, run, line[:, axis]) for axis in range(3)]))
        radius.append(np.full(len(at), max(skeleton.radius[row], skeleton.radius[skeleton.parent[row]])))
    share = np.linspace(0.0, 1.0, 9)[:, None, None]
    shoots = (leaves.shoot[None, :, 0] * (1 - share) + leaves.shoot[None, :, 1] * share).reshape(-1, 3)
    points.append(shoots), radius.append(np.zeros(len(shoots)))
    radius = np.concatenate(radius)
    away, which = cKDTree(np.concatenate(points)).query(leaves.position)
    return float((away - radius[which] <= _PETIOLE * leaves.size).mean())


def bars(name: str, photo: Photo, model: PhotoModel, seconds: dict[str, float]) -> dict[str, float]:
    """Every bar of the first tree."""
    tree = model.trees[0]
    case = Case(name, tree.drawn.skeleton, target_of(tree.seen))
    wood = measured_wood(case, tree.model.skeleton, tree.model.skeleton.kind == Kind.PROPAGATED)  # as it is written, without what crossed other limbs
    course = next(iter(tree.grown.grown.values())).course
    fall = {kind: line[-1] / line[0] if len(line) and line[0] > 0 else np.nan for kind, line in (("E2D", course.image), ("E3D", np.array(course.space) / np.maximum(course.in_space, 1)))}
    return {
        "grow": seconds["propagate"], "leaf": seconds["foliage"], "IoU": overlap(photo, tree), "wood": wood["IoU"], "near": wood["near"], "twig": on_twigs(tree),
        "deep": wood["deep"], "gap": wood["gap"], **fall, "leaves": len(tree.model.leaves), "segments": len(tree.model.skeleton),
    }  # fmt: skip


def line_of(name: str, of: dict) -> str:
    """A line of the table."""
    return " ".join([f"{name:34}", *(how.format(of[column]) if column in of else " " * len(how.format(0)) for column, how in _COLUMNS.items())])


def heading() -> str:
    """Its first line."""
    return " ".join([f"{'':34}", *(f"{column:>{len(how.format(0))}}" for column, how in _COLUMNS.items())])


VARIANTS = {"image only": {"alternate": False}, **{f"library {name}": {"library": (name,)} for name in LIBRARIES}}


def main(argv=None) -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for option in ("--photos", "--cases", "--skeletons", "--json"):
        parser.add_argument(option, type=Path)
    parser.add_argument("--only", action="append")
    parser.add_argument("--compare", action="store_true")
    parser.add_argument("--size", type=int)
    asked = parser.parse_args(argv)
    table: dict[str, dict] = {}
    leafy: list[dict] = []
    print(heading())
    for name, photo, marked in photos(asked.photos, asked.only, asked.size):
        model, seconds = made(photo, marked)
        table[name] = seconds_of_reading(photo, marked[0]) | bars(name, photo, model, seconds)
        bare = " (bare)" if model.trees[0].foliage.bare else ""
        leafy += [] if bare else [table[name]]
        print(line_of(name + bare, table[name]), flush=True)
        for more in against_measured(name, model, asked.skeletons) + against_hand(name, model, asked.cases):
            print(f"    {more}", flush=True)
        if asked.compare:
            for variant, how in VARIANTS.items():
                other, seconds = made(photo, marked, wanted=PhotoOptions(**how))
                table[f"{name}, {variant}"] = bars(name, photo, other, seconds)
                print(line_of(f"  {variant}", table[f"{name}, {variant}"]), flush=True)
            other, seconds = made(photo, marked, reading=ReadingOptions(method="okabe"))
            table[f"{name}, okabe"] = bars(name, photo, other, seconds)
            print(line_of("  okabe", table[f"{name}, okabe"]), flush=True)
    if leafy:
        print(line_of("median of trees in leaf", {column: type(leafy[0][column])(np.median([of[column] for of in leafy])) for column in leafy[0]}))
    if asked.json:
        asked.json.write_text(json.dumps(table, indent=1))


if __name__ == "__main__":
    main()
