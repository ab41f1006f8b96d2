"""How do the points of a file come to lie behind an empty page? Read as somebody says: which axis is up, what 1 in the file means, or how high the plant is, which says that too."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from sketchtree.clouds.files.read_cloud import read_placed
from sketchtree.clouds.prepared.prepare import Prepared, prepare
from sketchtree.clouds.prepared.up_axis import upright
from sketchtree.editing.laid_cloud import LaidCloud, laid
from sketchtree.errors import SeveralTrees, SketchTreeError
from sketchtree.studio.messages import CloudReading

_ENDS = (0.1, 99.9)  # percentiles of the height: a few points beyond belong to nothing
_NEAR = 0.001  # of the height: who says 12 m finds 12.0
_IN_OUR_WORDS = {  # of remarks and remedies: what the command line says by its options is chosen here when the file is opened
    "If the tree lies down, say which with `--up y` or `--up z`.": "If the tree lies down, open it again and say which.",
    "Check which axis is up (`--up y` or `--up z`).": "Choose the other axis as up.",
    " (`--unit 0.001` for millimetres, 0.3048 for feet).": ". Open it again with its unit.",
}


def points_of(path: Path, asked: CloudReading) -> LaidCloud:
    """The points of one plant of a file, behind an empty page. Raises SketchTreeError; SeveralTrees where several stand in it and none was chosen."""
    try:
        cloud = laid(_prepared(path, asked))
    except SeveralTrees:
        raise
    except SketchTreeError as error:
        raise type(error)(error.message, remedy=_in_our_words(error.remedy)) from error
    return replace(cloud, remarks=tuple(map(_in_our_words, cloud.remarks)))


def _prepared(path: Path, asked: CloudReading) -> Prepared:
    if asked.height is None:
        return prepare(read_placed(path, unit=asked.unit), up=asked.up, tree=asked.tree)
    placed = read_placed(path)
    low, high = np.percentile(upright(placed.cloud, asked.up, placed.says_up).cloud.xyz[:, 1], _ENDS)
    unit = asked.height / max(float(high - low), 1e-9)
    found = _at(path, unit, asked)
    if abs(found.cloud.height / asked.height - 1.0) > _NEAR:  # ground, or what else was taken away
        found = _at(path, unit * asked.height / found.cloud.height, asked)
    return found


def _at(path: Path, unit: float, asked: CloudReading) -> Prepared:
    return prepare(read_placed(path, unit=float(np.clip(unit, 1e-6, 1e4))), up=asked.up, tree=asked.tree)


def _in_our_words(text: str) -> str:
    for theirs, ours in _IN_OUR_WORDS.items():
        text = text.replace(theirs, ours)
    return text
