"""How far may a tree grow whose crown nobody drew? The drawn limbs say how large it is, the template of what shape.

    drawing     the convex hull of the drawn limbs on the page, widened by `_MARGIN`
    template    half-width of the exemplar's crown over its height, `crown_profile`, made as large as the hull

At every height each side of the crown is

    w = (1 − b) w_drawing + b w_template,      b = `TEMPLATES_SHARE`,      and at least .72 w_drawing

so the same strokes grow to a cone under a spruce, to a column under a poplar and to a flat top under an umbrella pine (Chen et al.
2008, Figure 9: the template decides what the sketch leaves open). Only what grows from within is held; what was drawn
stays, and grows freely where it stands out.
"""

import numpy as np
from jaxtyping import Float
from scipy.spatial import ConvexHull

from sketchtree.parameters import Habit
from sketchtree.propagate.drawn.ends import first_drawn_lateral
from sketchtree.propagate.space.envelope import Envelope, Lobe
from sketchtree.propagate.blocks.open_branch import limb_arcs
from sketchtree.skeleton import TreeSkeleton

TEMPLATES_SHARE = 0.5
NARROWEST = 0.72  # of the drawing's own width, at every height
WEEPING = 30.0  # degrees a metre: with more, twigs hang to the ground
LEVELS = 24
_MARGIN = 0.13  # of the smaller side of the drawing's branches
_MARGIN_TWIGS = 2.0  # twig lengths, at least
_OUTERMOST = 0.95  # quantile of the distance from the axis that counts as the crown's surface


def implied_crown(tree: TreeSkeleton, habit: Habit, exemplar: TreeSkeleton | None = None) -> Envelope | None:
    """The crown of a tree without a drawn one.

    What grows from within keeps to it; it does not bind what was drawn outside it in depth. A weeping habit's reaches down to the
    ground. None for a tree with fewer than three drawn limbs, and for palms, whose fronds have their length from the exemplar.
    """
    limbs = tree.order > 0
    if habit.max_order < 2 or np.sum(limbs) < 3:
        return None
    arc, _ = limb_arcs(tree)
    on_trunk = (tree.order == 0) & ~tree.is_base & (arc >= first_drawn_lateral(tree, arc))
    points = np.concatenate([tree.tip[limbs | on_trunk][:, :2], tree.start[limbs][:, :2]])
    if np.ptp(points[:, 0]) <= 0 or np.ptp(points[:, 1]) <= 0:
        return None
    width = max(_MARGIN * np.ptp(points, axis=0).min(), _MARGIN_TWIGS * habit.twig_length)
    turn = np.linspace(0.0, 2 * np.pi, 16, endpoint=False)
    ring = width * np.column_stack([np.cos(turn), np.sin(turn)])
    cloud = (points[:, None, :] + ring[None]).reshape(-1, 2)
    weeps = habit.gravitropism > WEEPING
    if weeps:
        cloud = np.concatenate([cloud, np.column_stack([cloud[:, 0], np.full(len(cloud), tree.tip[tree.is_base, 1].min())])])
    outline = cloud[ConvexHull(cloud).vertices]
    profile = None if exemplar is None or weeps else crown_profile(exemplar)
    if profile is not None:
        outline = shaped(outline, profile)
    return Envelope((Lobe.from_outline(outline),), binding=False)


def shaped(outline: Float[np.ndarray, "point 2"], profile: Float[np.ndarray, " level"]) -> Float[np.ndarray, "corner 2"]:
    """The outline with each side drawn halfway to the profile, made as wide as that side is on average. `outline` is convex."""
    lobe = Lobe.from_outline(outline)
    low, high = lobe.height[0], lobe.height[-1]
    y = low + (high - low) * (np.arange(len(profile)) + 0.5) / len(profile)
    axis = lobe.axis_at(y)[:, 0]
    left, right = (np.abs(edge - axis) for edge in lobe.edges_at(y))
    sides = []
    for own in (left, right):
        like = profile * own.mean() / max(profile.mean(), 1e-9)
        sides.append(np.maximum((1 - TEMPLATES_SHARE) * own + TEMPLATES_SHARE * like, NARROWEST * own))
    ends = np.array([[axis[0], low], [axis[-1], high]])
    rim = [np.column_stack([axis + sides[1], y]), ends[1:], np.column_stack([axis - sides[0], y])[::-1], ends[:1]]
    return np.concatenate(rim)


def crown_profile(exemplar: TreeSkeleton) -> Float[np.ndarray, " level"] | None:
    """Half-width of a tree's crown at `LEVELS` heights from its lowest limb to its top, over the greatest; None without limbs."""
    limbs = exemplar.order > 0
    if np.sum(limbs) < 3:
        return None
    share = np.linspace(0.25, 1.0, 4)[:, None, None]
    points = (exemplar.start[limbs] + share * (exemplar.tip - exemplar.start)[limbs]).reshape(-1, 3)
    axis = np.median(points[:, [0, 2]], axis=0) if np.sum(exemplar.is_base) > 1 else exemplar.tip[exemplar.is_base][0, [0, 2]]
    away, y = np.linalg.norm(points[:, [0, 2]] - axis, axis=1), points[:, 1]
    low, high = np.quantile(y, 0.005), y.max()
    if high <= low:
        return None
    level = np.clip(((y - low) / (high - low) * LEVELS).astype(int), 0, LEVELS - 1)
    width = np.array([np.quantile(away[level == k], _OUTERMOST) if np.any(level == k) else np.nan for k in range(LEVELS)])
    known = np.isfinite(width)
    width = np.interp(np.arange(LEVELS), np.flatnonzero(known), width[known])
    width = np.convolve(np.pad(width, 1, mode="edge"), [0.25, 0.5, 0.25], mode="valid")
    return width / max(width.max(), 1e-9)
