"""Digitised trees become exemplars: stood up, measured, added whole or not at all."""

import json
from pathlib import Path

import numpy as np
import pytest

from sketchtree.commands.app import run
from sketchtree.commands.templates import GROWTH_HABITS
from sketchtree.errors import TemplateError
from sketchtree.export.skeletons import write_skeleton_json, write_swc
from sketchtree.parameters import Habit
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.skeleton_files import read_skeleton
from sketchtree.skeleton_hdf5 import write_skeleton_hdf5
from sketchtree.templates.growing import recipe
from sketchtree.templates.store.database import Database
from sketchtree.templates.importing.frame import stood
from sketchtree.templates.importing.habit import habit_from_tree
from sketchtree.templates.importing.read import Described, check_name, imported, name_of
from sketchtree.templates.making.order import make
from sketchtree.templates.making.regenerate import orders, recipe_folder

SHIPPED = recipe_folder() / "exemplars.h5"
SKELETONS = Path(__file__).resolve().parents[3] / "shared" / "data" / "skeletons"
MEASURED = {"apple_agraf.mtg": "mm", "qsm_rtwig.csv": "m", "qsm_archi_tree1.txt": "m"}


def _tree():
    """A trunk of ten segments of .5 m, a pair of opposite laterals of 1 m at 60° on each of nodes 3 to 9, the pipe model with n = 2."""
    parent, tip, radius, order, limb = [-1], [(0.0, 0.0, 0.0)], [0.0], [0], [0]
    for k in range(1, 11):
        parent.append(len(tip) - 1 if k == 1 else trunk)
        tip.append((0.0, 0.5 * k, 0.0))
        radius.append(0.0)
        order.append(0)
        limb.append(0)
        trunk = len(tip) - 1
        if 3 <= k <= 9:
            for side in (-1, 1):
                parent.append(trunk)
                tip.append((side * np.sin(np.pi / 3), 0.5 * k + np.cos(np.pi / 3), 0.0))
                radius.append(0.01)
                order.append(1)
                limb.append(len(tip))
    square = np.zeros(len(tip))
    for row in range(len(tip) - 1, -1, -1):  # r² of a row is the sum over its children, .01² at a tip
        square[row] = square[row] or 0.01**2
        if parent[row] >= 0:
            square[parent[row]] += square[row]
    return TreeSkeleton.from_columns(np.array(parent), np.array(tip), np.sqrt(square), order=np.array(order), limb=np.array(limb))


@pytest.fixture
def tree():
    return _tree()


@pytest.fixture
def typed(capsys, monkeypatch):
    monkeypatch.setenv("SKETCHTREE_DB", str(SHIPPED))

    def type_in(*arguments):
        status = run(["templates", "import", *map(str, arguments)])
        said = capsys.readouterr()
        return status, said.out, said.err

    return type_in


def test_the_habit_is_what_the_tree_was_made_with(tree):
    habit = habit_from_tree(tree, like=Habit(leaf="birch", gravitropism=7.0, phyllotaxis=90.0))
    assert habit.height == 5.0 and habit.max_order == 1
    assert habit.trunk_ratio == pytest.approx(np.sqrt(15) * 0.01 / 5, rel=1e-3)
    assert habit.pipe_exponent == pytest.approx(2.0, abs=1e-4) and habit.twig_radius == pytest.approx(0.01)
    assert (habit.whorl, habit.arrangement) == (2, "opposite")
    assert habit.lateral_spacing == pytest.approx(0.5) and habit.lateral_angle == pytest.approx(60, abs=1e-3)
    assert habit.lateral_ratio == pytest.approx(0.2) and habit.twig_length == pytest.approx(1.0)
    assert habit.apical_control == Habit().apical_control, "laterals of one length say nothing"
    assert (habit.leaf, habit.gravitropism, habit.phyllotaxis) == ("birch", 7.0, 90.0), "borrowed"


def test_what_a_stick_cannot_tell_stays_as_it_was(tree):
    stick = tree.select(tree.order == 0)
    habit, default = habit_from_tree(stick), Habit()
    assert habit.height == 5.0 and habit.max_order == 0
    for field in ("pipe_exponent", "arrangement", "lateral_spacing", "lateral_ratio", "lateral_angle", "twig_length", "apical_control"):
        assert getattr(habit, field) == getattr(default, field), field


def test_apical_control_tells_a_fir_from_an_oak(tree):
    def laterals(factor):
        rows = tree.order == 1
        reach = np.where(rows, np.interp(tree.start[:, 1], [1.5, 4.5], factor), 1.0)
        return habit_from_tree(tree.replace(tip=tree.start + tree.vector * reach[:, None])).apical_control

    assert laterals((1.0, 0.2)) > 0.95 and laterals((0.2, 1.0)) < 0.05


def test_units_and_axes_are_turned_into_ours(tree):
    deep = tree.replace(tip=(tree.tip[:, [0, 2, 1]] * (1, -1, 1) + (3, 4, 5)) * 1000, radius=tree.radius * 1000)
    up = stood(deep, file="x", unit="mm", up="z")
    np.testing.assert_allclose(up.tip, tree.tip, atol=1e-9)
    np.testing.assert_allclose(up.radius, tree.radius)
    assert set(up.limb.tolist()) == set(range(15)) and (up.kind == int(Kind.OBSERVED)).all()
    with pytest.raises(TemplateError, match=r"x: read in m with y up, the tree is .* m tall\. Say in which unit it is and which way is up, with --unit"):
        stood(deep, file="x")
    with pytest.raises(TemplateError, match=r"x: the tree has no segments"):
        stood(tree.select(tree.is_base), file="x")


def test_drawn_roots_are_left_out(tree):
    kind = np.where(tree.limb == tree.limb[4], int(Kind.ROOT), int(Kind.DRAWN))
    assert len(stood(tree.replace(kind=kind), file="x")) == len(tree) - 1


def test_names_come_from_files():
    assert name_of(Path("a/Old Oak-3 (north).SWC")) == "old_oak_3_north"
    assert name_of(Path("7.swc")) == "tree_7" and name_of(Path("Ä.swc")) == "tree" and len(name_of(Path("x" * 99))) == 48
    assert check_name("old_oak") == "old_oak"
    with pytest.raises(TemplateError, match=r"'Old Oak' is no plain name"):
        check_name("Old Oak")


def test_the_commands_growth_habits_are_the_recipes():
    assert GROWTH_HABITS == recipe.GROWTH_HABITS


def test_every_format_gives_the_same_exemplar(tree, tmp_path):
    tree = stood(tree, file="x")
    write_swc(tmp_path / "t.swc", tree, header={})
    write_skeleton_json(tmp_path / "t.json", tree)
    write_skeleton_hdf5(tmp_path / "t.h5", tree)
    np.savez(tmp_path / "t.npz", parent=tree.parent, pos=tree.tip, radius=tree.radius)
    blocks = [imported(tmp_path / f"t.{ending}", Described()) for ending in ("swc", "json", "h5", "npz")]
    for block in blocks[1:]:
        np.testing.assert_allclose(block["theta/tree"], blocks[0]["theta/tree"], rtol=1e-4, atol=1e-5)
        np.testing.assert_allclose(block["views/footprint"], blocks[0]["views/footprint"], atol=1e-4)
        assert block["exemplar/name"].tolist() == [b"t"] and block["exemplar/recipe"].tolist() == [b""]


def test_theta_is_that_of_the_tree(tree, tmp_path):
    write_swc(tmp_path / "t.swc", tree, header={})
    block = imported(tmp_path / "t.swc", Described())
    mu_s, _, mu_alpha, _, mu_beta, sigma_beta, *_ = block["theta/tree"][0]
    assert np.degrees(mu_alpha) == pytest.approx(0, abs=1e-2) and np.degrees(mu_beta) == pytest.approx(60, abs=1e-2) and sigma_beta < 1e-2
    assert block["limbs/divergence_count"].tolist() == [[14, 0]]


def test_the_command_begins_a_database_and_adds_to_it(typed, tree, tmp_path):
    write_swc(tmp_path / "Old Oak.swc", tree, header={})
    write_skeleton_json(tmp_path / "young.json", tree.replace(tip=tree.tip / 2))
    into = tmp_path / "mine.h5"
    status, out, err = typed(
        tmp_path / "Old Oak.swc", tmp_path / "young.json", "--into", into, "--species", "Quercus robur", "--growth-habit", "decurrent",
        "--like", "english_oak", "--leaf", "beech", "--source", "Measured by hand", "--report", tmp_path / "r.json",
    )  # fmt: skip
    assert status == 0 and out == "" and err.splitlines()[-1].startswith(f"wrote {into}: 2 exemplars, 2 of them new, ")
    oak = Database(into).exemplar("old_oak")
    assert (oak.title, oak.species, oak.growth_habit, oak.seed, oak.recipe) == ("old oak", "Quercus robur", "decurrent", 0, "")
    assert oak.source.startswith("Measured by hand; digitised tree, imported from Old Oak.swc (sha256 ") and oak.source.endswith(", m, y up)")
    assert oak.habit.leaf == "beech" and oak.habit.bark == Database(SHIPPED).exemplar("english_oak").habit.bark and oak.habit.whorl == 2
    assert json.loads((tmp_path / "r.json").read_text())["imported"] == ["old_oak", "young"]
    assert typed(tmp_path / "young.json", "--into", into, "--name", "third", "--title", "A third", "--quiet") == (0, "", "")
    assert Database(into).names == ("old_oak", "young", "third") and Database(into).titles[2] == "A third"
    assert typed(tmp_path / "young.json", "--into", into, "--replace", "--species", "Quercus rubra", "--quiet") == (0, "", "")
    assert Database(into).names == ("old_oak", "young", "third") and Database(into).species[1] == "Quercus rubra"
    Database(into).verify()


def test_show_tells_where_it_comes_from_and_how_sure_its_theta_is(typed, tree, tmp_path, capsys):
    write_swc(tmp_path / "t.swc", tree, header={})
    assert typed(tmp_path / "t.swc", "--into", tmp_path / "a.h5", "--species", "Tilia", "--quiet")[0] == 0
    assert run(["templates", "show", "t", "--db", str(tmp_path / "a.h5")]) == 0
    said = capsys.readouterr().out
    assert "Tilia" in said and "not said" in said and "; imported by SketchTree" in said
    assert "Θ, s.e. of means" in said and "Θ, order 2+, s.e." in said and "?" in said, "no pair of order 2 tells anything of γ"


def test_a_scanned_tree_becomes_an_exemplar(typed, tree, tmp_path):
    """Its points in centimetres, z up: the tree is traced, with its fourteen laterals, and what leads on at the top, and their angle."""
    random, long = np.random.default_rng(0), np.where(tree.parent < 0, 0.0, tree.length)
    row = random.choice(len(tree), 12_000, p=long / long.sum())
    share = random.random((len(row), 1))
    around = random.normal(size=(len(row), 3))
    around /= np.linalg.norm(around, axis=1, keepdims=True)
    points = tree.tip[tree.parent[row]] * (1 - share) + tree.tip[row] * share + tree.radius[row, None] * around
    np.savetxt(tmp_path / "Old Oak.xyz", 100 * points[:, [0, 2, 1]] * (1, -1, 1), fmt="%.3f")
    assert typed(tmp_path / "Old Oak.xyz", "--into", tmp_path / "a.h5", "--unit", "cm", "--quiet") == (0, "", "")
    oak = Database(tmp_path / "a.h5").exemplar("old_oak")
    assert "traced in the point cloud Old Oak.xyz (sha256 " in oak.source and np.ptp(oak.skeleton.tip[:, 1]) == pytest.approx(np.ptp(tree.tip[:, 1]), rel=0.03)
    rows = [np.flatnonzero(oak.skeleton.limb == limb) for limb in np.unique(oak.skeleton.limb[oak.skeleton.order == 1])]
    rise = [oak.skeleton.tip[row[-1]] - oak.skeleton.tip[row[0]] for row in rows if oak.skeleton.length[row].sum() > 0.5]
    assert len(rise) == 14 and np.degrees(np.median([np.arccos(one[1] / np.linalg.norm(one)) for one in rise])) == pytest.approx(60, abs=2)
    theta = oak.theta.as_dict(degrees=True)
    assert theta["mu_beta"] == pytest.approx(60, abs=3) and theta["sigma_beta"] < 15
    assert oak.habit.lateral_angle == pytest.approx(60, abs=4) and oak.habit.lateral_spacing == pytest.approx(0.5, abs=0.02) and oak.habit.whorl == 2
    assert oak.habit.twig_length == pytest.approx(1.0, abs=0.05), "no spurs"


def test_the_same_import_gives_the_same_bytes(typed, tree, tmp_path):
    write_swc(tmp_path / "t.swc", tree, header={})
    for name in ("a.h5", "b.h5"):
        assert typed(tmp_path / "t.swc", "--into", tmp_path / name, "--quiet")[0] == 0
    assert (tmp_path / "a.h5").read_bytes() == (tmp_path / "b.h5").read_bytes()


def test_exemplars_of_another_database_are_taken_over(typed, tmp_path, tree):
    write_swc(tmp_path / "t.swc", tree, header={})
    assert typed(tmp_path / "t.swc", SHIPPED, "--into", tmp_path / "all.h5", "--quiet")[0] == 0
    both, shipped = Database(tmp_path / "all.h5"), Database(SHIPPED)
    assert both.names == ("t", *shipped.names) and both.exemplar("hazel").theta == shipped.exemplar("hazel").theta


def test_an_imported_tree_is_found_by_a_sketch_of_itself(typed, tmp_path):
    """The skeleton of a date palm from another seed, imported, is the best match of the palm's sketch or next to it."""
    (order,) = orders(recipe_folder(), only=("date_palm",), seed=77)
    write_swc(tmp_path / "my_palm.swc", make(order)[0].skeleton, header={})
    assert typed(tmp_path / "my_palm.swc", SHIPPED, "--into", tmp_path / "all.h5", "--like", "date_palm", "--quiet")[0] == 0
    sketch = recipe_folder().parent / "examples" / "palm.svg"
    assert run(["templates", "match", str(sketch), "--db", str(tmp_path / "all.h5"), "--quiet", "--report", str(tmp_path / "m.json")]) == 0
    ranked = [row["name"] for row in json.loads((tmp_path / "m.json").read_text())["template"]]
    assert ranked.index("my_palm") < 5


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["none.swc"], "Can't read none.swc: no such file or directory. Check the path."),
        (["t.glb"], "t.glb is no skeleton that can be read."),
        (["broken.swc"], "broken.swc, line 1: expected `id type x y z radius parent`, got `one two`."),
        (["t.swc", "--unit", "mm"], "t.swc: read in mm with y up, the tree is 0.005 m tall."),
        (["t.swc", "--leaf", "kelp"], "There is no leaf called “kelp”."),
        (["t.swc", "--bark", "kelp"], "There is no bark called “kelp”."),
        (["t.swc", "--like", "kelp"], "There is no exemplar called 'kelp'"),
        (["t.swc", "--name", "My Tree"], "'My Tree' is no plain name of an exemplar."),
        (["t.swc", "broken.swc", "--name", "x"], "`--name` and `--title` are for one file."),
        (["t.swc", "T.swc"], "Two of the trees would be called 't'."),
        (["stump.swc"], "stump.swc: the tree has no segments."),
    ],
)
def test_what_is_wrong_ends_in_one_paragraph_and_nothing_is_written(typed, tree, tmp_path, monkeypatch, arguments, says):
    monkeypatch.chdir(tmp_path)
    for name in ("t.swc", "T.swc"):
        write_swc(tmp_path / name, tree, header={})
    (tmp_path / "broken.swc").write_text("one two\n")
    (tmp_path / "stump.swc").write_text("1 0 0 0 0 1 -1\n")
    (tmp_path / "t.glb").touch()
    before = sorted(tmp_path.iterdir())
    status, _, err = typed(*arguments, "--into", "new.h5", "--quiet")
    assert status == 2 and says in err and "Traceback" not in err and len(err.strip().splitlines()) == 1
    assert sorted(tmp_path.iterdir()) == before


def test_a_taken_name_or_a_damaged_database_is_left_alone(typed, tree, tmp_path):
    write_swc(tmp_path / "apple.swc", tree, header={})
    copy = tmp_path / "copy.h5"
    for damage, says in [
        (lambda data: data, "copy.h5 already has an exemplar called 'apple'. Give another with --name, or put it in its place with --replace."),
        (lambda data: data[: len(data) // 2], "copy.h5: the database is damaged"),
        (lambda data: b"", "copy.h5: it is empty, so no database."),
        (lambda data: data[:900_000] + b"\xff" * 400 + data[900_400:], "copy.h5: the database is damaged"),
    ]:
        copy.write_bytes(damage(SHIPPED.read_bytes()))
        before = copy.read_bytes()
        replace = ["--replace"] if "damaged" in says else []
        status, _, err = typed(tmp_path / "apple.swc", "--into", copy, "--quiet", *replace)
        assert status == 2 and says in err and copy.read_bytes() == before


@pytest.mark.skipif(not SKELETONS.is_dir(), reason="the measured trees are not in the repository")
def test_every_measured_tree_at_hand_is_imported(typed, tmp_path):
    files = sorted(SKELETONS.glob("*.npz"))
    assert files and typed(*files, "--into", tmp_path / "npz.h5", "--like", "apple", "--quiet")[0] == 0
    db = Database(tmp_path / "npz.h5")
    assert db.names == tuple(file.stem for file in files)
    for name in db.names:
        tree = db.exemplar(name)
        assert np.isfinite(list(tree.theta.as_dict().values())).all() and 2 < tree.skeleton.height < 23


@pytest.mark.skipif(not SKELETONS.is_dir(), reason="the measured trees are not in the repository")
@pytest.mark.parametrize("file", MEASURED)
def test_our_readers_agree_with_what_others_made_of_the_originals(file, tmp_path):
    """Every node of the converted tree is a node of ours, to two micrometres, and the lengths agree."""
    ours = stood(read_skeleton(SKELETONS / "original" / file), file=file, unit=MEASURED[file], up="z")
    theirs = read_skeleton(SKELETONS / f"{Path(file).stem}.npz")
    apart = np.array([np.linalg.norm(ours.tip - tip, axis=1).min() for tip in theirs.tip])
    assert apart.max() < 2e-6
    assert ours.segment_count >= theirs.segment_count and ours.height == pytest.approx(theirs.height, rel=1e-6)
    assert (ours.length.sum() / theirs.length.sum()) == pytest.approx(1, abs=0.1)
