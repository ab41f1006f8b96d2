"""Which drawings come with the program, to begin with? Which photo, with scribbles on it? And which points of a tree?"""

from pathlib import Path

from sketchtree.errors import SketchError

FIRST = "oak_50.svg"  # shown when the studio is started with no file
SCRIBBLED = {"sugar_maple.jpg": "sugar_maple_marks.json"}  # photos of a bare tree, and the scribbles on each
SCANNED = ("ash.ply",)  # point clouds
_KINDS = (".svg", ".json")
_TITLES = {
    "curvy.svg": "Wind-swept pine", "oak_50.svg": "Old oak", "poplar.svg": "Lombardy poplar", "sugar_maple.jpg": "Bare maple, a photo", "ash.ply": "Ash, a point cloud",
}  # fmt: skip - where the file's name says less


def folder() -> Path:
    """`examples/` of the package, else of a checkout."""
    packaged = Path(__file__).parent / "examples"
    return packaged if packaged.is_dir() else Path(__file__).parents[2] / "examples"


def names() -> list[str]:
    """Of the drawings, then of the photos and the point clouds."""
    return sorted(path.name for path in folder().glob("*.*") if path.suffix in _KINDS) + sorted(SCRIBBLED) + sorted(SCANNED)


def files() -> list[str]:
    """Of all that they are made of, from the folder on."""
    drawings = [name for name in names() if name not in SCRIBBLED and name not in SCANNED]
    return drawings + [f"photo/{name}" for pair in SCRIBBLED.items() for name in pair] + [f"cloud/{name}" for name in SCANNED]


def title(name: str) -> str:
    """What a person calls it."""
    return _TITLES.get(name) or Path(name).stem.replace("_", " ").capitalize()


def data(name: str) -> bytes:
    """The bytes of a drawing, a photo or a point cloud. Raises SketchError."""
    if name not in names():
        raise SketchError("There is no example of that name.", remedy=f"The examples are {', '.join(names())}.")
    place = folder() / "photo" if name in SCRIBBLED else folder() / "cloud" if name in SCANNED else folder()
    return (place / name).read_bytes()


def scribbles(name: str) -> bytes:
    """Those on a photo of `SCRIBBLED`, as JSON."""
    return (folder() / "photo" / SCRIBBLED[name]).read_bytes()
