"""Which depths and labels does each generation choose, given the one below?

Chen et al. 2008, §5.2.1, bottom-up inference. From the root outwards, v_p and its frame R_p fixed, every child is tried
under every label, searched along its line of sight, and the labels are dealt out at their optimum (labels.py):

    ψ*_cl = argmax_ψ  log P(v_c(ψ), v_p, l | Θ)          v_c(ψ) = ℓ_c (e_c, tan ψ),   ψ ∈ ±80°

    81 elevations, then three searches, each between the two neighbours of the best with a twelfth of the step.

Beyond the paper, off by default: `apical_from_stroke` gives label 1 to the segment that continues the stroke;
`jacobian` counts directions by solid angle (+ log cos ψ), without which steep depths are overrated.
"""

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree.mrf.chen.estep import EStepPart, Reading
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.frames import least_rotation, local_angles, turn_then_tilt
from sketchtree.mrf.chen.labels import Families, Family, LabelParameters, best_labels, families, label_parameters, log_joint
from sketchtree.parameters import TreeParameters

_REFINEMENTS, _FINER = 3, 12
_FORBIDDEN = -1e9  # log probability of a label that is ruled out


class BottomUp(EStepPart):
    """Ancestral search, generation by generation."""

    steepest: float = float(np.radians(80.0))  # radians, below π/2
    grid: int = 81  # elevations tried before refinement, 3 or more
    apical_from_stroke: bool = False
    jacobian: bool = False

    def __call__(self, graph: FactorGraph, theta: TreeParameters, reading: Reading, key: Key[Array, ""]) -> Reading:
        table = families(graph)
        vector, frame = _roots(graph, table)
        label = np.zeros(len(graph), np.int64)
        for generation in table.generations:
            for batch in _same_size(generation):
                self._solve(graph, theta, batch, vector, frame, label)
        depth = np.zeros(len(graph))
        for row in np.flatnonzero(graph.parent >= 0):
            depth[row] = depth[graph.parent[row]] + vector[row, 2]
        return Reading(depth, label)

    def _solve(self, graph, theta, batch: list[Family], vector, frame, label) -> None:
        """Depths, labels and frames of families with the same K; written into the arrays."""
        child = np.stack([family.child for family in batch])  # family, child
        above = np.array([family.above for family in batch])
        first, count = batch[0].first_label, batch[0].label_count
        parameters = LabelParameters(*(column[first - 1 :] for column in label_parameters(theta, count)))
        elevation, score = self._search(graph, theta, parameters, child, vector[above], frame[above])
        if self.apical_from_stroke and first == 1:
            score = _with_given_apical(score, graph.is_apical[child])
        chosen = np.stack([best_labels(table) for table in score])
        psi = np.take_along_axis(elevation, chosen[..., None], axis=2)[..., 0]
        vector[child] = _vectors(graph, child, psi)
        tilt, turn = local_angles(frame[above][:, None], vector[child])
        frame[child] = frame[above][:, None] @ turn_then_tilt(turn, tilt)
        label[child] = chosen + first

    def _search(
        self,
        graph: FactorGraph,
        theta: TreeParameters,
        label: LabelParameters,
        child: Int[np.ndarray, "family child"],
        parent_vector: Float[np.ndarray, "family 3"],
        frame: Float[np.ndarray, "family 3 3"],
    ) -> tuple[Float[np.ndarray, "family child label"], Float[np.ndarray, "family child label"]]:
        """The best elevation of every child under every label, and its log probability."""
        length = np.linalg.norm(parent_vector, axis=-1)[:, None, None, None]

        def log_probability(psi):  # family, child, label (or 1), elevation
            v = _vectors(graph, child[..., None, None], psi)
            tilt, turn = local_angles(frame[:, None, None, None], v)
            scale = np.linalg.norm(v, axis=-1) / length
            columns = LabelParameters(*(column[:, None] for column in label))
            value = log_joint(scale, tilt, turn, columns, theta)
            return value + np.log(np.cos(psi)) if self.jacobian else value

        psi = np.linspace(-self.steepest, self.steepest, self.grid)[None, None, None]
        step = 2 * self.steepest / (self.grid - 1)
        psi, value = _best(psi, log_probability(psi))
        for _ in range(_REFINEMENTS):
            around = psi[..., None] + step * np.linspace(-1, 1, 2 * _FINER + 1)
            around = np.clip(around, -self.steepest, self.steepest)
            psi, value = _best(around, log_probability(around))
            step /= _FINER
        return psi, value


def _best(psi, value):
    at = np.argmax(value, axis=-1)[..., None]
    psi = np.broadcast_to(psi, value.shape)
    return np.take_along_axis(psi, at, -1)[..., 0], np.take_along_axis(value, at, -1)[..., 0]


def _vectors(graph, rows, psi):
    """v(ψ) = ℓ (e, tan ψ) of these rows."""
    flat = graph.length[rows][..., None] * graph.direction[rows]
    deep = (graph.length[rows] * np.tan(psi))[..., None]
    return np.concatenate([np.broadcast_to(flat, (*deep.shape[:-1], 2)), deep], axis=-1)


def _roots(graph: FactorGraph, table: Families):
    """Vectors and frames with every stem's first segment in the page."""
    vector, frame = np.zeros((len(graph), 3)), np.broadcast_to(np.eye(3), (len(graph), 3, 3)).copy()
    start = np.flatnonzero((table.above < 0) & ~graph.is_base)
    vector[start, :2] = graph.length[start, None] * graph.direction[start]
    frame[start] = least_rotation(np.c_[graph.direction[start], np.zeros(len(start))])
    return vector, frame


def _same_size(generation):
    """The families of one generation, those with the same labels together."""
    batches: dict[tuple[int, int], list[Family]] = {}
    for family in generation:
        batches.setdefault((family.first_label, family.label_count), []).append(family)
    return [batches[size] for size in sorted(batches)]


def _with_given_apical(score, is_apical):
    """Scores under which the child that continues its stroke, where there is one, takes label 1."""
    given = is_apical.any(axis=1)[:, None]
    wrong = np.zeros(score.shape, bool)
    wrong[..., 0] = given & ~is_apical
    return np.where(wrong, _FORBIDDEN, score)
