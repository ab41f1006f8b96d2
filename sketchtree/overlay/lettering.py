"""How is a formula written in a picture whose font has no Greek? The few letters that formulas need are drawn as lines.

The font that comes with Pillow holds Latin letters only, and another machine may have no other. In an SVG a formula is plain text.
Letters are polylines in units of the text's size, y up from the base line, with the pen's advance.
"""

import re

import numpy as np
from PIL import ImageFont

from sketchtree.overlay.scene import Path, Words

_TURN = np.linspace(0.0, 2 * np.pi, 17)
_RING = np.stack([np.cos(_TURN), np.sin(_TURN)], 1)
_LETTER = {  # letter → advance, polylines
    "Θ": (0.80, [_RING * (0.31, 0.36) + (0.38, 0.35), [(0.22, 0.35), (0.54, 0.35)]]),
    "κ": (0.47, [[(0.09, 0.49), (0.09, 0)], [(0.41, 0.49), (0.09, 0.2)], [(0.2, 0.3), (0.43, 0)]]),
    "λ": (0.48, [[(0.04, 0.69), (0.13, 0.7), (0.18, 0.63), (0.4, 0.04), (0.45, 0)], [(0.26, 0.42), (0.05, 0)]]),
    "μ": (0.58, [[(0.06, -0.2), (0.1, 0.49)], [(0.08, 0.15), (0.12, 0.04), (0.22, 0), (0.33, 0.05), (0.4, 0.17), (0.42, 0.49)], [(0.4, 0.17), (0.42, 0.03), (0.5, 0)]]),
    "ρ": (0.56, [_RING * (0.21, 0.245) + (0.29, 0.245), [(0.08, 0.24), (0.05, -0.2)]]),
    "σ": (0.60, [_RING * (0.21, 0.235) + (0.27, 0.235), [(0.27, 0.47), (0.56, 0.47)]]),
    "ς": (0.48, [[(0.43, 0.42), (0.3, 0.49), (0.15, 0.43), (0.07, 0.27), (0.12, 0.12), (0.24, 0.05), (0.36, 0), (0.38, -0.09), (0.3, -0.17), (0.22, -0.17)]]),
    "τ": (0.48, [[(0.03, 0.42), (0.08, 0.47), (0.44, 0.47)], [(0.25, 0.47), (0.22, 0.1), (0.26, 0.01), (0.36, 0.02)]]),
    "ψ": (0.66, [[(0.33, 0.67), (0.3, -0.2)], [(0.06, 0.49), (0.08, 0.2), (0.17, 0.05), (0.31, 0), (0.46, 0.05), (0.55, 0.2), (0.58, 0.49)]]),
    "−": (0.62, [[(0.09, 0.27), (0.52, 0.27)]]),
}  # fmt: skip
_OWN, _INDEX = "".join(_LETTER) + "½²", "_[a-z](?![a-z_])"
_TOKEN = re.compile(rf"[{_OWN}]|{_INDEX}|(?:(?!{_INDEX})[^{_OWN}])+")
SPACE = 0.29  # between words, of the text's size
_SMALL = {"²": ("2", 0.36)}  # drawn small: what, and how far above the base line


def lettered(words: Words) -> list[Path | Words]:
    """The same line of text, starting at its left end, with mathematical letters as lines and `_o` as an index."""
    x, marks = words.x, []
    for token in _TOKEN.findall(words.text):
        if token in _LETTER:
            advance, lines = _LETTER[token]
            marks += [_stroke(words, x, line) for line in lines]
            x += advance * words.size
        elif token == "½":
            marks += [_small(words, x, "1", 0.34), _small(words, x + 0.4 * words.size, "2", -0.04), _stroke(words, x, [(0.16, -0.05), (0.6, 0.74)])]
            x += 0.86 * words.size
        elif token in _SMALL or (len(token) == 2 and token[0] == "_"):
            text, rise = _SMALL.get(token, (token[-1], -0.16))
            marks.append(_small(words, x, text, rise))
            x += _advance(text, 0.66 * words.size) + 0.04 * words.size
        else:
            for k, word in enumerate(token.split(" ")):
                x += SPACE * words.size if k else 0.0
                marks += [Words(x, words.y, word, words.size, words.colour, bold=words.bold)] if word else []
                x += _advance(word, words.size)
    return marks


def _stroke(words: Words, x: float, line) -> Path:
    points = np.asarray(line, float) * words.size * (1, -1) + (x, words.y)
    return Path(points, words.colour, words.size * (0.1 if words.bold else 0.075))


def _small(words: Words, x: float, text: str, rise: float) -> Words:
    return Words(x, words.y - rise * words.size, text, 0.66 * words.size, words.colour, bold=words.bold)


def _advance(text: str, size: float) -> float:
    return float(ImageFont.load_default(size).getlength(text))
