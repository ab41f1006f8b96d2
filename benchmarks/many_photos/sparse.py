"""What does structure from motion alone give? COLMAP's sparse points of the same photos, laid over the truth by its cameras."""

from pathlib import Path

import numpy as np
from jaxtyping import Float

from benchmarks.many_photos.renders import Rendered
from sketchtree.errors import ViewsError
from sketchtree.multiview.sfm import structure_from_motion


def sparse_points(truth: Rendered, place: Path) -> tuple[Float[np.ndarray, "point 3"], float, int]:
    """(points in the frame of the truth, mean distance of the cameras from the true ones as a share of their ring's radius, how many photos were placed); no points where COLMAP places too few."""
    try:
        found = structure_from_motion(truth.save(place), longest=1600).poses
    except ViewsError:
        return np.zeros((0, 3)), np.nan, 0
    ours = np.array([photo.camera.centre for photo in found.photos])
    true = np.array([camera.centre for view, camera in zip(truth.views, truth.cameras, strict=True) if view.name in {photo.name for photo in found.photos}])
    scale, turn, shift = laid_over(ours, true)
    off = np.linalg.norm(scale * ours @ turn.T + shift - true, axis=1).mean() / np.linalg.norm(true - true.mean(axis=0), axis=1).mean()
    return scale * found.points @ turn.T + shift, float(off), len(found)


def laid_over(points: Float[np.ndarray, "point 3"], onto: Float[np.ndarray, "point 3"]) -> tuple[float, Float[np.ndarray, "3 3"], Float[np.ndarray, " 3"]]:
    """Scale, rotation and shift that bring points nearest to others (Umeyama 1991)."""
    a, b = points - points.mean(axis=0), onto - onto.mean(axis=0)
    u, size, v = np.linalg.svd(b.T @ a)
    sign = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ v))])
    turn = u @ sign @ v
    scale = float((size * np.diag(sign)).sum() / (a**2).sum())
    return scale, turn, onto.mean(axis=0) - scale * turn @ points.mean(axis=0)
