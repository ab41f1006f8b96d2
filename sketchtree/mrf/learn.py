"""What do the limbs of known trees say about the next one? Hyperparameters of Θ's prior, learnt from skeletons.

Every tree is brought to a sketch's granularity (`drawable`), seen from four sides, and what the model's own factors measure on it at
its true depths is kept: the count, mean and spread of divergences, length ratios, segment lengths and bends per order. The
hyperparameters are those that make all trees together likeliest, Θ of each tree integrated out (type II maximum
likelihood; Gelman et al. 2013, §5.4): for n values with mean x̄ and sum of squares S about it,

    log p(x) = ½ log(κ0/κn) + log Γ(νn/2) − log Γ(ν0/2) + ν0/2 log(ν0 s0²) − νn/2 log(νn sn²) + const

    bends:     log Γ(νn/2) − log Γ(ν0/2) + ν0/2 log(ν0 s0²) − νn/2 log(νn sn²),  νn = ν0 + 2n

times a weak prior at the generic values (one unit in log κ0, log ν0, log s0²; m0 within half a radian or half a log ratio),
so that a folder with one tree is no catastrophe.
"""

from collections.abc import Iterable
from pathlib import Path

import jax
import numpy as np
from jaxtyping import Float
from scipy.optimize import minimize
from scipy.special import gammaln

from sketchtree.axes import NULL
from sketchtree.drawable import drawable
from sketchtree.errors import SkeletonError
from sketchtree.mrf.chen.em import FLOORS
from sketchtree.mrf.compilation import compiled
from sketchtree.mrf.conjugate import GENERIC_BELIEF, LimbBelief, LimbData
from sketchtree.mrf.depths import depth_of, elevation_of
from sketchtree.mrf.factor_graph import FactorGraph, factor_graph
from sketchtree.mrf.log_posterior import log_posterior
from sketchtree.mrf.measure import measured_theta
from sketchtree.mrf.prior import Prior
from sketchtree.parameters import GENERIC, TreeParameters
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_files import ENDINGS, read_skeleton
from sketchtree.sketch.graph import SketchGraph

AZIMUTHS = np.radians([0.0, 45.0, 90.0, 135.0])
STEEPEST = np.radians(79.0)
NORMAL = ("divergence", "length", "segment")
WIDTH = np.array([0.5, 1.0, 1.0, 1.0])  # of the weak prior: m0, log κ0, log ν0, log s0²


def learnt_prior(trees: str | Path | Iterable[TreeSkeleton]) -> Prior:
    """A prior from skeletons, or from all files of a folder that hold one (.swc, .json, .npz), in the order of their
    names. Raises `SkeletonError` for an empty folder or a file that can't be read, naming it."""
    skeletons = _read(trees) if isinstance(trees, str | Path) else list(trees)
    if not skeletons:
        raise SkeletonError("There is no skeleton to learn from.", remedy=f"Give trees, or a folder of {', '.join(ENDINGS)} files.")
    views = [[_seen(tree, azimuth) for azimuth in AZIMUTHS] for tree in map(drawable, skeletons)]
    data = [[_measured(graph, psi) for graph, psi in tree] for tree in views]
    kinds = {name: np.array([_averaged(tree, name) for tree in data]) for name in NORMAL}
    belief = {name: np.stack([_normal(kinds[name][:, :, o], np.array(GENERIC_BELIEF[name])[:, o]) for o in (0, 1)], 1) for name in NORMAL}
    bends = np.array([np.mean([np.array(view.bend) for view in tree], axis=0) for tree in data])
    belief["bend"] = np.stack([_bend(bends[:, :, o], np.array(GENERIC_BELIEF["bend"])[:, o]) for o in (0, 1, 2)], 1)
    return Prior(theta=_theta([view for tree in views for view in tree]), belief=LimbBelief(**belief))


def _read(folder) -> list[TreeSkeleton]:
    folder = Path(folder)
    if not folder.is_dir():
        raise SkeletonError(f"{folder} is no folder.", remedy=f"Give a folder of {', '.join(ENDINGS)} files.")
    return [read_skeleton(path) for path in sorted(folder.iterdir()) if path.suffix.lower() in ENDINGS]


def _seen(tree: TreeSkeleton, azimuth: float) -> tuple[FactorGraph, Float[np.ndarray, " segment"]]:
    """(the tree as a drawing, its true elevations)."""
    tip = tree.tip - tree.tip[0]
    across, deep = np.array([np.cos(azimuth), -np.sin(azimuth)]), np.array([np.sin(azimuth), np.cos(azimuth)])
    xy, z = np.column_stack([tip[:, [0, 2]] @ across, tip[:, 1]]), tip[:, [0, 2]] @ deep
    limbs, limb = np.unique(tree.limb, return_inverse=True)
    n, trunk = len(tree), np.full(len(tree), NULL)
    graph = factor_graph(
        SketchGraph(
            parent=tree.parent, xy=xy, limb=limb, stroke=trunk, tree=tree.tree, width=np.full(n, np.nan), joined=np.zeros(n, bool),
            curve_points=np.zeros((0, 2)), curve_start=np.zeros(n + 1, int), limb_id=limbs, stroke_ids=(),
        )
    )  # fmt: skip
    return graph, np.clip(elevation_of(graph, z / graph.scale), -STEEPEST, STEEPEST)


def _measured(graph: FactorGraph, psi) -> LimbData:
    """What the factors of the model measure at ψ."""
    posterior = log_posterior(graph, Prior())
    padded = np.zeros(len(posterior.page.length), np.float32)
    padded[: len(psi)] = psi
    found = compiled(_data, posterior, padded, name="data")(posterior, padded)
    return jax.tree.map(lambda column: np.asarray(column, float), found)


def _data(posterior, psi):
    return posterior.data(posterior.page.assign(psi))


def _averaged(views: list[LimbData], name: str) -> Float[np.ndarray, "three order"]:
    """Count, mean and sum of squares, the mean over the views."""
    return np.mean([np.array(getattr(view, name)) for view in views], axis=0)


def _normal(data: Float[np.ndarray, "tree three"], generic) -> Float[np.ndarray, " four"]:
    """(m0, κ0, ν0, s0²) that make the trees likeliest."""
    n, mean, square = data[data[:, 0] > 0].T
    centre = np.r_[generic[0], np.log(generic[1:])]

    def loss(x):
        m0, k0, v0, s0 = x[0], *np.exp(x[1:])
        kn, vn = k0 + n, v0 + n
        total = v0 * s0 + square + k0 * n * (mean - m0) ** 2 / kn
        value = 0.5 * np.log(k0 / kn) + gammaln(vn / 2) - gammaln(v0 / 2) + v0 / 2 * np.log(v0 * s0) - vn / 2 * np.log(total)
        return -value.sum() + 0.5 * np.sum(((x - centre) / WIDTH) ** 2)

    x = minimize(loss, centre, method="L-BFGS-B").x
    return np.r_[x[0], np.exp(x[1:])]


def _bend(data: Float[np.ndarray, "tree two"], generic) -> Float[np.ndarray, " two"]:
    """(ν0, s0²) that make the trees likeliest."""
    n, square = data[data[:, 0] > 0].T
    centre = np.log(generic)

    def loss(x):
        v0, s0 = np.exp(x)
        vn = v0 + 2 * n
        value = gammaln(vn / 2) - gammaln(v0 / 2) + v0 / 2 * np.log(v0 * s0) - vn / 2 * np.log(v0 * s0 + square)
        return -value.sum() + 0.5 * np.sum((x - centre) ** 2)

    return np.exp(minimize(loss, centre, method="L-BFGS-B").x)


def _theta(views) -> TreeParameters:
    """Chen's Θ: the median over trees and sides of every parameter; no σ below the floors of `chen.em`."""
    found = []
    for graph, psi in views:
        found.append(list(measured_theta(graph, depth_of(graph, psi), GENERIC).as_dict().values()))
    values = dict(zip(GENERIC.as_dict(), np.median(found, axis=0).tolist(), strict=True))
    return TreeParameters(**values | {f"sigma_{name}": max(values[f"sigma_{name}"], floor) for name, floor in FLOORS.items()})
