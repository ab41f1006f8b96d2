"""On which drawings is depth inference measured? Four sets, each a list of `Case`.

    synthetic   54 trees of three families (families.py), one view each, made anew from fixed seeds
    real        at least four views of every measured tree: those shipped in data/measured, or a
                folder of .npz trees (option `--skeletons` or the variable SKETCHTREE_SKELETONS)
    quality     a small fixed set in data/quality, for the tests
    shared      any folder of CASE.json (truth) + CASE.svg (drawing) pairs

CASE.json: `nodes` (x right, y up, z to the viewer), `parent`, `stroke`, `order`, `radius` per node,
`strokes` [{nodes, parent, order}], `height` = H. Optional: `crown` (closed outlines), `between`
(drawn points inside each segment).
"""

import json
import os
import zlib
from pathlib import Path

import numpy as np

from benchmarks.drawing import Case, Hand, draw, make_case, random_hand
from benchmarks.families import FAMILIES, measured

DATA = Path(__file__).parent / "data"
SKELETONS = "SKETCHTREE_SKELETONS"
_TREES_PER_FAMILY = 18


def synthetic(per_family: int = _TREES_PER_FAMILY, first_seed: int = 0) -> list[Case]:
    """`per_family` trees of each family, one view each."""
    cases = []
    for family, grow in FAMILIES.items():
        for seed in range(first_seed, first_seed + per_family):
            rng = np.random.default_rng([seed, zlib.crc32(family.encode())])
            name = f"{family}_{seed:02d}"
            cases.append(draw(grow(rng), random_hand(rng), name=name, family=family, rng=rng))
    return cases


def real(folder: str | Path | None = None, views: int = 4) -> list[Case]:
    """`views` views of every measured tree in `folder` (default: SKETCHTREE_SKELETONS, else the shipped trees)."""
    folder = Path(folder or os.environ.get(SKELETONS) or DATA / "measured")
    cases = []
    for path in sorted(folder.glob("*.npz")):
        tree = measured(path)
        for view in range(views):
            rng = np.random.default_rng([view, zlib.crc32(path.stem.encode())])
            cases.append(draw(tree, random_hand(rng), name=f"{path.stem}_{view}", family=path.stem, rng=rng))
    return cases


def quality() -> list[Case]:
    """The fixed set that the tests measure on."""
    return shared(DATA / "quality")


def shared(folder: str | Path) -> list[Case]:
    """Every CASE.json of a folder, in the order of the names."""
    return [read_case(path) for path in sorted(Path(folder).glob("*.json"))]


def read_case(path: Path) -> Case:
    """One case from its JSON; the SVG beside it, where there is one, comes along."""
    data = json.loads(path.read_text())
    drawing = path.with_suffix(".svg")
    between = data.get("between")
    return make_case(
        data["name"],
        _family(data),
        np.array(data["parent"]),
        np.array(data["nodes"], float),
        np.array(data["stroke"]),
        np.array(data["radius"], float),
        data["height"],
        None if between is None else [np.array(points, float).reshape(-1, 2) for points in between],
        tuple(np.array(outline, float) for outline in data.get("crown", ())),
        drawing.read_text() if drawing.exists() else None,
    )


def write_case(case: Case, path: Path) -> None:
    """The JSON that `read_case` reads; lengths to a tenth of a millionth of the height."""
    graph = case.graph
    strokes = [
        {
            "nodes": np.r_[graph.parent[rows[0]], rows].tolist(),
            "parent": int(graph.limb_parent[limb]),
            "order": int(graph.limb_order[limb]),
        }
        for limb in range(len(graph.limb_id))
        for rows in [np.flatnonzero((graph.limb == limb) & ~graph.is_base)]
    ]
    data = {
        "name": case.name,
        "meta": {"family": case.family},
        "height": case.height,
        "nodes": np.round(case.position, 4).tolist(),
        "parent": graph.parent.tolist(),
        "stroke": graph.limb.tolist(),
        "order": graph.order.tolist(),
        "radius": np.round(case.radius, 4).tolist(),
        "strokes": strokes,
        "crown": [np.round(outline, 2).tolist() for outline in graph.crown],
        "between": [np.round(graph.curve(row)[1:-1], 2).tolist() for row in range(len(graph))],
    }
    path.write_text(json.dumps(data, separators=(",", ":")) + "\n")


def _family(data) -> str:
    meta = data.get("meta", {})
    return str(meta.get("family") or meta.get("gen") or meta.get("source") or "unknown")


__all__ = ["Case", "Hand", "quality", "read_case", "real", "shared", "synthetic", "write_case"]
