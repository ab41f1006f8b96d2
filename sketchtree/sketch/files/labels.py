"""What does a name say about a stroke? Words in ids, classes and layer names, in any program's spelling.

`crown_x5F_outline_1_` (Illustrator), `Crown outline` (Inkscape), `crownOutline` (Figma) and `crown 2` are one name. Where a
name holds several of our words the last decides, as in English: the *canopy* of "leaf canopy", the *shadow* of
"crown shadow". A word inside another ("groundbreaking", "uprooted") says nothing.
"""

import re
from functools import lru_cache

from sketchtree.sketch.strokes import StrokeKind

_WORDS: dict[StrokeKind | str, str] = {
    StrokeKind.CROWN: "crown canopy canopies treetop foliage_outline foliage_contour foliage_envelope leaf_outline leaves_outline",
    StrokeKind.OBSTACLE: "obstacle obstruction keep_out",
    StrokeKind.BRANCH: "branch trunk limb bough twig stem",
    "ground": "ground soil earth grass horizon floor ground_line ground_level",
    "root": "root rootstock taproot",
    "shadow": "shadow cast_shadow shade",
    "leaves": "leaf leaves foliage needle blossom flower fruit",
    "hatching": "hatch hatches hatching crosshatch crosshatching shading texture bark",
    "paper": "paper background bg backdrop underlay reference note notes annotation guide guideline frame scan photo",
}
_MEANING = {word.replace("_", " "): meaning for meaning, words in _WORDS.items() for word in words.split()}
_MEANING |= {word + ending: meaning for word, meaning in list(_MEANING.items()) for ending in ("s", "es")}
_FIND = re.compile(r"(?<![^\W\d_])(" + "|".join(sorted(_MEANING, key=len, reverse=True)) + r")(?![^\W\d_])")
_LONGEST = 200  # characters of a name that are read for words
_ESCAPE = re.compile(r"_x([0-9A-Fa-f]{2,6})_")
_COPY = re.compile(r"_\d+_$")  # what Illustrator appends to the second of two equal ids
_HUMP = re.compile(r"(?<=[a-z])(?=[A-Z])")
_AUTOMATIC = re.compile(
    r"(?:g|svg|group|layer|path|use|shape|symbol|xmlid|svgid|clip|mask|frame|vector|object|stroke|surface|artboard|page|capa|ebene|calque)?"
    r"[-_ ]*+[\d._-]*+",  # possessive: looked at once
    re.IGNORECASE,
)


def kind_named(*names: str | None) -> StrokeKind | None:
    """The kind that these names of one element (or layer) give; None if they say nothing, or speak of what is no kind."""
    found = meaning(*names)
    return found if isinstance(found, StrokeKind) else None


def role_named(*names: str | None) -> str | None:
    """What else these names call a stroke: ground, root, shadow, leaves, hatching or paper; None for a kind, or nothing."""
    found = meaning(*names)
    return None if isinstance(found, StrokeKind) else found


def meaning(*names: str | None) -> StrokeKind | str | None:
    """The kind or role that the first name with one of our words gives."""
    return next((found for name in names if name and (found := _meaning(name[:_LONGEST])) is not None), None)


def is_automatic(name: str) -> bool:
    """Whether a program made this name up (`g1234`, `Layer_1`), not a person."""
    return _AUTOMATIC.fullmatch(name) is not None


def plain_name(name: str) -> str:
    """A name as its author typed it: Illustrator's `_x5F_` escapes and copy numbers undone."""
    if "_" not in name:
        return name.strip()
    return _ESCAPE.sub(_character, _COPY.sub("", name)).strip()


@lru_cache(maxsize=65536)
def _meaning(name: str) -> StrokeKind | str | None:
    words = re.sub(r"[\W_]+", " ", _HUMP.sub(" ", plain_name(name))).lower()
    found = _FIND.findall(words)
    return _MEANING[found[-1]] if found else None


def _character(match: re.Match) -> str:
    code = int(match[1], 16)
    return chr(code) if 31 < code < 0x110000 and not 0xD800 <= code < 0xE000 else match[0]
