"""A traced tree → the tree with the twigs that were too thin for depth maps, as far as photos show them. Every step in order (ours).

    1. each end goes on (`steps`); a spur counts as one only if it does for `SURE` steps
    2. more twigs begin along the wood (`sprouts`) and go on
    3. short limbs that no photos show by themselves are none (`roughness`)
    4. limbs leave along their courses (`forks`)
    5. wood is as thick as photos show it (`widths`)
"""

from dataclasses import dataclass

import numpy as np

from sketchtree.axes import NULL
from sketchtree.clouds.files.placed import Placement
from sketchtree.multiview.thin.contrasts import NOISE, Contrasts
from sketchtree.multiview.thin.forks import led_back
from sketchtree.multiview.thin.roughness import SPUR, smooth
from sketchtree.multiview.thin.sprouts import sprouts
from sketchtree.multiview.thin.standing import Standing, unit
from sketchtree.multiview.thin.steps import Twigs, follow
from sketchtree.multiview.thin.widths import thickened
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import is_tip

SURE = 3  # steps
SHORTEST = 3  # steps of a twig that begins
_BACK = 6.0  # pixels of a limb that say which way it goes at its end
_FLOOR = 4.0  # pixels over the lowest wood: shadows on the ground are no twigs
_THIN = (0.1, 0.6)  # pixels: radius of what was followed


@dataclass(frozen=True, eq=False)
class Following:
    """Follows the twigs of a tree that was traced in a cloud of photos."""

    photos: Contrasts
    pixel: float  # of the plant, in the frame of the photos

    def __call__(self, tree: TreeSkeleton, placement: Placement) -> TreeSkeleton:
        """The tree in metres, y up; `placement`: where it was placed."""
        scale = placement.similarity.scale
        found = followed(tree.replace(tip=placement.to_file(tree.tip), radius=tree.radius / scale), self.photos, self.pixel)
        return found.replace(tip=placement.to_world(found.tip), radius=found.radius * scale)


def followed(tree: TreeSkeleton, photos: Contrasts, pixel: float) -> TreeSkeleton:
    """The tree, in the frame of the photos, without its roughness; wood that was followed is in the last rows, kind OBSERVED. `pixel`: of the plant, metres."""
    floor, wood = float(tree.tip[:, 1].min()) + _FLOOR * pixel, Standing(tree, pixel)
    full = _full(photos)
    ends = np.flatnonzero(is_tip(tree.parent) & (tree.parent != NULL))
    courses = np.array([_course(tree, row, _BACK * pixel) for row in ends]).reshape(-1, 3)
    twigs = Twigs(ends, tree.limb[ends], tree.tip[ends], courses, [[tree.tip[row]] for row in ends], [[] for _ in ends])
    follow(twigs, wood, photos, floor)
    spur = np.bincount(tree.limb, tree.length)[tree.limb[ends]] < SPUR * pixel
    tree = _with(tree, twigs, np.where(spur, SURE, 1), full, pixel)
    twigs = sprouts(tree, wood, photos)
    follow(twigs, wood, photos, floor)
    tree = smooth(_with(tree, twigs, np.full(len(twigs.row), SHORTEST + 1), full, pixel), photos, pixel)
    return thickened(led_back(tree, pixel), full, photos, pixel)


def _full(photos: Contrasts) -> float:
    """c of wood that fills its pixel."""
    c = photos.contrast[(photos.contrast > 255 * NOISE) & (photos.contrast < 255)]
    return max(float(np.quantile(c[:: max(1, len(c) // 200_000)], 0.9)) / 255, NOISE) if len(c) else 1.0


def _course(tree: TreeSkeleton, row: int, length: float):
    """Which way a limb goes at its end: from so many metres before it."""
    at, back = row, 0.0
    while tree.parent[at] != NULL and back < length and (at == row or tree.limb[at] == tree.limb[row]):
        back += tree.length[at]
        at = tree.parent[at]
    return unit(tree.tip[row] - tree.tip[at])


def _with(tree: TreeSkeleton, twigs: Twigs, fewest, full: float, pixel: float) -> TreeSkeleton:
    """The tree and those of the twigs that went on for so many steps."""
    more, own, limb = {name: [] for name in ("parent", "tip", "radius", "limb", "order", "tree")}, len(tree), int(tree.limb.max()) + 1
    for k, (row, way) in enumerate(zip(twigs.row.tolist(), twigs.way, strict=True)):
        steps = len(way) - 1
        if steps < fewest[k]:
            continue
        begins = twigs.own[k] == NULL
        radius = pixel * np.clip(0.5 * np.array(twigs.dark[k][:steps]) / full, *_THIN)
        more["parent"] += [row, *range(own + len(more["parent"]), own + len(more["parent"]) + steps - 1)]
        more["tip"] += way[1:]
        more["radius"] += np.minimum.accumulate(np.minimum(radius, tree.radius[row])).tolist()
        more["limb"] += [limb if begins else int(tree.limb[row])] * steps
        more["order"] += [int(tree.order[row]) + int(begins)] * steps
        more["tree"] += [int(tree.tree[row])] * steps
        limb += int(begins)
    if not more["parent"]:
        return tree
    return tree.append({name: np.array(value) for name, value in more.items()} | {"kind": np.full(len(more["parent"]), int(Kind.OBSERVED))})
