"""Which drawings come with the program, to begin with?"""

from pathlib import Path

from sketchtree.errors import SketchError

FIRST = "oak_50.svg"  # shown when the studio is started with no file
_KINDS = (".svg", ".json")
_TITLES = {"curvy.svg": "Wind-swept pine", "oak_50.svg": "Old oak", "poplar.svg": "Lombardy poplar"}  # where the file's name says less


def folder() -> Path:
    """`examples/` of the package, else of a checkout."""
    packaged = Path(__file__).parent / "examples"
    return packaged if packaged.is_dir() else Path(__file__).parents[2] / "examples"


def names() -> list[str]:
    """Names of their files."""
    return sorted(path.name for path in folder().glob("*.*") if path.suffix in _KINDS)


def title(name: str) -> str:
    """What a person calls it."""
    return _TITLES.get(name) or Path(name).stem.replace("_", " ").capitalize()


def data(name: str) -> bytes:
    """The bytes of one. Raises SketchError."""
    if name not in names():
        raise SketchError("There is no example of that name.", remedy=f"The examples are {', '.join(names())}.")
    return (folder() / name).read_bytes()
