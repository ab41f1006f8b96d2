"""Which pixels are tree, by the colours before and behind? Our own matting, the default: a tree is thin and all of its surroundings show beside it.

The matting Laplacian has only what is in a window of 3 × 3 to go by, and twigs end in between scribbles. Here every pixel is asked which part of it is tree (`opacity`), given

    before   the colours under the foreground scribbles, and one more: the same wood in any light, from black to twice as bright as half of it
    behind   what shows near by of what is no tree, as a local Gaussian and as shares of common colours (`behind`)

and what is behind is learnt again from what turned out to be no tree. Only pixels that are so all but surely count, since a twig that counts as background hides itself and its
neighbours in the next round; for the same reason a pixel is held more likely tree than not at first. The matte is the expected alpha.
"""

import numpy as np
from jaxtyping import Array, Bool, Float, Key
from scipy.ndimage import gaussian_filter

from sketchtree.keys import numpy_generator, stage_key
from sketchtree.matting.alpha import Matte
from sketchtree.matting.behind import look_behind
from sketchtree.matting.colours import Colours, fit_colours
from sketchtree.matting.opacity import mean, posterior
from sketchtree.matting.scribbles import Scribbles
from sketchtree.photo.photo import Photo

ROUNDS = 2
FORE, COMMON = 3, 5  # components of either layer's colours
FIRST = 0.7  # probability that a pixel has tree in it, before anything is known
RANGE = (0.2, 0.9)  # of that probability later, by how much tree is near
NEAR = 6.0  # pixels, σ of "near"
SURELY = 8  # power of the probability of no tree, as a pixel's weight in what is behind
SHADED = 0.2  # share of wood in any light
_LIGHT, _TINT = 0.25, 0.03  # its spread along its colour, of that, and across
_SAMPLE = 6000  # pixels that common colours are fitted to


def layered(photo: Photo, scribbles: Scribbles, *, key: Key[Array, ""]) -> Matte:
    """The matte by layers. Its course is the sum of alpha that changed, of all alpha, in each round."""
    fore, back = scribbles.masks(photo)
    draw = numpy_generator(stage_key(key, "layered"))
    rgb = photo.rgb / 255.0
    before = _wood(fit_colours(rgb[fore], np.ones(fore.sum()), FORE, draw))
    common = fit_colours(rgb[back], np.ones(back.sum()), COMMON, draw)
    clear, wood = _first(rgb, before, common), np.full(fore.shape, FIRST)
    alpha, course = 1.0 - clear, []
    for turn in range(ROUNDS):
        weight = clear**SURELY
        weight[back], weight[fore] = 1.0, 0.0
        if turn:
            common = _common_again(rgb, weight, back, draw)
        chance = posterior(rgb, before, look_behind(rgb, weight, common), wood)
        clear = chance[0].astype(np.float64)
        wood = np.clip(gaussian_filter(1.0 - clear - chance[1], NEAR, mode="nearest"), *RANGE)
        found = np.clip(mean(chance), 0.0, 1.0)
        found[fore], found[back] = 1.0, 0.0
        course.append(float(np.abs(found - alpha).sum() / max(found.sum(), 1e-9)))
        alpha = found
    return Matte(alpha, "layered", tuple(course))


def _wood(scribbled: Colours) -> Colours:
    """The scribbled colours, and their mean in any light."""
    tone = scribbled.weight @ scribbled.mean
    spread = np.outer(tone, tone) * _LIGHT**2 + np.eye(3) * _TINT**2
    return Colours(
        np.append(scribbled.weight * (1 - SHADED), SHADED),
        np.concatenate([scribbled.mean, 0.5 * tone[None]]),
        np.concatenate([scribbled.covariance, spread[None]]),
    )


def _first(rgb, before: Colours, common: Colours) -> Float[np.ndarray, "row column"]:
    """How surely a pixel is no tree by its colour alone."""
    colour = rgb.reshape(-1, 3)
    odds = before.log_density(colour) - common.log_density(colour) + np.log(FIRST / (1 - FIRST))
    return (1.0 / (1.0 + np.exp(np.clip(odds, -40, 40)))).reshape(rgb.shape[:2])


def _common_again(rgb, weight, back: Bool[np.ndarray, "row column"], draw: np.random.Generator) -> Colours:
    """The common colours of all that turned out to be behind."""
    colour = rgb.reshape(-1, 3)
    some = draw.choice(len(colour), min(_SAMPLE, len(colour)), replace=False)
    return fit_colours(np.concatenate([colour[some], rgb[back]]), np.concatenate([weight.ravel()[some], np.ones(back.sum())]) + 1e-9, COMMON, draw)
