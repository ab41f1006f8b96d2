"""What a worker answers about the photo under the page. What only other workers read goes through the server as bytes, so that it need not know what they are made of."""

import contextlib
import pickle
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sketchtree.errors import SketchError, SketchTreeError
from sketchtree.keys import root_key
from sketchtree.photo.photo import Photo, turned_over
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.studio import messages
from sketchtree.studio.making.photo_asked import Asked, Place
from sketchtree.studio.making.photo_bench import PhotoBench, foliage_of, limbs_as_strokes, tint, told_limbs
from sketchtree.studio.making.photo_marks import as_svg


def traced(bench: PhotoBench, revision: int, asked: Asked) -> tuple[messages.Traced, tuple[str, ...], dict[str, bytes]]:
    """(the limbs that show, names of the crowns whose foliage is known, those whose foliage is not: for `foliages`)."""
    try:
        shown = bench.trace(asked)
    except SketchTreeError as error:
        return messages.Traced(revision=revision, trees=[], remark=f"{error.message} {error.remedy}"), (), {}
    told = messages.Traced(revision=revision, trees=told_limbs(shown.limbs, asked.place, bench.photo), remark=shown.marks.remark)
    return told, shown.known, {crown.name: pickle.dumps(crown) for crown in shown.unknown}


def limbs(bench: PhotoBench, asked: Asked) -> list[Stroke]:
    """The traced limbs as strokes on the page; none where nothing is marked. Raises SketchError."""
    shown = bench.trace(asked)
    return limbs_as_strokes(shown.marks, shown.limbs, asked.place, bench.photo)


def proposed(bench: PhotoBench, asked: Asked) -> tuple[list[Stroke], str]:
    """(strokes on the page that mark the photo's main tree, what speaks against them). Raises SketchTreeError where none stands out."""
    from sketchtree.photo.auto.propose import SURE, propose

    bench.marks(replace(asked, strokes=()))
    try:
        found = propose(bench.photo, key=root_key(asked.seed))
    except SketchError as error:
        raise SketchError("No tree stands out in the photo.", remedy="Outline its crown, and draw along its trunk.") from error
    (tree,) = found.trees
    crown = Stroke("crown", asked.place.to_page(turned_over(tree.crown), bench.photo), StrokeKind.CROWN, labelled=True, closed=True)
    limbs = [Stroke(name, asked.place.to_page(turned_over(line), bench.photo), labelled=True) for name, line in zip(tree.names, tree.branches, strict=True)]
    return [crown, *limbs], "" if found.confidence >= SURE else found.why or "several things are in doubt"


def marks_as_svg(bench: PhotoBench, asked: Asked) -> bytes:
    """The strokes in the photo's pixels. Raises SketchTreeError where it can't be read."""
    bench.marks(replace(asked, strokes=()))
    return as_svg(asked.strokes, asked.place, bench.photo)


def foliages(bench: PhotoBench, crowns: dict[str, bytes], seed: int) -> tuple[dict[str, bytes], dict[str, str]]:
    """(the foliage of each crown: for `learnt`, why others have none)."""
    found, reasons = {}, {}
    for name, crown in crowns.items():
        try:
            found[name] = pickle.dumps(foliage_of(bench.photo, pickle.loads(crown), seed))
        except SketchTreeError as error:
            reasons[name] = f"{error.message} {error.remedy}"
    return found, reasons


def learnt(bench: PhotoBench, found: dict[str, bytes]) -> None:
    """The foliage of some crowns is known."""
    bench.learn({name: pickle.loads(foliage) for name, foliage in found.items()})


def tinted(bench: PhotoBench, revision: int, names: Iterable[str]) -> messages.Foliage:
    """Where the foliage of these crowns is."""
    return messages.Foliage(revision=revision, png=tint(bench.foliages[name].mask for name in names if name in bench.foliages))


def get_ready(*, leaves: bool) -> None:
    """What is slow only the first time: a little painted photo is traced, and its leaves looked for."""
    y, x = np.mgrid[0:96, 0:96]
    grain = ((7 * x + 13 * y) % 11)[..., None]
    rgb = np.where((np.abs(x - 48) < 5)[..., None], (90, 60, 40), (150, 170, 220)) + grain
    rgb[10:50:3, 30:66:2] = (60, 120, 40)
    bench = PhotoBench()
    bench.lay("a little photo", Photo(rgb.astype(np.uint8)))
    trunk = Stroke("trunk", np.array([(48.0, -95.0), (48.0, -4.0)]))
    crown = Stroke("crown", np.array([(20.0, -60.0), (76.0, -60.0), (76.0, -2.0), (20.0, -2.0)]), StrokeKind.CROWN, labelled=True, closed=True)
    with contextlib.suppress(SketchTreeError):  # who asks is told
        shown = bench.trace(Asked(bench.digest, Place(0.0, 0.0, 96.0, 96.0), (trunk, crown)))
        for one in shown.unknown if leaves else ():
            foliage_of(bench.photo, one, 0)
