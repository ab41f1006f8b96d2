"""Where is the page that the browser loads? It is built from `page/src/` when the package is (`hatch_build.py`), and lies in `page/dist/`."""

from pathlib import Path

from sketchtree.errors import SketchTreeError

DIST = Path(__file__).parent / "page" / "dist"


def page_folder(dist: Path = DIST) -> Path:
    """The folder with `index.html`, its assets and the notebook's `widget.js`. Raises SketchTreeError, with the remedy, where the page was not built."""
    if not (dist / "index.html").is_file():
        raise SketchTreeError(
            "The studio's page is not in this installation: it is made when the package is built, and Node.js or the network was missing then.",
            remedy=_remedy(dist.parent),
        )
    return dist


def _remedy(page: Path) -> str:
    if (page / "package.json").is_file():
        return f"Install Node.js 20.19 or newer, run `npm ci` and `npm run build` in {page}, and try again."
    return "Install Node.js 20.19 or newer, then reinstall: `pip install --force-reinstall --no-deps --no-binary sketchtree sketchtree`."
