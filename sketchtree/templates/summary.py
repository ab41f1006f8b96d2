"""What does the database know of an exemplar, in words and rounded figures?"""

from math import isfinite

from sketchtree.templates.exemplar import Exemplar
from sketchtree.templates.theta_errors import estimate_by_order_with_errors, standard_errors


def summary(exemplar: Exemplar) -> dict[str, str]:
    """Facts in the order in which `sketchtree templates show` prints them. Angles in degrees."""
    tree, habit, limbs = exemplar.skeleton, exemplar.habit, exemplar.limbs
    facts = {
        "name": exemplar.name,
        "title": exemplar.title,
        "species": exemplar.species or "not said",
        "growth habit": exemplar.growth_habit or "not said",
        "height": f"{tree.height:.1f} m",
        "stems": str(int(tree.is_base.sum())),
        "segments": f"{tree.segment_count} in {len(set(tree.limb.tolist()))} limbs, orders 0 to {int(tree.order.max())}",
        "Θ": _parameters(exemplar.theta),
        "Θ, s.e. of means": _errors(standard_errors(tree)),
    }
    for order, (theta, error) in enumerate(zip(exemplar.theta_order, _order_errors(tree), strict=True)):
        facts[f"Θ, order {order}{'+' if order == 2 else ''}"] = _parameters(theta)
        facts[f"Θ, order {order}{'+' if order == 2 else ''}, s.e."] = _errors(error)
    for i, order in enumerate(("1", "2+")):
        if limbs.length_count[i]:
            facts[f"log length ratio, order {order}"] = (
                f"{limbs.length_mean[i]:.2f} ± {limbs.length_variance[i] ** 0.5:.2f} ({limbs.length_count[i]} limbs)"
            )
    facts["habit"] = (
        f"{habit.arrangement} laterals, {habit.whorl} a node, pipe exponent {habit.pipe_exponent:g}, orders up to {habit.max_order}"
    )
    facts["leaf"] = f"{habit.leaf}, {habit.leaf_arrangement}, {100 * habit.leaf_size:.1f} cm every {100 * habit.leaf_spacing:.1f} cm"
    facts["bark"] = habit.bark
    made = f"seed {exemplar.seed}, grown" if exemplar.recipe else "imported"
    facts["source"] = f"{exemplar.source}; {made} by SketchTree {exemplar.version}"
    return facts


def _parameters(theta) -> str:
    value = theta.as_dict(degrees=True)
    scale = f"s {value['mu_s']:.2f} ± {value['sigma_s']:.2f}"
    angles = [f"{sign} {round(value[f'mu_{k}'])}° ± {round(value[f'sigma_{k}'])}°" for k, sign in _SIGNS.items()]
    return ", ".join([scale, *angles])


def _order_errors(tree):
    return [error for _, error in estimate_by_order_with_errors(tree)]


def _errors(theta) -> str:
    """Standard errors of the four means; `?` where too few pairs tell."""
    value = theta.as_dict(degrees=True)
    angles = [f"{sign} {_known(value[f'mu_{k}'], '.1f')}°" for k, sign in _SIGNS.items()]
    return ", ".join([f"s {_known(value['mu_s'], '.3f')}", *angles])


def _known(value: float, form: str) -> str:
    return format(value, form) if isfinite(value) else "?"


_SIGNS = {"alpha": "α", "beta": "β", "gamma": "γ"}
