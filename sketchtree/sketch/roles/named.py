"""What do a stroke's own names say that it is? Layer and id, for what is neither branch, crown nor obstacle.

    ground    ground, soil, earth, grass, horizon, floor      shadow    shadow, shade
    leaves    leaf, leaves, blossom, flower, fruit            root      root, rootstock
    hatching  hatch, hatching, shading, texture               paper     paper, background, underlay, reference, frame, note
"""

import re
from functools import lru_cache

from sketchtree.sketch.strokes import Stroke

_WORDS = {
    "ground": "ground|soil|earth|grass|horizon|floor",
    "shadow": "shadow|shade",
    "leaves": "leaf|leave|blossom|flower|fruit",
    "root": "root|rootstock",
    "hatching": "hatch|hatche|hatching|shading|texture",
    "paper": "paper|background|underlay|reference|frame|note",
}
_PATTERN = re.compile("|".join(f"(?<![a-z])(?P<{role}>{words})s?(?![a-z])" for role, words in _WORDS.items()))
_HUMP = re.compile(r"(?<=[a-z])(?=[A-Z])")


def role_in_names(stroke: Stroke) -> str | None:
    """ground | shadow | leaves | root | hatching | paper, or None where the names say nothing of the kind.

    The layer's name is asked first; the id is the stroke's own and wins.
    """
    for name in (stroke.id, stroke.layer):
        found = role_in_name(name)
        if found:
            return found
    return None


@lru_cache(maxsize=4096)
def role_in_name(name: str | None) -> str | None:
    """The same for one name."""
    match = _PATTERN.search(_HUMP.sub(" ", name).lower()) if name else None
    return match.lastgroup if match else None
