"""Is it a line drawing at all? A blank or a black page, a photograph, noise and a page of text are told from one.

    cover     part of the page that is ink. Lines and silhouettes leave most of it free
    between   part of the page, away from all ink, that is neither paper nor ink. A photograph is full of such tones
    grain     σ of the paper. What has little else to tell it from a silhouette, a photograph, has grain too
    marks     many lines and all of them short: letters, or a texture
"""

import numpy as np
from scipy.ndimage import maximum_filter

from sketchtree.errors import SketchError
from sketchtree.sketch.raster.ink import Ink
from sketchtree.sketch.raster.lines_of import Traced

BLACK = 0.8  # cover of a page that shows nothing but dark
GRAINY = 0.012  # grain of a photograph, at least
COVER = 0.26  # its cover …
BETWEEN = 0.018  # … or what lies between, at least
ROUGH, ROUGH_COVER = 0.04, 0.15  # grain and cover of one that shows bare twigs against the sky
TONES = (0.12, 0.5)  # d between paper and ink
BESIDE = (3, 12)  # pixels beside a line that its blur reaches, at least and at most
SHORT = 0.08  # of the drawing's size: length of a mark
MANY = 40  # marks

BLANK = "Draw the tree darker, or photograph it closer and in better light."
_PHOTO = "For a photograph of a tree use `sketchtree photo`; a drawing is read best as dark lines on plain paper, cropped to the page."


def no_ink(name: str) -> SketchError:
    """The error of a page on which nothing stands out."""
    return SketchError(f"{name} shows no lines: the page is blank, or its lines are as pale as the paper's grain.", remedy=BLANK)


def check_ink(ink: Ink, name: str) -> None:
    """Raise SketchError where the ink is no line drawing's."""
    cover = float(ink.mask.mean())
    if cover >= BLACK:
        raise SketchError(f"{name} is dark all over: no lines can be told in it.", remedy=BLANK)
    beside = maximum_filter(ink.mask, size=2 * int(np.clip(ink.pen, *BESIDE)) + 1)
    between = float(np.mean((ink.d > TONES[0]) & (ink.d < TONES[1]) & ~beside))
    grainy = ink.grain >= GRAINY and (cover >= COVER or between >= BETWEEN)
    if grainy or (ink.grain >= ROUGH and cover >= ROUGH_COVER) or between >= 3 * BETWEEN:
        raise SketchError(f"{name} looks like a photograph rather than a line drawing.", remedy=_PHOTO)


def check_lines(lines: list[Traced], dotted: int, specks: int, size: float, name: str) -> None:
    """Raise SketchError where there are no lines, or nothing but small marks. `size`: of all the ink, specks and all, its pixels."""
    if not lines and not dotted:
        raise SketchError(f"{name} shows no lines: only {specks:,} specks.", remedy=BLANK)
    if not dotted and len(lines) + specks >= MANY and max(line.length for line in lines) < SHORT * size:
        raise SketchError(
            f"{name} holds {len(lines) + specks:,} short marks and no long line: it looks like a page of text, or a texture.",
            remedy="Give a drawing of a tree, cropped to the tree.",
        )
