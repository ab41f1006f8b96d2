"""The page's own checks: its types hold, its own tests pass, and what is built is small and loads nothing from elsewhere."""

import gzip
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from sketchtree.studio import built

PAGE = Path(built.__file__).parent / "page"
LIMIT = 1_500_000  # bytes of the page, gzipped


def _without(reason: str):
    """No Node here: in CI that is a failure."""
    (pytest.fail if os.environ.get("CI") else pytest.skip)(reason)


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """A copy of the page's sources with what they need installed."""
    if not (PAGE / "package.json").is_file():
        pytest.skip("this installation has the built page only")
    npm = shutil.which("npm")
    if npm is None:
        _without("npm is not on PATH")
    copy = tmp_path_factory.mktemp("sources") / "page"
    shutil.copytree(PAGE, copy, ignore=shutil.ignore_patterns("node_modules", "dist*"))
    done = subprocess.run([npm, "ci", "--ignore-scripts", "--prefer-offline"], cwd=copy, capture_output=True, text=True, timeout=240)
    if done.returncode:
        _without(f"npm ci failed: {done.stderr[-300:]}")
    return copy


def _npm(checkout: Path, *command: str) -> None:
    done = subprocess.run([shutil.which("npm"), *command], cwd=checkout, capture_output=True, text=True, timeout=240)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]


def test_the_types_of_the_page_hold(checkout):
    _npm(checkout, "run", "check")


def test_the_page_passes_its_own_tests(checkout):
    _npm(checkout, "test")


@pytest.fixture
def dist():
    if not (built.DIST / "index.html").is_file():
        _without("the page was not built")
    return built.DIST


def _files(dist: Path, *endings: str) -> list[Path]:
    return [path for path in dist.rglob("*") if path.suffix in endings]


def test_the_page_is_at_most_one_and_a_half_megabytes_gzipped(dist):
    page = sum(len(gzip.compress(path.read_bytes(), 9)) for path in _files(dist / "assets", ".js", ".css"))
    assert 0 < page <= LIMIT


def test_the_page_has_nothing_inline_and_nothing_from_elsewhere(dist):
    text = (dist / "index.html").read_text("utf-8")
    assert not re.findall(r"<script(?![^>]*\bsrc=)", text), "an inline script"
    assert "<style" not in text and not re.findall(r"\sstyle=", text), "an inline style"
    assert not re.findall(r"""(?:src|href)=["'](?:https?:)?//""", text)
    for sheet in _files(dist, ".css"):
        assert not re.findall(r"""url\(["']?(?:https?:)?//""", sheet.read_text("utf-8"))
