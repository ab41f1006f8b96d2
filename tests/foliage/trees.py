"""Small trees for the tests of this room."""

import numpy as np

from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton

HABIT = Habit(leaf="oak", leaf_arrangement="alternate", leaf_size=0.09, leaf_spacing=0.04, twig_radius=0.003, twig_length=0.3)


def chain(start, direction, length, count, radii):
    """Tips and radii of a straight limb, `count` segments long."""
    t = np.arange(1, count + 1) / count
    tips = np.asarray(start) + t[:, None] * length * np.asarray(direction, float)
    return tips, np.interp(t, [0, 1], radii)


def small_tree(twigs=4, twig_length=0.6):
    """A 3 m trunk 8 cm thick, and `twigs` level twigs on it; limb ids 1, 11, 12, …"""
    tips, radii = chain((0, 0, 0), (0, 1, 0), 3.0, 6, (0.08, 0.04))
    parent, limb, order = [-1, 0, 1, 2, 3, 4, 5], [1] * 7, [0] * 7
    tips, radii = np.vstack([[[0, 0, 0]], tips]), np.r_[0.08, radii]
    for k in range(twigs):
        turn = 2.4 * k
        foot = 3 + k % 3
        own, thick = chain(tips[foot], (np.cos(turn), 0.3, np.sin(turn)), twig_length, 3, (0.012, 0.003))
        parent += [foot, len(tips), len(tips) + 1]
        tips, radii = np.vstack([tips, own]), np.r_[radii, thick]
        limb, order = limb + [11 + k] * 3, order + [1] * 3
    return TreeSkeleton.from_columns(np.array(parent), tips, radii, limb=np.array(limb), order=np.array(order))


def single_twig(direction=(1, 0, 0), length=0.5, count=5):
    """A short thick stump with one straight twig from its top; the twig's limb id is 11."""
    tips, radii = chain((0, 0.5, 0), direction, length, count, (0.012, 0.003))
    parent = np.r_[-1, 0, 1 + np.arange(count)]
    limb, order = np.r_[1, 1, np.full(count, 11)], np.r_[0, 0, np.ones(count, int)]
    tips = np.vstack([[[0, 0, 0], [0, 0.5, 0]], tips])
    return TreeSkeleton.from_columns(parent, tips, np.r_[0.05, 0.05, radii], limb=limb, order=order, kind=np.zeros(len(limb), int))


def crown(limbs=350, reach=2.5):
    """A closed round crown: a 3 m stem and straight limbs from its top to all sides, `reach` metres long; ids 11, 12, …"""
    k = np.arange(limbs)
    level, turn = 1 - 2 * (k + 0.5) / limbs, 2.39996 * k
    flat = np.sqrt(1 - level**2)
    direction = np.stack([flat * np.cos(turn), level, flat * np.sin(turn)], axis=1)
    t = np.arange(1, 5) / 4
    tips = np.array([0, 3.0, 0]) + reach * t[None, :, None] * direction[:, None]
    parent = np.where(t[None] == 0.25, 1, 1 + 4 * k[:, None] + np.arange(4)[None])
    radius = np.tile(np.interp(t, [0, 1], [0.012, 0.003]), limbs)
    return TreeSkeleton.from_columns(
        np.r_[-1, 0, parent.ravel()],
        np.vstack([[[0, 0, 0], [0, 3, 0]], tips.reshape(-1, 3)]),
        np.r_[0.1, 0.1, radius],
        limb=np.r_[1, 1, np.repeat(11 + k, 4)],
        order=np.r_[0, 0, np.ones(4 * limbs, int)],
    )
