"""What is believed about the tree before its depths are known.

Two views of the same belief: Chen's Θ (§4), which the method `chen` uses, and the limb statistics of
an exemplar, which the default method turns into a conjugate prior (`conjugate.limb_prior`).
"""

from dataclasses import dataclass

from sketchtree.parameters import GENERIC, LimbStatistics, TreeParameters


@dataclass(frozen=True, eq=False)
class Prior:
    """Θ of the matched exemplar, and its limbs' statistics (None: a tree of no particular kind)."""

    theta: TreeParameters = GENERIC
    limbs: LimbStatistics | None = None
