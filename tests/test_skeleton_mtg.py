"""MTG files as AMAPmod writes them, small enough to be checked by hand."""

from pathlib import Path

import numpy as np
import pytest

from sketchtree.errors import SkeletonError
from sketchtree.skeleton_files import read_skeleton
from sketchtree.skeleton_mtg import read_mtg

HEAD = """# a small tree
CODE :\tFORM-A

CLASSES:
SYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION
$\t0\tFREE\tFREE\tIMPLICIT
P\t1\tFREE\tFREE\tEXPLICIT
U\t2\tFREE\tFREE\tEXPLICIT
E\t3\tFREE\tFREE\tEXPLICIT
F\t3\tFREE\tFREE\tEXPLICIT

DESCRIPTION :
LEFT\tRIGHT\tRELTYPE\tMAX
U\tU\t+\t?

FEATURES:
NAME\tTYPE
XX\tREAL
YY\tREAL
ZZ\tREAL
TopDia\tREAL

MTG:
ENTITY-CODE\t\t\t\tXX\tYY\tZZ\tTopDia
"""
TREE = """/P1
^/U90\t\t\t\t0\t0\t0\t400
^/E1<<E4\t\t\t\t0\t0\t800\t300
\t+U91/E1\t\t\t200\t0\t900\t100
\t^<E2+F1
^<E5\t\t\t\t0\t0\t1000\t200
"""


def _file(folder, body=TREE, head=HEAD):
    path = Path(folder) / "t.mtg"
    path.write_text(head + body)
    return path


def test_a_chain_a_lateral_and_a_flower_without_coordinates(tmp_path):
    tree = read_skeleton(_file(tmp_path))
    np.testing.assert_allclose(tree.tip, [[0, 0, 0], [0, 0, 800], [200, 0, 900], [0, 0, 1000]])
    assert tree.parent.tolist() == [-1, 0, 1, 1]
    assert tree.order.tolist() == [0, 0, 1, 0] and tree.limb[3] == tree.limb[0] != tree.limb[2]
    np.testing.assert_allclose(tree.radius, [20, 15, 5, 10])


def test_entities_that_bear_a_lateral_stand_evenly_between_digitised_ones(tmp_path):
    body = TREE.replace("^/E1<<E4\t\t\t\t0\t0\t800\t300\n", "^/E1<<E2\n\t+U95/E1\t\t\t100\t0\t400\n^<E3<E4\t\t\t\t0\t0\t800\t300\n")
    tree = read_mtg(_file(tmp_path, body))
    borne = int(np.flatnonzero(tree.tip[:, 0] == 100)[0])
    np.testing.assert_allclose(tree.tip[tree.parent[borne]], [0, 0, 400])
    assert tree.order[borne] == 1 and tree.order[tree.parent[borne]] == 0 and len(tree) == 6
    assert tree.radius[borne] == tree.radius[tree.parent[borne]] == 15


def test_an_entity_of_no_length_only_hands_on_that_it_is_a_lateral(tmp_path):
    body = TREE.replace("\t+U91/E1\t\t\t200\t0\t900\t100\n", "\t+U91\t\t\t0\t0\t800\t100\n\t^/E1\t\t\t200\t0\t900\t100\n")
    tree = read_mtg(_file(tmp_path, body))
    assert tree.order.tolist() == [0, 0, 1, 0] and tree.parent.tolist() == [-1, 0, 1, 1]


def test_two_plants_are_two_bases(tmp_path):
    tree = read_mtg(_file(tmp_path, TREE + "/P2\n^/U90\t\t\t\t5000\t0\t0\n^/E1\t\t\t\t5000\t0\t700\n"))
    assert tree.is_base.sum() == 2 and tree.tree.tolist() == [0, 0, 0, 0, 1, 1]


@pytest.mark.parametrize(
    ("body", "head", "says"),
    [
        ("", "nothing of the kind", r"t\.mtg is no MTG file: it has no section `MTG:`\. Give a file of AMAPmod"),
        (TREE, HEAD.replace("FORM-A", "FORM-B"), r"it is written in FORM-B, and only FORM-A is read\. Save it as FORM-A"),
        (TREE, HEAD.replace("ENTITY-CODE", "WHAT"), r"after `MTG:` there is no line of columns that begins with ENTITY-CODE"),
        (TREE, HEAD.replace("ENTITY-CODE\t\t\t\tXX", "ENTITY-CODE\t\t\t\tAA"), r"line 24: there are no columns XX, YY and ZZ"),
        ("/P1\n^/U90\t\t\t\t0\t0\t0\n", HEAD, r"fewer than two entities have coordinates"),
        (TREE.replace("^<E5", "^<5"), HEAD, r"line 30: `<5` is no chain of entities \(`\^<5 0 0 1000 200`\)\. Repair the line"),
        (TREE.replace("E1<<E4", "E4<<E1"), HEAD, r"line 27: `<<E1` does not count up"),
        (TREE.replace("E1<<E4", "E1<<E999999999"), HEAD, r"line 27: `<<E999999999` does not count up"),
        (TREE.replace("1000\t200", "high\t200"), HEAD, r"line 30: `high` is no number"),
        ("\t+E1\t\t\t0\t0\t0\n" + TREE.replace("/P1", "^/P1"), HEAD, r"line 26: there is no entity for it to grow on"),
        (TREE + "\t\t\t\t5\t5\t5\n", HEAD, r"line 31: no entity stands before its figures"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(tmp_path, body, head, says):
    with pytest.raises(SkeletonError, match=says):
        read_mtg(_file(tmp_path, body, head))


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(SkeletonError, match=r"Can't read .*none\.mtg: no such file or directory\. Check the path\."):
        read_mtg(tmp_path / "none.mtg")
