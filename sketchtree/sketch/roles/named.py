"""What do a stroke's own names say that it is? Layer and id, for what is neither branch, crown nor obstacle.

    ground    ground, soil, earth, grass, horizon, floor      shadow    shadow, shade
    leaves    leaf, leaves, blossom, flower, fruit            root      root, rootstock
    hatching  hatch, hatching, shading, texture               paper     paper, background, underlay, reference, frame, note
"""

import re

from sketchtree.sketch.strokes import Stroke

_WORDS = {
    "ground": "ground|soil|earth|grass|horizon|floor",
    "shadow": "shadow|shade",
    "leaves": "leaf|leave|blossom|flower|fruit",
    "root": "root|rootstock",
    "hatching": "hatch|hatche|hatching|shading|texture",
    "paper": "paper|background|underlay|reference|frame|note",
}
_PATTERN = {role: re.compile(rf"(?<![a-z])(?:{words})s?(?![a-z])") for role, words in _WORDS.items()}


def role_in_names(stroke: Stroke) -> str | None:
    """ground | shadow | leaves | root | hatching | paper, or None where the names say nothing of the kind.

    The layer's name is asked first; the id is the stroke's own and wins.
    """
    for name in (stroke.id, stroke.layer):
        found = role_in_name(name)
        if found:
            return found
    return None


def role_in_name(name: str | None) -> str | None:
    """The same for one name."""
    if not name:
        return None
    name = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).lower()
    return next((role for role, pattern in _PATTERN.items() if pattern.search(name)), None)
