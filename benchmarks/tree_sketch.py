"""What would a person sketch of a grown tree, to ask which tree it is? For the benchmarks of matching.

The tree is seen from an azimuth; its main limbs of two or three orders are drawn, more or fewer of them, each in a few segments
(`sketchtree.drawable`); every node then misses its place by a normal error in x and in y (`jitter`, of the height). Limbs may be left out. The
crown's outline, where one is drawn, is a hand's: a smooth closed curve about the crown, neither its hull nor its edge (`crown_curve`).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.drawable import drawable
from sketchtree.skeleton import TreeSkeleton
from sketchtree.sketch.graph import SketchGraph
from sketchtree.templates.seen.footprint import crown_points, project
from sketchtree.templates.growing.procedural import grow
from sketchtree.templates.growing.recipe import Recipe, read_recipe
from sketchtree.templates.making.regenerate import recipe_folder

SCALE, PLACE = 60.0, (400.0, 40.0)  # sketch units a metre, and where the tree stands on the page
CORNERS, HARMONICS = 96, 6  # of a crown's curve


@dataclass(frozen=True)
class Pencil:
    """How one sketch is drawn."""

    azimuth: float  # degrees, from where the tree is seen
    along_stem: int = 12  # limbs on a stem, at most
    along_limb: int = 2  # laterals on another limb, at most
    deepest: int = 2  # order; 1 draws two orders, 2 three
    jitter: float = 0.01  # sd of a node's error in x and in y, of the height
    left_out: float = 0.0  # share of the limbs left out, 0-1


def random_pencil(rng: np.random.Generator, *, jitter: float = 0.01, left_out: float = 0.0) -> Pencil:
    """Any side, 6-24 limbs a stem, 1-4 laterals a limb, two or three orders."""
    return Pencil(
        azimuth=float(rng.uniform(0, 360)), along_stem=int(rng.integers(6, 25)), along_limb=int(rng.integers(1, 5)),
        deepest=int(rng.choice([1, 2, 2])), jitter=jitter, left_out=left_out,
    )  # fmt: skip


def sketch_of(tree: TreeSkeleton, pencil: Pencil, rng: np.random.Generator, *, drawn: TreeSkeleton | None = None) -> SketchGraph:
    """The sketch of a tree, its crown drawn too; `.replace(crown=())` is the one without. `drawn`: its `main_limbs`, where known."""
    drawn = main_limbs(tree, pencil) if drawn is None else drawn
    if pencil.left_out:
        drawn = _fewer(drawn, pencil.left_out, rng)
    xy = project(drawn.tip, pencil.azimuth) + rng.normal(0, 1, (len(drawn), 2)) * pencil.jitter * tree.height
    outline = crown_curve(project(crown_points(tree.start, tree.tip, tree.parent), pencil.azimuth), rng)
    limb = np.unique(drawn.limb, return_inverse=True)[1]
    return _graph(drawn.parent, SCALE * xy + PLACE, limb, (SCALE * outline + PLACE,))


def main_limbs(tree: TreeSkeleton, pencil: Pencil) -> TreeSkeleton:
    """What of the tree is drawn, before the hand shakes or leaves anything out."""
    return drawable(tree, along_stem=pencil.along_stem, along_limb=pencil.along_limb, deepest=pencil.deepest)


def crown_curve(point: Float[np.ndarray, "point 2"], rng: np.random.Generator) -> Float[np.ndarray, "corner 2"]:
    """A smooth closed curve about a crown's points: the first `HARMONICS` turns of its edge (concave, 2 % of its size outside), drawn
    2 % too large or small and missing its place smoothly by 2 % (standard deviations)."""
    size = float(np.ptp(point, axis=0).max())
    edge = shapely.concave_hull(shapely.MultiPoint(point), ratio=0.3).buffer(0.02 * size).exterior
    at = [edge.interpolate(share, normalized=True) for share in np.linspace(0, 1, CORNERS, endpoint=False)]
    wave = np.fft.fft([p.x + 1j * p.y for p in at])
    turn = np.fft.fftfreq(CORNERS, 1 / CORNERS)
    centre = wave[0]
    wave *= np.abs(turn) <= HARMONICS
    wave[1:] *= 1 + rng.normal(0, 0.02)
    low = (np.abs(turn) <= 4) & (turn != 0)
    wave[low] += CORNERS * 0.02 * size / np.sqrt(8) * (rng.normal(size=8) + 1j * rng.normal(size=8)) / np.sqrt(2)
    wave[0] = centre
    curve = np.fft.ifft(wave)
    return np.stack([curve.real, curve.imag], axis=1)


def recipes() -> list[Recipe]:
    """Every recipe of the checkout, by name."""
    return [read_recipe(path) for path in sorted(Path(recipe_folder()).glob("*.toml"))]


def grown(wanted: list[Recipe], seeds) -> Iterator[tuple[Recipe, int, TreeSkeleton]]:
    """Every recipe grown anew from every seed."""
    for seed in seeds:
        for recipe in wanted:
            yield recipe, seed, grow(recipe, seed)


def _fewer(drawn: TreeSkeleton, share: float, rng: np.random.Generator) -> TreeSkeleton:
    """Without a share of its limbs, stems excepted, taken at random among those that carry none. (What is then too short to draw goes too.)"""
    carrier = {}
    for row in np.flatnonzero(drawn.parent != NULL):
        if drawn.limb[row] != drawn.limb[drawn.parent[row]]:
            carrier.setdefault(int(drawn.limb[row]), int(drawn.limb[drawn.parent[row]]))
    stems = {int(limb) for limb in drawn.limb[drawn.is_base]}
    limbs = {int(limb) for limb in drawn.limb}
    for _ in range(round(share * len(limbs - stems))):
        free = sorted(limbs - stems - {carrier[limb] for limb in limbs if limb in carrier})
        limbs.remove(free[rng.integers(len(free))])
    rows = np.flatnonzero(np.isin(drawn.limb, sorted(limbs)))
    new = np.full(len(drawn) + 1, NULL)
    new[rows] = np.arange(len(rows))
    parent = np.where(drawn.parent[rows] == NULL, NULL, new[drawn.parent[rows]])
    rest = TreeSkeleton.from_columns(
        parent, drawn.tip[rows], drawn.radius[rows], order=drawn.order[rows], limb=drawn.limb[rows], tree=drawn.tree[rows]
    )
    return drawable(rest, along_stem=len(limbs), along_limb=len(limbs), deepest=99)


def _graph(parent, xy, limb, crown) -> SketchGraph:
    n, limbs = len(parent), int(limb.max()) + 1
    return SketchGraph(
        parent=parent, xy=xy, limb=limb, stroke=limb, tree=np.zeros(n), width=np.full(n, np.nan),
        joined=np.zeros(n, bool), curve_points=np.zeros((0, 2)), curve_start=np.zeros(n + 1),
        limb_id=np.arange(limbs), stroke_ids=tuple(f"s{i}" for i in range(limbs)), crown=crown,
    )  # fmt: skip
