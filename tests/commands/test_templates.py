"""`sketchtree templates`, as it is typed."""

import json
from pathlib import Path

import pytest
from PIL import Image

from sketchtree.commands.app import run
from sketchtree.templates.store.database import Database
from sketchtree.templates.making.regenerate import recipe_folder

ROOT = Path(__file__).resolve().parents[2]
SHIPPED = recipe_folder() / "exemplars.h5"
NAMES = list(Database(SHIPPED).names)


@pytest.fixture
def typed(capsys):
    """Types a command; returns (exit status, stdout, stderr)."""

    def type_in(*arguments):
        status = run(["templates", *map(str, arguments)])
        said = capsys.readouterr()
        return status, said.out, said.err

    return type_in


def test_list_prints_one_line_an_exemplar_and_nothing_else(typed):
    status, out, err = typed("list", "--db", SHIPPED)
    assert status == 0 and err == ""
    assert [line.split()[0] for line in out.splitlines()] == NAMES
    assert out.splitlines()[0].split(maxsplit=4) == ["american_elm", "decurrent", "Ulmus", "americana", "American elm"]


def test_list_as_json_names_them_too(typed):
    status, out, _ = typed("list", "--json", "--db", SHIPPED)
    assert status == 0 and [row["name"] for row in json.loads(out)] == NAMES
    first = {"name": "american_elm", "title": "American elm (Ulmus americana)", "species": "Ulmus americana", "growth_habit": "decurrent"}
    assert json.loads(out)[0] == first


def test_show_says_what_is_known_and_draws_a_picture(typed, tmp_path):
    status, out, _ = typed("show", "norway_spruce", "-o", tmp_path / "s.png", "--report", tmp_path / "r.json", "--db", SHIPPED)
    assert status == 0
    for fact in ("Norway spruce (Picea abies)", "species", "excurrent", "18.0 m", "orders 0 to 2", "Θ", "whorled laterals, 5 a node", "estimated; seed 5"):
        assert fact in out
    with Image.open(tmp_path / "s.png") as picture:
        assert picture.size[0] == 1280
    assert json.loads((tmp_path / "r.json").read_text())["exemplar"]["name"] == "norway_spruce"


def test_sheet_draws_all_of_them(typed, tmp_path):
    assert typed("sheet", "-o", tmp_path / "all.png", "--db", SHIPPED) == (0, "", "")
    with Image.open(tmp_path / "all.png") as picture:
        assert picture.size == (1280, -(-len(NAMES) // 4) * 348)


@pytest.mark.parametrize(
    ("sketch", "likely"),
    [
        ("spruce.svg", {"norway_spruce"}),
        ("poplar.svg", {"lombardy_poplar"}),
        ("palm.svg", {"date_palm"}),
        ("willow.svg", {"weeping_willow"}),
        ("oak.svg", {"english_oak", "european_beech", "norway_maple", "apple"}),
    ],
)
def test_match_puts_the_likely_species_first(typed, sketch, likely):
    status, out, _ = typed("match", ROOT / "examples" / sketch, "--json", "--db", SHIPPED)
    rows = json.loads(out)
    assert status == 0 and rows[0]["name"] in likely
    assert sorted(row["name"] for row in rows) == sorted(NAMES)
    assert set(rows[0]) == {"name", "view_deg", "score", "crown", "branching"}


def test_match_prints_lines_and_knows_the_papers_score(typed):
    sketch = ROOT / "examples" / "spruce.svg"
    status, out, _ = typed("match", sketch, "--score", "chen", "--db", SHIPPED)
    assert status == 0 and len(out.splitlines()) == len(NAMES) and "seen from" in out
    rows = json.loads(typed("match", sketch, "--score", "chen", "--json", "--db", SHIPPED)[1])
    assert rows[0]["score"] == pytest.approx(rows[0]["branching"]) and rows[0]["crown"] is None


def test_build_makes_what_is_asked_and_says_so_in_plain_lines(typed, tmp_path):
    out = tmp_path / "two.h5"
    status, said, err = typed("build", "--out", out, "--only", "apple", "--only", "date_palm", "--report", tmp_path / "r.json")
    assert status == 0 and said == ""
    assert err.splitlines()[:2] == ["apple …", "date_palm …"] and "wrote" in err and "2 exemplars" in err
    assert Database(out).names == ("apple", "date_palm")
    assert json.loads((tmp_path / "r.json").read_text())["exemplars"] == ["apple", "date_palm"]


def test_build_takes_all_processors_and_tells_of_many_in_tenths(typed, tmp_path, monkeypatch, capsys):
    from sketchtree.commands.templates import Exemplars, cores
    from sketchtree.templates.making import regenerate as module

    asked = {}
    monkeypatch.setattr(module, "regenerate", lambda out, wanted, **how: asked.update(how) or Database(SHIPPED))
    (tmp_path / "x.h5").touch()
    assert typed("build", "--out", tmp_path / "x.h5")[0] == 0
    assert asked["jobs"] == cores() >= 1 and asked["scheduler"] is None
    monkeypatch.setattr("sketchtree.commands.progress.PATIENCE", 0.0)
    many = Exemplars(tuple(map(str, range(1000))), quiet=False)
    for name in range(1000):
        many(str(name))
    assert capsys.readouterr().err.splitlines() == ["1000 exemplars …"] + [f"1000 exemplars … {tenth}0%" for tenth in range(1, 11)]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["show", "oak"], "There is no exemplar called 'oak' in exemplars.h5. Did you mean dead_oak or english_oak or cypress_oak?"),
        (["build", "--only", "elm"], "There is no recipe called 'elm'."),
        (["build", "--scheduler", "tcp//x"], "--scheduler tcp//x: no Dask scheduler answers there."),
        (["build", "--scheduler", "tcp://x", "--jobs", "2"], "`--jobs` and `--scheduler` exclude each other."),
        (["list", "--db", "nowhere.h5"], "nowhere.h5: there is no such database."),
        (["match", "nowhere.svg"], "nowhere.svg"),
        (["show", "apple", "-o", "apple.gif"], "apple.gif: pictures of exemplars are PNG files. Let its name end in .png."),
        (["sheet", "-o", "nowhere/a.png"], "nowhere/a.png: it can't be written (No such file or directory)."),
        (["build", "--only", "apple", "--out", "nowhere/a.h5", "--quiet"], "nowhere/a.h5: it can't be written"),
        (["list", "--report", "nowhere/r.json"], "--report nowhere/r.json: it can't be written"),
    ],
)
def test_the_users_mistakes_end_in_one_paragraph_and_status_2(typed, tmp_path, monkeypatch, arguments, says):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SKETCHTREE_DB", str(SHIPPED))
    status, _, err = typed(*arguments)
    assert status == 2
    assert says in err and "Traceback" not in err and len(err.strip().splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_a_part_never_replaces_the_whole_database_unasked(capfd):
    from sketchtree.commands.app import run
    from sketchtree.templates.making.regenerate import recipe_folder

    before = (recipe_folder() / "exemplars.h5").read_bytes()
    assert run(["templates", "build", "--only", "hazel", "--quiet"]) == 2
    assert "would replace the whole database" in capfd.readouterr().err
    assert (recipe_folder() / "exemplars.h5").read_bytes() == before
