"""Small meshes and skeletons for the tests of the export room."""

import dataclasses

import numpy as np

from sketchtree.asset import Animation, Armature, Asset, Capsules, Keys, Level, Morph
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.skeleton import TreeSkeleton


def checks(rows: int = 8, channels: int = 3):
    """A checkerboard; with a fourth channel, alpha follows it."""
    board = (np.indices((rows, rows)).sum(axis=0) % 2 * 255).astype(np.uint8)
    return np.repeat(board[..., None], channels, axis=2)


def square(name: str = "wood", **material) -> Mesh:
    """Two triangles in the plane z = 0, facing the viewer, the image upright on them."""
    return Mesh(
        name,
        np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0.0)]),
        np.broadcast_to([0.0, 0.0, 1.0], (4, 3)),
        np.array([(0, 1), (1, 1), (1, 0), (0, 0.0)]),
        np.array([(0, 1, 2), (0, 2, 3)]),
        Material(f"{name}_checks", **material),
    )


def textured(name: str = "wood") -> Mesh:
    """The square with every kind of texture."""
    flat = np.broadcast_to(np.array([128, 128, 255], np.uint8), (8, 8, 3))
    return square(name, base_color_texture=checks(), normal_texture=flat, roughness_texture=checks()[..., 0])


def leafy() -> Mesh:
    """The square as a leaf: cut out by alpha, seen from both sides, tinted."""
    leaf = square("leaf", base_color_texture=checks(channels=4), alpha_cutoff=0.5, double_sided=True)
    return dataclasses.replace(leaf, color=np.tile([0.5, 1.0, 0.25, 1.0], (4, 1)))


def curved() -> TreeSkeleton:
    """A stem whose second segment has two drawn points, and a fork of two."""
    return TreeSkeleton.from_columns(
        np.array([-1, 0, 1, 2, 2]),
        np.array([(0, 0, 0), (0, 1, 0), (0.1, 2, 0.3), (0.5, 3, 0), (-0.5, 3, 1 / 3)]),
        np.array([0.3, 0.2, 0.1, 0.05, 0.04]),
        order=np.array([0, 0, 0, 0, 1]),
        limb=np.array([2**62 + 1, 2**62 + 1, 2**62 + 1, 2**62 + 1, 77]),
        stroke=np.array([0, 0, 0, 0, -1]),
        kind=np.array([0, 0, 0, 0, 1]),
        depth_sd=np.array([0, 0.1, np.nan, 0.2, np.nan]),
        curve_points=np.array([(0, 1.25, 0), (0, 1.5, 0)]),
        curve_start=np.array([0, 0, 0, 2, 2, 2]),
    )


def scattered(count: int = 5) -> Instances:
    """A leaf at several places, each turned, sized and tinted by chance."""
    rng = np.random.default_rng(0)
    turn = rng.normal(size=(count, 4))
    turn /= np.linalg.norm(turn, axis=1, keepdims=True)
    color = np.column_stack([rng.uniform(0.3, 1.0, (count, 3)), np.ones(count)])
    leaf = dataclasses.replace(leafy(), color=None)
    return Instances(leaf, rng.normal(size=(count, 3)), turn, np.full((count, 3), 0.2), color)


def bones() -> Armature:
    """A trunk, and a limb that leaves it sideways."""
    half = np.sqrt(0.5)
    place, turn = np.array([(0, 0, 0), (0, 0.5, 0.0)]), np.array([(0, 0, 0, 1), (0, 0, -half, half)])
    return Armature(("trunk", "limb"), np.array([-1, 0]), place, turn, np.array([0.5, 0.4]))


def bending() -> Mesh:
    """The textured square, bent by two bones, with every further column a game asks for."""
    wood = textured()
    columns = {
        "JOINTS_0": np.array([(0, 0, 0, 0), (0, 1, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0)]),
        "WEIGHTS_0": np.array([(1, 0, 0, 0), (0.3, 0.7, 0, 0), (0.9, 0.1, 0, 0), (1 / 3, 2 / 3, 0, 0)]),
        "TEXCOORD_1": wood.uv * 0.5,
        "COLOR_1": np.tile([0.0, 0.5, 1.0, 0.25], (4, 1)),
        "_PIVOT": wood.position * 2.0,
    }
    return dataclasses.replace(wood, extra=columns)


def bars() -> Capsules:
    """One bar upright on the first bone, one beside it on none."""
    return Capsules(np.array([(0, 0, 0), (1, 0, 0.0)]), np.array([(0, 1, 0), (1, 0, 0.0)]), np.array([0.1, 0.2]), np.array([0, -1]))


def detailed() -> Asset:
    """Three levels of detail, the coarsest of one card."""
    levels = (Level((textured(), scattered()), 0.5), Level((square("wood"), leafy()), 0.1), Level((square("leaf_card"),)))
    return Asset(levels, curved(), about={"seed": 3})


def no_keys(width: int) -> Keys:
    """Of nothing."""
    return Keys(np.zeros(0, np.int64), np.zeros(1, np.int64), np.zeros(0), np.zeros((0, width)))


def keys(joint: int, time, *values) -> Keys:
    """One track."""
    return Keys(np.array([joint]), np.array([0, len(time)]), np.array(time, float), np.array(values, float))


def moving(**changed) -> Animation:
    """The limb's foot rises by one metre in a second and stays; it turns upright in two; the trunk grows from a half."""
    rest = bones().rotation[1]
    whole = {
        "translation": keys(1, [0.0, 1.0], (0, 0.5, 0), (0, 1.5, 0)),
        "rotation": keys(1, [0.0, 2.0], rest, (0, 0, 0, 1)),
        "scale": keys(0, [0.0, 2.0], (0.5, 0.5, 0.5), (1, 1, 1)),
    }
    return Animation("growth", 2.0, **(whole | changed))


def moved() -> Asset:
    """The bent square, and a leaf on the limb that unfolds from its foot."""
    leaf = dataclasses.replace(leafy(), extra={"JOINTS_0": np.tile([1, 0, 0, 0], (4, 1)), "WEIGHTS_0": np.tile([1.0, 0, 0, 0], (4, 1))})
    morph = Morph(1, np.zeros(3) - leaf.position, np.array([0.0, 0.5, 1.5]), np.array([1.0, 1.0, 0.0]))
    return Asset.of([bending(), leaf], armature=bones(), animation=moving(morphs=(morph,)))
