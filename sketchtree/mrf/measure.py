"""Chen's Θ, measured on a tree whose depths are known.

Chen et al. 2008, §4: a child segment is v_c = s R_p R_y(ϕ) R_x(φ) ŷ |v_p|, with frames R_c = R_p R_y(ϕ) R_x(φ) and
the root's the least rotation of ŷ to the trunk. In the parent's frame the child's direction is

    (sin φ sin ϕ, cos φ, sin φ cos ϕ),   so   φ = acos y,   ϕ = atan2(x, z)

    s   scale |v_c| / |v_p|   (μ_s, σ_s)          α   φ of an apical child    (μ_α, σ_α)
    β   φ of a lateral child  (μ_β, σ_β)          γ   ϕ of an apical child    (μ_γ, σ_γ), circular
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.frames import least_rotation, local_angles, turn_then_tilt
from sketchtree.parameters import GENERIC, TreeParameters
from sketchtree.traverse import generations

FEWEST = 2  # observations below which a parameter keeps its value from before


def measured_theta(
    graph: FactorGraph, depth: Float[np.ndarray, " segment"], before: TreeParameters = GENERIC
) -> TreeParameters:
    """Θ of the drawn tree at these depths (H = 1). A parameter with fewer than two observations is `before`'s."""
    vector = np.column_stack([graph.xy, depth])
    vector = np.where(graph.is_base[:, None], 0.0, vector - vector[np.maximum(graph.parent, 0)])
    scale, divergence, orientation, rows = rotations(graph.parent, graph.is_base, vector)
    apical = graph.is_apical[rows]
    values = before.as_dict()
    for name, sample in (("s", scale), ("alpha", divergence[apical]), ("beta", divergence[~apical])):
        if len(sample) >= FEWEST:
            values[f"mu_{name}"], values[f"sigma_{name}"] = float(np.mean(sample)), float(np.std(sample))
    gamma = orientation[apical & (divergence > 1e-3)]
    if len(gamma) >= FEWEST:
        mean = np.mean(np.exp(1j * gamma))
        values["mu_gamma"] = float(np.angle(mean))
        values["sigma_gamma"] = float(np.sqrt(-2 * np.log(np.clip(abs(mean), 1e-3, 1.0))))
    return TreeParameters(**values)


def rotations(
    parent: Int[np.ndarray, " segment"], is_base: Bool[np.ndarray, " segment"], vector: Float[np.ndarray, "segment 3"]
) -> tuple[
    Float[np.ndarray, " pair"], Float[np.ndarray, " pair"], Float[np.ndarray, " pair"], Int[np.ndarray, " pair"]
]:
    """(s, φ, ϕ, child row) of every segment whose parent is a segment. A straight child has ϕ = 0."""
    length = np.maximum(np.linalg.norm(vector, axis=1), 1e-12)
    unit = np.where(is_base[:, None], [0.0, 1.0, 0.0], vector / length[:, None])
    frame = np.broadcast_to(np.eye(3), (len(parent), 3, 3)).copy()
    phi, turn = np.zeros(len(parent)), np.zeros(len(parent))
    for rows in generations(parent)[1:]:
        above = parent[rows]
        phi[rows], turn[rows] = local_angles(frame[above], unit[rows])
        root = is_base[above]
        frame[rows[root]] = least_rotation(unit[rows[root]])
        child = rows[~root]
        frame[child] = frame[parent[child]] @ turn_then_tilt(turn[child], phi[child])
    rows = np.flatnonzero((parent != NULL) & ~is_base[np.maximum(parent, 0)])
    return length[rows] / length[parent[rows]], phi[rows], turn[rows], rows
