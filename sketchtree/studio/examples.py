"""Which drawings come with the program, to begin with? And which photo, with scribbles on it?"""

from pathlib import Path

from sketchtree.errors import SketchError

FIRST = "oak_50.svg"  # shown when the studio is started with no file
SCRIBBLED = {"sugar_maple.jpg": "sugar_maple_marks.json"}  # photos of a bare tree, and the scribbles on each
_KINDS = (".svg", ".json")
_TITLES = {
    "curvy.svg": "Wind-swept pine", "oak_50.svg": "Old oak", "poplar.svg": "Lombardy poplar", "sugar_maple.jpg": "Bare maple, a photo",
}  # fmt: skip - where the file's name says less


def folder() -> Path:
    """`examples/` of the package, else of a checkout."""
    packaged = Path(__file__).parent / "examples"
    return packaged if packaged.is_dir() else Path(__file__).parents[2] / "examples"


def names() -> list[str]:
    """Of the drawings, then of the photos."""
    return sorted(path.name for path in folder().glob("*.*") if path.suffix in _KINDS) + sorted(SCRIBBLED)


def files() -> list[str]:
    """Of all that they are made of, from the folder on."""
    return [name for name in names() if name not in SCRIBBLED] + [f"photo/{name}" for pair in SCRIBBLED.items() for name in pair]


def title(name: str) -> str:
    """What a person calls it."""
    return _TITLES.get(name) or Path(name).stem.replace("_", " ").capitalize()


def data(name: str) -> bytes:
    """The bytes of a drawing, or of a photo. Raises SketchError."""
    if name not in names():
        raise SketchError("There is no example of that name.", remedy=f"The examples are {', '.join(names())}.")
    return (folder() / "photo" / name if name in SCRIBBLED else folder() / name).read_bytes()


def scribbles(name: str) -> bytes:
    """Those on a photo of `SCRIBBLED`, as JSON."""
    return (folder() / "photo" / SCRIBBLED[name]).read_bytes()
