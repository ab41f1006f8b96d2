"""A USD file of a growing tree moves as `Growing.at` says: Pixar's own skinning makes of it the same points, and so does reading it back."""

import numpy as np
import pytest
from growing_models import growing

from sketchtree.animation.posing import posed
from sketchtree.export.write import write_asset

pxr = pytest.importorskip("pxr", reason="usd-core is not installed")

from pxr import Usd, UsdGeom, UsdSkel  # noqa: E402

from sketchtree.export.usd.read import read_usd  # noqa: E402

SECONDS = 5.0


@pytest.fixture(scope="module", params=[("full", -20.0), ("age", 0.0), ("scale", 0.0)], ids=["full, hanging", "age", "scale"])
def grown(request, tmp_path_factory):
    """What grows, and the path of its file."""
    path = tmp_path_factory.mktemp("usd") / "tree.usdc"
    tree = growing(*request.param)
    write_asset(path, tree.asset(seconds=SECONDS))
    return tree, path


def skinned(stage, code):
    """The points of every mesh, as UsdSkel bends them."""
    root = UsdSkel.Root(stage.GetDefaultPrim())
    cache = UsdSkel.Cache()
    cache.Populate(root, Usd.PrimDefaultPredicate)
    (binding,) = cache.ComputeSkelBindings(root, Usd.PrimDefaultPredicate)
    query = cache.GetSkelQuery(binding.GetSkeleton())
    transforms = query.ComputeSkinningTransforms(code)
    found = {}
    for target in binding.GetSkinningTargets():
        points = UsdGeom.Mesh(target.GetPrim()).GetPointsAttr().Get()
        if target.HasBlendShapes():
            shapes = UsdSkel.BlendShapeQuery(UsdSkel.BindingAPI(target.GetPrim()))
            weight = dict(zip(query.GetAnimQuery().GetBlendShapeOrder(), query.GetAnimQuery().ComputeBlendShapeWeights(code), strict=True))
            weights, where, which = shapes.ComputeSubShapeWeights([weight[name] for name in target.GetBlendShapeOrder()])
            assert shapes.ComputeDeformedPoints(weights, where, which, shapes.ComputeBlendShapePointIndices(), shapes.ComputeSubShapePointOffsets(), points)
        assert target.ComputeSkinnedPoints(transforms, points, code)
        found[target.GetPrim().GetName()] = np.array(points, float)
    return found


@pytest.mark.parametrize("time", [0.0, 0.13, 0.4, 0.77, 1.0])
def test_pixar_s_skinning_makes_the_same_points(grown, time):
    tree, path = grown
    stage = Usd.Stage.Open(str(path))
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode(), stage.GetTimeCodesPerSecond()) == (0.0, 120.0, 24.0)
    found = skinned(stage, 120.0 * time)
    for mesh in tree.at(time):
        near = 2.5e-3 if time else 0.01  # scales are in half precision there, and none is nothing: the tree begins as a speck
        assert np.linalg.norm(found[mesh.name] - mesh.position, axis=1).max() < near


def test_what_is_drawn_is_within_the_extent_at_every_time(grown):
    _, path = grown
    stage = Usd.Stage.Open(str(path))
    for time in (0.0, 0.3, 0.6, 1.0):
        low, high = np.array(UsdGeom.Boundable(stage.GetDefaultPrim()).GetExtentAttr().Get(120.0 * time))
        for points in skinned(stage, 120.0 * time).values():
            assert (points >= low - 0.01).all() and (points <= high + 0.01).all()
        assert (high - low).max() < 12.0


def test_it_is_read_back_as_it_moves(grown):
    tree, path = grown
    back = read_usd(path)
    assert back.animation.seconds == SECONDS and len(back.animation.morphs) == len(tree.asset().animation.morphs)
    for time in (0.2, 0.7, 1.0):
        for mine, other in zip(tree.at(time), posed(back, SECONDS * time), strict=True):
            assert mine.name == other.name and np.abs(mine.position - other.position).max() < 2.5e-3
