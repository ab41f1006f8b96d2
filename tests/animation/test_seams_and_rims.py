"""Limbs that only touch part as they grow; bark round a branch goes with its foot."""

import numpy as np
from growing_models import growing, model

from sketchtree.animation.rims import FAR, rims
from sketchtree.animation.seams import parted
from sketchtree.rig.islands import foreign_edges, mesh_places
from sketchtree.rig.place import Places


def test_triangles_between_limbs_that_have_nothing_to_do_with_each_other_go_with_one_of_them():
    tree, mesh = growing("age"), model().meshes[0]
    place = mesh_places(tree.lines, tree.limbs, mesh)
    branches = np.flatnonzero(tree.lines.parent == 0)
    away = np.flatnonzero(place.limb == branches[0])[-9:]
    place = Places(np.where(np.isin(np.arange(len(place.limb)), away), branches[-1], place.limb), np.where(np.isin(np.arange(len(place.s)), away), 1.2, place.s))
    whole, places = parted(mesh, tree.lines, tree.limbs, place)
    a, b = whole.triangle.ravel(), np.roll(whole.triangle, -1, axis=1).ravel()
    assert not foreign_edges(tree.lines, tree.limbs, places, a, b).any()
    assert np.array_equal(whole.position[whole.triangle], mesh.position[mesh.triangle])
    assert len(whole.position) > len(mesh.position) and len(whole.normal) == len(whole.uv) == len(whole.position)


def test_a_mesh_of_kin_alone_stays_as_it_is():
    tree, mesh = growing("age"), model().meshes[0]
    place = mesh_places(tree.lines, tree.limbs, mesh)
    assert parted(mesh, tree.lines, tree.limbs, place)[0] is mesh


def test_a_rim_is_on_the_side_of_its_branch_and_no_farther_than_it_may_be():
    tree, mesh = growing("age"), model().meshes[0]
    place = mesh_places(tree.lines, tree.limbs, mesh)
    rim = rims(tree.lines, tree.limbs, tree.hosts, place, mesh.position)
    out, radius = tree.lines.at(rim.limb, tree.limbs.buried[rim.limb])
    assert (np.linalg.norm(mesh.position[rim.vertex] - out, axis=1) <= FAR * radius).all()
    assert len(np.unique(rim.vertex)) == len(rim.vertex) and (rim.share > 0).all() and (rim.share <= 1).all()
    bark = place.limb[rim.vertex] == tree.lines.parent[rim.limb]
    axis = tree.lines.at(place.limb[rim.vertex], place.s[rim.vertex])[0]
    assert (np.sum((mesh.position[rim.vertex] - axis) * (out - axis), axis=1)[bark] > 0).all()
