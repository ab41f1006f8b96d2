"""What does the database know of an exemplar, in words and rounded figures?"""

from sketchtree.templates.exemplar import Exemplar


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
    }
    for order, theta in enumerate(exemplar.theta_order):
        facts[f"Θ, order {order}{'+' if order == 2 else ''}"] = _parameters(theta)
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


_SIGNS = {"alpha": "α", "beta": "β", "gamma": "γ"}
