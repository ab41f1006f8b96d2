"""Where is the page that the browser loads? It is built from `page/src/` when the package is (`hatch_build.py`), and lies in `page/dist/`."""

from pathlib import Path

from sketchtree.errors import SketchTreeError

DIST = Path(__file__).parent / "page" / "dist"


def page_folder(dist: Path = DIST) -> Path:
    """The folder with `index.html` and its assets. Raises SketchTreeError, with the remedy, where the page was not built."""
    _check(dist, "index.html")
    return dist


def widget_file(dist: Path = DIST) -> Path:
    """The notebook's page, one file. Raises SketchTreeError likewise."""
    _check(dist, "widget.js")
    return dist / "widget.js"


def _check(dist: Path, needed: str) -> None:
    if not (dist / needed).is_file():
        raise SketchTreeError(
            "The studio's page is not in this installation: it is made when the package is built, and Node.js or the network was missing then.",
            remedy=_remedy(dist.parent),
        )


def _remedy(page: Path) -> str:
    if (page / "package.json").is_file():
        return f"Install Node.js 20.19 or newer, run `npm ci` and `npm run build` in {page}, and try again."
    return "Install Node.js 20.19 or newer, then reinstall: `pip install --force-reinstall --no-deps --no-binary sketchtree sketchtree`."
