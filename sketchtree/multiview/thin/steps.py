"""Which way does a twig run on? Step by step, all twigs at once, each in that of the directions near its course that photos show best, until they look past it or it comes to other wood."""

from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int

from sketchtree.multiview.compiled import compiled
from sketchtree.multiview.thin.contrasts import LEAST, SHARE, Contrasts, told
from sketchtree.multiview.thin.standing import Standing, beside, unit

STEP = 2.5  # pixels
TURNS = np.radians([10.0, 20.0])  # from the course, at a step
AROUND = 8  # directions at each
LONGEST = 120  # steps
DIM = 0.25  # of c of the step before: a step that is paler is the blur of an end
_NEXT = 0.7  # what the step after this one counts
_PAST, _NEXT_PAST = 0.3, 0.2  # what a photo costs that looks past them
_BENT = np.array([0.0] + [0.02] * AROUND + [0.08] * AROUND)  # of what is shown: so much a direction must be better than straight on


@dataclass(eq=False)
class Twigs:
    """Twigs that are followed."""

    row: Int[np.ndarray, " twig"]  # of the tree that each leaves
    own: Int[np.ndarray, " twig"]  # the limb that it carries on; NULL of one that begins
    place: Float[np.ndarray, "twig 3"]  # how far it has come
    course: Float[np.ndarray, "twig 3"]  # a unit vector
    way: list[list[np.ndarray]]  # places on the way of each, the first one where it leaves
    dark: list[list[float]] = field(default_factory=list)  # mean c of each step


def follow(twigs: Twigs, wood: Standing, photos: Contrasts, floor: float) -> None:
    """Go on until all have ended; what was found is in `way`, `dark` and `wood`. `floor`: no twig goes lower, metres."""
    step, alive = STEP * wood.pixel, np.arange(len(twigs.row))
    name = wood.owner.min(initial=0) - 1 - alive  # owners of what is added
    own = np.stack([name, twigs.own], axis=1)
    last = darkness(twigs.place - step * twigs.course, twigs.place, *photos)
    for _ in range(LONGEST):
        if not len(alive):
            break
        ways = cone(twigs.course[alive])
        score, dark = _tried(twigs.place[alive], ways, step, _BENT, *photos)
        best = score.argmax(axis=1)
        at = np.arange(len(alive))
        way = ways[at, best]
        to = twigs.place[alive] + step * way
        goes = np.isfinite(score[at, best]) & (dark[at, best] > DIM * last[alive]) & (to[:, 1] > floor) & ~wood.met(twigs.place[alive], to, way, own[alive])
        alive, to, way, dark = alive[goes], to[goes], way[goes], dark[at, best][goes]
        for k, place, c in zip(alive, to, dark, strict=True):
            twigs.way[k].append(place)
            twigs.dark[k].append(c)
        twigs.course[alive] = unit(twigs.course[alive] + way)
        twigs.place[alive], last[alive] = to, dark
        if len(alive):
            wood.more(to, name[alive], way)
    longer = [way for way in twigs.way if len(way) > 1]
    if longer:
        before, end = (np.array([way[k] for way in longer]) for k in (-2, -1))
        middle = 0.5 * (before + end)
        pale = darkness(middle, end, *photos) <= DIM * darkness(before, middle, *photos)
        for way, place in zip((way for way, ends in zip(longer, pale, strict=True) if ends), middle[pale], strict=True):
            way[-1] = place


def cone(course: Float[np.ndarray, "twig 3"]) -> Float[np.ndarray, "twig way 3"]:
    """Directions near each course, itself the first."""
    one, other = beside(course)
    ways = [course]
    for n, turn in enumerate(TURNS):
        for angle in (np.arange(AROUND) + 0.5 * n) * (2 * np.pi / AROUND):
            ways.append(np.cos(turn) * course + np.sin(turn) * (np.cos(angle) * one + np.sin(angle) * other))
    return np.stack(ways, axis=1)


@compiled
def darkness(start, end, to_pixel, contrast, sizes):
    """Mean c between two places of each twig, in the photos that show one there; 0 where there is none."""
    found = np.zeros(len(start))
    for k in range(len(start)):
        shows, past, much = told(start[k], end[k], to_pixel, contrast, sizes)
        if shows >= LEAST and past <= SHARE * (shows + past):
            found[k] = much / shows
    return found


@compiled
def _tried(place, ways, step, bent, to_pixel, contrast, sizes):
    """[twig way] (how well a step and the one after it are shown, −∞ where the step isn't; its mean c)."""
    count, many = ways.shape[0], ways.shape[1]
    score, dark = np.full((count, many), -np.inf), np.zeros((count, many))
    for k in range(count):
        for w in range(many):
            way = ways[k, w]
            end = place[k] + step * way
            shows, past, much = told(place[k], end, to_pixel, contrast, sizes)
            if shows >= LEAST and past <= SHARE * (shows + past):
                _, lost, more = told(end, end + step * way, to_pixel, contrast, sizes)
                score[k, w] = (much + _NEXT * more - _PAST * past - _NEXT_PAST * lost) * (1.0 - bent[w])
                dark[k, w] = much / shows
    return score, dark
