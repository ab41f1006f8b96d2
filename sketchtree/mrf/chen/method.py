"""The paper's method as it stands: `chen`, and `chen-fixed` which insists on the template's Θ.

Chen et al. 2008, §5: bottom-up search, interpenetrating branches moved apart along z, ICM with the competition field,
and, unless Θ is fixed, EM over Θ. Measured against trees of known depth it is less right than `okabe` and than
`elevation`; it is here for comparison, and because a prior or a part of it can be exchanged:

    EM(e_step=(BottomUp(apical_from_stroke=True, jacobian=True), MoveApart(), ICM(tol=0.001)))
"""

from sketchtree.mrf.chen.move_apart import MoveApart
from sketchtree.mrf.chen.bottom_up import BottomUp
from sketchtree.mrf.chen.em import EM
from sketchtree.mrf.chen.icm import ICM


def Chen(theta_mode: str = "fit") -> EM:  # noqa: N802 — stands where a solver's class stands
    """The solver: `theta_mode` "fit" learns Θ, "fixed" keeps the prior's."""
    return EM(e_step=(BottomUp(), MoveApart(), ICM(tol=0.01)), learn=theta_mode == "fit")
