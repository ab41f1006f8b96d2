"""MTG: the text's grammar by rules of its own, and our reader."""

import re

import numpy as np
import pytest
from shapes import curved

from sketchtree.errors import ExportError
from sketchtree.export.skeletons.mtg import mtg_text, write_mtg
from sketchtree.export.skeletons.swc import swc_nodes
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_mtg import read_mtg


def grown(rows: int = 400, seed: int = 0, bases: int = 1) -> TreeSkeleton:
    """A tree of limbs by chance."""
    rng = np.random.default_rng(seed)
    parent, limb = [-1] * bases, list(range(bases))
    for row in range(bases, rows):
        above = int(rng.integers(max(0, row - 30), row))
        taken = [limb[child] for child in range(bases, row) if parent[child] == above]
        parent.append(above)
        limb.append(limb[above] if limb[above] not in taken and rng.random() < 0.7 else row)
    tip = rng.normal(size=(rows, 3)) * 3
    return TreeSkeleton.from_columns(np.array(parent), tip, rng.uniform(0.01, 0.1, rows), limb=np.array(limb))


def sections(text):
    """The lines of every section, by its name."""
    found, name = {}, None
    for line in text.splitlines():
        if match := re.fullmatch(r"(CODE|CLASSES|DESCRIPTION|FEATURES|MTG):(?:\t(\S+))?", line):
            name = match[1]
            found[name] = [match[2]] if match[2] else []
        elif line.strip() and not line.startswith("#"):
            found[name].append(line)
    return found


def edges(text):
    """(above, edge, node) of every entity by the rules of the format: a column continues with `^`, else hangs on the column to its left."""
    head, *lines = sections(text)["MTG"]
    width = head.split("\t").index("XX")
    last, found = {}, []
    for line in lines:
        cells = line.split("\t")
        column = next(i for i, cell in enumerate(cells) if cell)
        assert column < width, line
        again, edge, symbol, number = re.fullmatch(r"(\^?)([/<+])([PN])(\d+)", cells[column]).groups()
        above = last[column] if again else last.get(column - 1)
        assert again or edge != "<", line
        if symbol == "N":
            assert len(cells) == width + 4 and all(np.isfinite(float(cell)) for cell in cells[width:]), line
        found.append((above, edge, (symbol, int(number))))
        last = {c: entity for c, entity in last.items() if c < column} | {column: (symbol, int(number))}
    return found


def test_the_sections_stand_in_the_order_of_the_format():
    found = sections(mtg_text(curved()))
    assert list(found) == ["CODE", "CLASSES", "DESCRIPTION", "FEATURES", "MTG"] and found["CODE"] == ["FORM-A"]
    assert found["CLASSES"] == ["SYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION", "$\t0\tFREE\tFREE\tIMPLICIT", "P\t1\tFREE\tFREE\tEXPLICIT", "N\t2\tFREE\tFREE\tEXPLICIT"]
    assert found["FEATURES"] == ["NAME\tTYPE", "XX\tREAL", "YY\tREAL", "ZZ\tREAL", "radius\tREAL"]
    assert {line.split("\t")[2] for line in found["DESCRIPTION"][1:]} == {"+", "<"}


def test_the_text_of_a_small_tree_is_exactly_this():
    assert sections(mtg_text(curved()))["MTG"] == [
        "ENTITY-CODE\t\tXX\tYY\tZZ\tradius",
        "/P1",
        "^/N1\t\t0\t0\t0\t0.3",
        "^<N2\t\t0\t1\t0\t0.2",
        "^<N3\t\t0\t1.25\t0\t0.177098005",
        "^<N4\t\t0\t1.5\t0\t0.154196011",
        "^<N5\t\t0.1\t2\t0.3\t0.1",
        "\t+N7\t-0.5\t3\t0.333333333\t0.04",
        "^<N6\t\t0.5\t3\t0\t0.05",
    ]


@pytest.mark.parametrize("tree", [curved(), grown(), grown(300, 1, bases=3)], ids=["curved", "grown", "three stems"])
def test_every_node_hangs_where_it_grows_and_is_named_once(tree):
    node, found = swc_nodes(tree), edges(mtg_text(tree))
    nodes = [row for row in found if row[2][0] == "N"]
    assert sorted(number for _, _, (_, number) in nodes) == list(range(1, len(node["parent"]) + 1))
    for above, edge, (_, number) in nodes:
        parent = int(node["parent"][number - 1])
        assert above[0] == ("N" if parent > 0 else "P") and (parent < 1 or above[1] == parent)
        assert (edge == "/") == (parent < 1)


def test_at_most_one_node_goes_on_from_each():
    follows = [above for above, edge, _ in edges(mtg_text(grown())) if edge == "<"]
    assert len(follows) == len(set(follows))


@pytest.mark.parametrize("tree", [grown(), grown(300, 1, bases=3), curved()], ids=["grown", "three stems", "curved"])
def test_our_reader_gives_the_nodes_and_the_limbs_back(tmp_path, tree):
    write_mtg(tmp_path / "t.mtg", tree, header={"units": "metres", "seed": 3})
    back, node = read_mtg(tmp_path / "t.mtg"), swc_nodes(tree)
    order = np.lexsort(back.tip.T), np.lexsort(np.round(node["point"], 12).T)
    np.testing.assert_allclose(back.tip[order[0]], node["point"][order[1]], rtol=1e-8, atol=1e-12)
    np.testing.assert_allclose(back.radius[order[0]], node["radius"][order[1]], rtol=1e-8)
    assert len(set(back.limb.tolist())) == len(set(tree.limb.tolist()))
    assert back.is_base.sum() == tree.is_base.sum()


def test_the_header_stands_in_comments():
    assert mtg_text(curved(), header={"units": "metres", "seed": 3}).splitlines()[1:3] == ["# units: metres", "# seed: 3"]


def test_an_empty_tree_has_no_entities():
    empty = TreeSkeleton.from_columns(np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))
    assert sections(mtg_text(empty))["MTG"] == ["ENTITY-CODE\tXX\tYY\tZZ\tradius"]


def test_another_extension_is_named(tmp_path):
    with pytest.raises(ExportError, match=r"This version writes \.mtg here"):
        write_mtg(tmp_path / "t.txt", curved())
