"""What is known of a photo's tree besides the photo? Limbs drawn by hand over it, or the tree itself, measured branch by branch."""

import json
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from sketchtree.photo_tree import PhotoModel

NEAR = 0.012  # of the photo's height: a traced limb lies on a true one
_PAIRS = {"pair_apple_cl1": "apple_cl1", "pair_apple_cl3": "apple_cl3", "pair_nectarine_6_4_14": "nectarine_6_4_14", "pair_peach_23_03_14": "peach_23_03_14"}


def against_hand(name: str, model: PhotoModel, cases: Path | None) -> list[str]:
    """Traced limbs against those drawn by hand: lengths found, lengths that are limbs, widths."""
    told = None if cases is None else cases / f"{name}.json"
    if told is None or not told.exists():
        return []
    found = json.loads(told.read_text())
    must = [walked(limb["points"], limb["widths"]) for limb in found["limbs"] if not limb.get("optional")]
    may = np.concatenate([*must, *(walked(limb["points"], limb["widths"]) for limb in found["limbs"] if limb.get("optional"))])
    must = np.concatenate(must)
    traced = model.trees[0].traced
    rows = np.flatnonzero(traced.parent >= 0)
    ours = np.concatenate([walked([traced.xy[traced.parent[row]], traced.xy[row]], [2 * traced.radius[traced.parent[row]], 2 * traced.radius[row]]) for row in rows])
    near = NEAR * model.photo.height
    away, which = cKDTree(may[:, :2]).query(ours[:, :2])
    reach = np.maximum(near, 0.5 * may[which, 2])
    back, _ = cKDTree(ours[:, :2]).query(must[:, :2])
    on = away <= reach
    error = np.abs(ours[on, 2] - may[which[on], 2]) / may[which[on], 2]
    recall = (back <= np.maximum(near, 0.5 * must[:, 2])).mean()
    return [f"limbs by hand: found {recall:.2f} of them, {on.mean():.2f} of what was traced is one, width off by {np.median(error):.0%} (median)"]


def against_measured(name: str, model: PhotoModel, skeletons: Path | None) -> list[str]:
    """Height / width, and the crown's shape, of the model and of the measured tree."""
    if skeletons is None or name not in _PAIRS:
        return []
    told = np.load(skeletons / f"{_PAIRS[name]}.npz")
    skeleton = model.trees[0].model.skeleton
    ours, truth = _shape(np.asarray(skeleton.tip)), _shape(told["pos"].astype(float))
    parts = [f"{what} {ours[what]:.2f} ({truth[what]:.2f} measured)" for what in ours]
    return ["; ".join(parts)]


def _shape(point) -> dict[str, float]:
    """What of a tree's shape doesn't ask from which side it is seen: widths are 4 standard deviations in the round."""
    point = point - [0.0, point[:, 1].min(), 0.0]
    height = float(np.percentile(point[:, 1], 99.5))
    crown = point[point[:, 1] > 0.3 * height]
    spread = crown[:, [0, 2]] - crown[:, [0, 2]].mean(axis=0)
    width = 2.0 * float(np.percentile(np.linalg.norm(spread, axis=1), 95))
    return {"height/width": height / width, "middle of its joints, heights up": float(np.median(crown[:, 1]) / height), "depth/width": float(np.sqrt(np.prod(np.linalg.svd(spread, compute_uv=False)[::-1] ** [1.0, -1.0])))}


def walked(points, widths) -> np.ndarray:
    """Points along a line about a pixel apart, with the width there."""
    points, widths = np.asarray(points, float), np.asarray(widths, float)
    run = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    at = np.linspace(0.0, run[-1], max(int(run[-1]), 2))
    return np.column_stack([np.interp(at, run, points[:, 0]), np.interp(at, run, points[:, 1]), np.interp(at, run, widths)])
