"""How does a branch bend as it grows?

Single-image growth, §II.3, Eq. 6-8: a branch is a string of units, each an affine transformation U_i that turns and moves on by
the unit's length. The one of the tip's unit is the product of all from where the branch is attached,

    T = Π U_i                          U_i = [η  υ  ζ  l; 0 0 0 1],  ζ = η × υ                (6)
    γ = T⁻¹((T ζ) × g)                 the axis, in the unit's own frame                      (7)
    R(γ, δ) = a 1 + b [γ]× + c γ γᵀ    a = cos δ, b = sin δ, c = 1 − cos δ                    (8)

    η   normal of the unit;  υ  bending direction;  ζ  the way it points;  l  its length
    g   the direction of gravity;  δ  strength

Signs, and what is crossed with g, are lost in print: we turn the way a unit points towards −g for δ > 0 (branches rise) and
towards g for δ < 0 (they hang), as in Figure 8 from left to right. T R turns the unit about the world's axis (T ζ) × g, whatever
frame it is written in, so the world's is used here; all that the unit bears turns with it.

δ is the turn, degrees, on the way from the ground to a tip, for the tip in the middle of all (half give way more); unit i takes of it

    δ_i(t) = δ · κ_i / K · s_i · L_i(t) / L_i(1)         κ_i = ℓ_i (1 − r_i / r_0) / r_i^¼

    K     the median, over all tips, of the sum of κ from the ground;  r_0  radius at the ground: the trunk hardly bends, thin wood most
    L     metres of wood at or beyond the unit at time t: a unit bends as it comes to bear, so nothing ever jumps
    s_i   min(1, sin of the angle to the vertical / sin 20°); δ_i / s_i is at most sin 20° radians, so no unit turns past the vertical

Roots below the ground stay.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.growth.layers import Layers
from sketchtree.growth.straight import radius_at_start
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import generations, is_tip, sum_from_root

LEAST, MOST = -60.0, 60.0  # degrees
_STEEP = float(np.sin(np.radians(20.0)))
_VERTICAL = 1e-12  # metres (and m²): a unit that leaves the vertical by less has no side to turn to


def yielding(tree: TreeSkeleton) -> Float[np.ndarray, " segment"]:
    """κ_i / K of every row of a tree without curve points: which share of δ it takes."""
    thick = 0.5 * (radius_at_start(tree) + tree.radius)
    ground = np.array(tree.radius)
    for rows in generations(tree.parent)[1:]:
        ground[rows] = ground[tree.parent[rows]]
    share = tree.length * np.clip(1.0 - thick / ground, 0.0, 1.0) / thick**0.25
    share[tree.kind == int(Kind.ROOT)] = 0.0
    ways = sum_from_root(tree.parent, share)[is_tip(tree.parent)]
    middle = float(np.median(ways[ways > 0])) if (ways > 0).any() else 1.0
    return share / middle


def bent(
    layers: Layers,
    base: Float[np.ndarray, "base 3"],
    vector: Float[np.ndarray, "segment 3"],
    grown: Float[np.ndarray, "segment time"],
    turn: Float[np.ndarray, "segment time"],
) -> Float[np.ndarray, "3 segment time"]:
    """The tips of all units, each grown to its share and turned by `turn` radians (up where positive) with all it bears.

    Rows stand at their places, bases first. A unit that has not grown lies at the tip of what it will grow from."""
    tip = np.empty((3, *grown.shape), grown.dtype)
    carried = np.zeros((4, *grown.shape), grown.dtype)  # unit quaternions w, x, y, z
    tip[:, : layers.ground] = base.T[:, :, None]
    carried[0, : layers.ground] = 1.0
    for layer in layers.downwards():
        above = layers.parent[layer]
        before = carried[:, above]
        way, after = _turned(_rotated(before, vector[layer].T[:, :, None]), before, turn[layer])
        tip[:, layer] = tip[:, above] + grown[layer] * way
        carried[:, layer] = after
    return tip


def _turned(way, carried, turn):
    """(where a unit that points along `way` points once it has turned, the rotation it carries then)."""
    x, y, z = way
    level = x * x + z * z
    flat = np.sqrt(level)
    one_over = 1.0 / np.maximum(flat, _VERTICAL)
    half = np.minimum(flat / np.sqrt(np.maximum(level + y * y, _VERTICAL)), _STEEP)
    half *= np.clip(turn, -_STEEP, _STEEP) * way.dtype.type(0.5 / _STEEP)
    w, sine = np.cos(half), np.sin(half)
    cosine_whole, sine_whole = 1.0 - 2.0 * sine * sine, 2.0 * sine * w
    onwards = np.where(flat > _VERTICAL, cosine_whole - y * sine_whole * one_over, 1.0)
    turned = np.stack([x * onwards, y * cosine_whole + flat * sine_whole, z * onwards])
    sine *= one_over
    axis_x, axis_z = -z * sine, x * sine
    qw, qx, qy, qz = carried
    return turned, np.stack([
        w * qw - axis_x * qx - axis_z * qz,
        w * qx + axis_x * qw - axis_z * qy,
        w * qy + axis_z * qx - axis_x * qz,
        w * qz + axis_x * qy + axis_z * qw,
    ])  # fmt: skip


def _rotated(quaternion, vector):
    """The vectors turned by unit quaternions: v + 2 w (q × v) + 2 q × (q × v)."""
    w, qx, qy, qz = quaternion
    x, y, z = vector
    cx, cy, cz = 2 * (qy * z - qz * y), 2 * (qz * x - qx * z), 2 * (qx * y - qy * x)
    return np.stack([x + w * cx + qy * cz - qz * cy, y + w * cy + qz * cx - qx * cz, z + w * cz + qx * cy - qy * cx])
