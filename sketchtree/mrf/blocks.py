"""The factor graph as one can print it: kinds of factor, each a block, and the variables that every factor touches.

    variables     depth z_i of every segment (through ψ_i), and Θ, which all factors of a kind share
    labels        apical or lateral: read off the strokes; unknown only where the reader joined two (`is_joined`)
    factors       one block a kind: which rows each factor looks at first. A factor may look further, at whatever depends on
                  them (a tip's z is the sum of all dz on the way to it); the blocks tell what it is about
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Int

from sketchtree.axes import NULL
from sketchtree.mrf.factor_graph import FactorGraph

EQUATION = {
    "solid_angle": "log cos ψ",
    "lateral": "−½((a − μ_o)/σ_o)² − log σ_o − log(sin a + .02)",
    "apical": "−½(a/τ_o)² − 2 log τ_o",
    "stem": "−½(ψ/.08)²",
    "limb_length": "−½((r − a_o − b(u − ½))/ς_o)² − log ς_o",
    "segment_length": "−½((log L − m_o)/s_o)² − log s_o",
    "siblings": "−κ c_d w·w'",
    "competition": "−w_d exp(−λ|p − p'|/R_c)",
    "extent": "−½(r/.2)² − ½(mean z/rms x/.35)²",
    "crown": "−log(1 + ((log ρ − m)/s)²)",
}


@dataclass(frozen=True, eq=False)
class Block:
    """All factors of one kind."""

    kind: str
    equation: str
    rows: Int[np.ndarray, "factor arity"]  # the segments that each looks at; NULL where it looks at fewer
    theta: tuple[str, ...]  # parts of Θ they share

    def __len__(self) -> int:
        return len(self.rows)


def blocks(graph: FactorGraph) -> dict[str, Block]:
    """kind → block, in the order of the log posterior. Kinds without any factor are left out."""
    segment = np.flatnonzero(~graph.is_base)
    lateral = np.flatnonzero(graph.is_lateral)
    apical = np.flatnonzero(graph.is_apical)
    limb = np.flatnonzero(graph.limb_parent != NULL)
    spreads = np.flatnonzero(graph.limb_spreads)
    rows = {
        "solid_angle": segment[:, None],
        "lateral": np.stack([lateral, graph.parent[lateral]], 1),
        "apical": np.stack([apical, graph.parent[apical]], 1),
        "stem": graph.limb_first[graph.limb_parent == NULL][:, None],
        "limb_length": _ragged([np.flatnonzero((graph.limb == j) & ~graph.is_base) for j in limb]),
        "segment_length": segment[graph.order[segment] > 0][:, None],
        "siblings": graph.limb_first[graph.sibling],
        "competition": graph.competitor,
        "extent": _ragged([graph.limb_tip[spreads[graph.tree[graph.limb_tip[spreads]] == t]] for t in np.unique(graph.tree)]),
        "crown": graph.limb_tip[spreads][:, None],
    }
    theta = {"lateral": ("divergence",), "apical": ("bend",), "limb_length": ("length",), "segment_length": ("segment",)}
    return {kind: Block(kind, EQUATION[kind], table, theta.get(kind, ())) for kind, table in rows.items() if len(table)}


def table(graph: FactorGraph) -> str:
    """The blocks as text, one a line."""
    lines = [str(graph), f"  {'kind':15s}{'factors':>8s}{'looks at':>10s}  Θ             log potential"]
    for block in blocks(graph).values():
        arity = int(np.sum(block.rows != NULL, axis=1).max())
        lines.append(f"  {block.kind:15s}{len(block):8d}{arity:10d}  {', '.join(block.theta):12s}  {block.equation}")
    return "\n".join(lines)


def _ragged(groups) -> Int[np.ndarray, "factor arity"]:
    groups = [group for group in groups if len(group)]
    out = np.full((len(groups), max(map(len, groups), default=1)), NULL)
    for k, group in enumerate(groups):
        out[k, : len(group)] = group
    return out
