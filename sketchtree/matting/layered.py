"""Which pixels are tree, by the colours before and behind? Our own matting, the default: a tree is thin and all of its surroundings show beside it.

The matting Laplacian has only what is in a window of 3 × 3 to go by, and twigs end in between scribbles. Here every pixel is asked which part of it is tree (`opacity`), given

    before   the colours under the foreground scribbles, and one more: the same wood in any light, from black to twice as bright as half of it
    behind   what shows near by of what is no tree, as a local Gaussian and as shares of common colours (`behind`)

and what is behind is learnt again from what turned out to be no tree, in two ways:

    hopeful    a pixel is rather tree than not at first, and only what is all but surely none counts as behind: a twig that counted would hide itself and its neighbours
    cautious   a pixel is rather none, and more counts as behind: right where the surroundings have the wood's colours, which would be taken for it

In both, what lies between the edges of a limb that was marked, or is reached from a foreground scribble without crossing an edge (`reach`, `flanks`), is tree before anything is known, and no part of what is behind.
Where the colours tell the two apart, both find about as much tree, and the hopeful finds all of it; where they don't, it finds far more, and the cautious matte is kept. At last the
prior is lowered to how much tree is near by: what no colour decides is none, unless it is in the midst of tree. The matte is the expected alpha.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Bool, Float, Key
from scipy.ndimage import gaussian_filter

from sketchtree.keys import numpy_generator, stage_key
from sketchtree.matting.alpha import Matte
from sketchtree.matting.behind import look_behind
from sketchtree.matting.colours import Colours, fit_colours
from sketchtree.matting.opacity import mean, posterior
from sketchtree.matting.reach import held, marked
from sketchtree.matting.scribbles import Scribbles
from sketchtree.photo.photo import Photo
from sketchtree.watch import Pulse, no_pulse

ROUNDS = 2
FORE, COMMON = 3, 5  # components of either layer's colours
NEAR = 6.0  # pixels, σ of "near"
MOST = 0.9  # probability of tree where all near by is
LAST = (0.05, 0.02)  # of a pixel of which nothing is known: at first, at least
HELD = 0.98  # probability of tree in the midst of a marked limb
TELLS = 1.37  # times as much tree as the cautious finds, up to which the hopeful is believed
_SETTLED = 4  # rounds of the last prior
SHADED = 0.2  # share of wood in any light
_LIGHT, _TINT = 0.25, 0.03  # its spread along its colour, of that, and across
_SAMPLE = 6000  # pixels that common colours are fitted to


@dataclass(frozen=True)
class Manner:
    """How what is behind is learnt."""

    first: float  # probability that a pixel has tree in it, before anything is known
    least: float  # of that probability later
    surely: float  # power of the probability of no tree, as a pixel's weight in what is behind


HOPEFUL, CAUTIOUS = Manner(0.7, 0.2, 8.0), Manner(0.3, 0.05, 4.0)


def layered(photo: Photo, scribbles: Scribbles, *, key: Key[Array, ""], pulse: Pulse = no_pulse) -> Matte:
    """The matte by layers. Its course is the alpha that changed, of all alpha, in each round."""
    fore, back = scribbles.masks(photo)
    draw = numpy_generator(stage_key(key, "layered"))
    rgb = photo.rgb / 255.0
    before = _wood(fit_colours(rgb[fore], np.ones(fore.sum()), FORE, draw))
    common = fit_colours(rgb[back], np.ones(back.sum()), COMMON, draw)
    pulse()
    inside, beyond = marked(rgb, 1.0 - _first(rgb, before, common, 0.5), scribbles.foreground)
    limb = np.where(back, 0.0, np.maximum(inside, held(rgb, fore, back) * (1.0 - beyond)))
    hopeful, course = _rounds(rgb, fore, back, limb, before, common, HOPEFUL, draw, pulse)
    cautious, other = _rounds(rgb, fore, back, limb, before, common, CAUTIOUS, draw, pulse)
    hopeful, cautious = (_kept(np.maximum(one, inside), fore, back) for one in (hopeful, cautious))
    if hopeful.sum() <= TELLS * cautious.sum():
        return Matte(hopeful, "layered", course)
    told = "The surroundings have the wood's colours in places; what could be either was left out of the matte. More scribbles there, of both kinds, help."
    return Matte(cautious, "layered", other, (told,))


def _rounds(rgb, fore, back, limb, before: Colours, common: Colours, manner: Manner, draw, pulse: Pulse) -> tuple[Float[np.ndarray, "row column"], tuple[float, ...]]:
    """(alpha, the course) of one manner."""
    clear, wood = _first(rgb, before, common, manner.first), _raised(np.full(fore.shape, manner.first), limb)
    alpha, course = 1.0 - clear, []
    for turn in range(ROUNDS):
        pulse()
        weight = clear**manner.surely * (1.0 - limb)
        weight[back], weight[fore] = 1.0, 0.0
        if turn:
            common = _common_again(rgb, weight, back, draw)
        chance, prior = posterior(rgb, before, look_behind(rgb, weight, common, pulse=pulse), wood, pulse=pulse), wood
        clear = chance[0].astype(np.float64)
        wood = _raised(np.clip(_near(chance), manner.least, MOST), limb)
        found = _kept(mean(chance), fore, back)
        course.append(float(np.abs(found - alpha).sum() / max(found.sum(), 1e-9)))
        alpha = found
    return _kept(mean(_last(chance, prior, limb)), fore, back), tuple(course)


def _last(chance, prior, limb) -> Float[np.ndarray, "alpha row column"]:
    """The posterior with a prior that starts low, and rises where tree is near by."""
    wood = _raised(np.full(prior.shape, LAST[0]), limb)
    for _ in range(_SETTLED):
        lowered = chance * (wood / prior)
        lowered[0] = chance[0] * ((1 - wood) / (1 - prior))
        lowered /= lowered.sum(axis=0)
        wood = _raised(np.clip(_near(lowered), LAST[1], MOST), limb)
    return lowered


def _raised(wood, limb) -> Float[np.ndarray, "row column"]:
    """A prior that is `HELD` where a limb is held for sure."""
    return np.maximum(wood, HELD * limb)


def _near(chance) -> Float[np.ndarray, "row column"]:
    """How likely tree is near by: alphas next to 0 may be noise, and don't count."""
    return gaussian_filter(1.0 - chance[0] - chance[1], NEAR, mode="nearest").astype(np.float64)


def _kept(alpha, fore, back) -> Float[np.ndarray, "row column"]:
    """Alpha with the scribbles as they were drawn."""
    found = np.clip(alpha, 0.0, 1.0)
    found[fore], found[back] = 1.0, 0.0
    return found


def _wood(scribbled: Colours) -> Colours:
    """The scribbled colours, and their mean in any light."""
    tone = scribbled.weight @ scribbled.mean
    spread = np.outer(tone, tone) * _LIGHT**2 + np.eye(3) * _TINT**2
    return Colours(
        np.append(scribbled.weight * (1 - SHADED), SHADED),
        np.concatenate([scribbled.mean, 0.5 * tone[None]]),
        np.concatenate([scribbled.covariance, spread[None]]),
    )


def _first(rgb, before: Colours, common: Colours, first: float) -> Float[np.ndarray, "row column"]:
    """How surely a pixel is no tree by its colour alone."""
    colour = rgb.reshape(-1, 3)
    odds = before.log_density(colour) - common.log_density(colour) + np.log(first / (1 - first))
    return (1.0 / (1.0 + np.exp(np.clip(odds, -40, 40)))).reshape(rgb.shape[:2])


def _common_again(rgb, weight, back: Bool[np.ndarray, "row column"], draw: np.random.Generator) -> Colours:
    """The common colours of all that turned out to be behind."""
    colour = rgb.reshape(-1, 3)
    some = draw.choice(len(colour), min(_SAMPLE, len(colour)), replace=False)
    return fit_colours(np.concatenate([colour[some], rgb[back]]), np.concatenate([weight.ravel()[some], np.ones(back.sum())]) + 1e-9, COMMON, draw)
