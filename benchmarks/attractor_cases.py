"""Trees to grow to attractors: made-up ones, a sketch with a crown, and photos with strokes by hand.

A photo's limbs are lines on its page. Here each leaves the page by an angle of its own, by turns towards the viewer and away from him: enough to see what growth makes of them.
"""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from sketchtree.axes import NULL
from sketchtree.drawn_tree import draw_out
from sketchtree.keys import root_key
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.parameters import Habit
from sketchtree.propagate.attractors.target import Target
from sketchtree.roots import without_roots
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import sum_from_root

HEIGHT = 10.0  # metres, of the made-up trees and those of photos


@dataclass(frozen=True, eq=False)
class Case:
    """A tree to be grown, and where its foliage was seen."""

    name: str
    tree: TreeSkeleton
    target: Target
    habit: Habit = Habit()


def made_up() -> list[Case]:
    """A trunk with three limbs in a disc, an ellipse, and two lobes with a gap between."""
    h = HEIGHT
    disc, wide = [_ring((0, 0.62 * h), (0.37 * h, 0.35 * h))], [_ring((0.1 * h, 0.6 * h), (0.52 * h, 0.3 * h))]
    lobes = [_ring((-0.22 * h, 0.58 * h), (0.2 * h, 0.17 * h)), _ring((0.2 * h, 0.7 * h), (0.23 * h, 0.24 * h))]
    return [Case(name, _three_limbs(h), Target.of_outlines(rings)) for name, rings in (("disc", disc), ("wide", wide), ("two lobes", lobes))]


def sketched(path: Path) -> Case:
    """A sketch that has a crown, its limbs in space by the default method."""
    drawn = draw_out(path, key=root_key(0))
    tree, _ = without_roots(drawn.skeleton)
    return Case(path.stem, tree, Target.of_outlines(drawn.crown), drawn.habit)


def photographed(path: Path) -> Case:
    """A photo case by hand: its `NAME.json` with the mask beside it."""
    found = json.loads(path.read_text())
    mask = np.asarray(Image.open(path.with_name(found["mask"])).convert("L")) > 127
    rows = np.flatnonzero(mask.any(axis=1))
    root = np.array(found["root"], float)
    pixel = HEIGHT / (root[1] - rows[0])
    limbs = [(limb["name"], (np.array(limb["points"], float) - root) * [pixel, -pixel], 0.5 * pixel * np.array(limb["widths"], float)) for limb in found["limbs"]]
    return Case(path.stem, _lifted(limbs), Target(mask, -root[0] * pixel, root[1] * pixel, pixel))


def _ring(centre, half):
    turn = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    return np.asarray(centre) + np.column_stack([np.cos(turn), np.sin(turn)]) * half


def _three_limbs(h: float) -> TreeSkeleton:
    trunk = np.array([[0, 0], [0.01, 0.3], [0.0, 0.45], [0.03, 0.62], [0.05, 0.85]]) * h
    left = np.array([[0.0, 0.42], [-0.1, 0.53], [-0.22, 0.62]]) * h
    right = np.array([[0.005, 0.38], [0.1, 0.45], [0.25, 0.56]]) * h
    back = np.array([[0.02, 0.55], [0.09, 0.64], [0.15, 0.75]]) * h
    limbs = [("trunk", trunk), ("left", left), ("right", right), ("back", back)]
    return _lifted([(name, line, np.linspace(0.02, 0.006, len(line)) * h) for name, line in limbs])


def _lifted(limbs) -> TreeSkeleton:
    """Lines on the page as a tree: each hangs on the nearest earlier one, and leaves the page by turns."""
    parent, tip, radius, limb, order, lean = [NULL], [limbs[0][1][0]], [limbs[0][2][0]], [0], [0], [0.0]
    for number, (_, line, half) in enumerate(limbs):
        above = 0
        if number:
            start = line[0]
            above = int(np.argmin(np.linalg.norm(np.array(tip) - start, axis=1)))
        first, angle = len(tip), (0.0 if number == 0 else np.tan(np.radians((15.0, 35.0, 50.0)[number % 3])) * (-1) ** (number // 1))
        for k, (point, width) in enumerate(zip(line[1:], half[1:], strict=True)):
            parent.append(above if k == 0 else len(tip) - 1)
            tip.append(point)
            radius.append(max(width, 1e-3))
            limb.append(number)
            order.append(0 if number == 0 else order[above if k == 0 else first] + (k == 0))
            lean.append(angle)
    parent, tip, limb = np.array(parent), np.array(tip, float), np.array(limb)
    run = np.where(parent == NULL, 0.0, np.linalg.norm(tip - tip[np.maximum(parent, 0)], axis=1))
    depth = sum_from_root(parent, run * np.array(lean))
    ids = np.array([stroke_limb_id(f"{name} {k}") for k, (name, _, _) in enumerate(limbs)])
    return TreeSkeleton.from_columns(
        parent, np.column_stack([tip, depth]), np.array(radius), order=np.array(order), limb=ids[limb], stroke=limb, kind=np.full(len(tip), int(Kind.DRAWN))
    )
