"""Which pixels are foliage? Those inside the crown's stroke whose colour is a leaf's, neighbours agreeing where the picture is smooth.

Tan et al. 2008, §2, "Foliage extraction", the rule `paper`. The region closed by the stroke, expanded DILATIONS times, has a mixture of COMPONENTS Gaussians of colours; the four
most green or red are leaves (`greenness`), the others background. Of the labels β_x (0 leaf, 1 background) those of least energy (`cut`):

    Σ_x E_d(β_x) + Σ_(x,y) E_s(β_x, β_y)
    E_d = −β_x log G(I_x, θ^B) − (1 − β_x) log G(I_x, θ^F)
    E_s = λ / |I_x − I_y| where β_x ≠ β_y, else 0        |·| Euclidean, at least 1 of 255 (ours); λ = 60

Our rule `contrast` (the default; it measures better) does not ask for green or red: blossom, autumn leaves and a grey photo have another colour than what is around the crown, near
by (`surroundings`), and that is foliage (`foliage_colours`). E_d = −log P, with P the probability of either label, at least DOUBT; λ = 6. In a picture with alpha the alpha says it.
A tree is bare where what was found is lines rather than an area (`bareness`): then hedges and other trees that stand beside it are left out, and the mask is the area that the twigs
span, since twigs, and one day leaves, are there. Wood within the crown counts as foliage: leaves hide it or hang before it.

Pictures whose longer side is over FULL pixels are brought down by a whole factor meanwhile.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Array, Bool, Float, Key, UInt8
from PIL import Image
from scipy import ndimage

from sketchtree.errors import OptionError, SketchError
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.photo.appearance import Mixture, fit_mixture
from sketchtree.photo.bareness import looks_bare, spanned
from sketchtree.photo.cut import grid_links, least_energy
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.foliage_colours import TAIL, leaf_probability, learn_leaves, without_blur
from sketchtree.photo.greenness import LEAF_COMPONENTS, greenest, greenness
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo
from sketchtree.photo.pixels import Pixels
from sketchtree.photo.standing_out import LEAST, step_at_edge
from sketchtree.photo.surroundings import Surroundings, learn_surroundings, rarely_around, ring_around

Rule = Literal["contrast", "paper"]
COMPONENTS = 10
DILATIONS = 10
SLACK = 10 / 1500  # of the longer side: how far outside the stroke foliage may lie (`contrast`)
SMOOTHNESS = {"paper": 60.0, "contrast": 6.0}  # λ
DOUBT = 0.02
FULL = 1200  # pixels: what is finer is grain; 1500 take less than a second
_FEW = 0.08  # share of what the stroke surrounds that must be rare around it: the barest tree (severely pruned, a fifth) has far more, open sky TAIL
_OWN = 0.33  # share of the crown with no other trees beside it that is enough to tell whether it is bare
_LEAST = 0.01  # share of the region that must be foliage
_PALE = 0.02  # score of the greenest component that is hardly green or red
_GREEN = 0.06  # score of a colour that may be a leaf's
_SAMPLE = 20_000


@dataclass(frozen=True, eq=False)
class _Found:
    """What a rule says of a region."""

    mask: Bool[np.ndarray, "row column"]
    leaf: Mixture | None = None
    background: Mixture | None = None
    warnings: tuple[str, ...] = ()
    bare: bool = False


def foliage_mask(photo: Photo, marked: Marked, *, key: Key[Array, ""], rule: Rule = "contrast", bare: bool | None = None) -> Foliage:
    """The foliage of one tree. `bare`: whether it has no leaves, where that is known (rule `contrast`). Raises SketchError where the crown's stroke holds none."""
    if rule not in SMOOTHNESS:
        raise OptionError(f"There is no rule of foliage '{rule}'.", remedy=f"Say one of: {', '.join(SMOOTHNESS)}.")
    factor = max(1, -(-max(photo.width, photo.height) // FULL))
    rgb = np.asarray(Image.fromarray(photo.rgb).reduce(factor)) if factor > 1 else photo.rgb
    inside = within(marked.crown / factor, rgb.shape[:2])
    if not inside.any():
        raise SketchError("it holds no pixel of the photo.", stroke=marked.crown_name, remedy="Draw it round the tree's crown.")
    region = ndimage.binary_dilation(inside, iterations=DILATIONS if rule == "paper" else max(round(SLACK * max(inside.shape)), 2))
    if rule == "paper":
        found = _by_colour(rgb, inside, region, marked, key=key)
    elif photo.alpha is not None:
        found = _by_alpha(_reduced(photo.alpha, factor) >= 128, inside, region, bare)
    else:
        found = _by_contrast(rgb, inside, region, marked, bare, key=key)
    _check(found.mask, region, marked)
    leaf, background = _mixtures(found, rgb, region, key=key)
    mask = spanned(found.mask, inside) & region if found.bare else found.mask
    return Foliage(_enlarged(mask, factor, photo), _enlarged(region, factor, photo), leaf, background, found.warnings, found.bare)


def within(outline: Float[np.ndarray, "point 2"], shape: tuple[int, int]) -> Bool[np.ndarray, "row column"]:
    """The pixels whose middles a closed line surrounds."""
    turns = np.zeros((shape[0], shape[1] + 1), bool)
    for (x0, y0), (x1, y1) in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        first, last = (int(np.clip(np.ceil(y - 0.5), 0, shape[0])) for y in sorted((y0, y1)))
        rows = np.arange(first, last)  # whose middles the side passes
        crossing = x0 + (rows + 0.5 - y0) * (x1 - x0) / (y1 - y0) if len(rows) else rows
        turns[rows, np.clip(np.ceil(crossing - 0.5), 0, shape[1]).astype(np.int64)] ^= True
    return np.logical_xor.accumulate(turns, axis=1)[:, :-1]


def _by_colour(rgb, inside, region, marked: Marked, *, key: Key[Array, ""]) -> _Found:
    """The paper's rule."""
    pixels = Pixels.of(rgb, region)
    mixture = fit_mixture(pixels.colours(), COMPONENTS, key=stage_key(key, "colours"))
    chosen = greenest(mixture.mean)
    others = np.setdiff1d(np.arange(len(mixture)), chosen)
    if not len(others):
        raise _nothing(marked, "its pixels have hardly more than one colour")
    leaf, background = mixture.only(chosen), mixture.only(others)
    zero, one = -leaf.log_density(pixels.colour)[pixels.which], -background.log_density(pixels.colour)[pixels.which]
    hardly = greenness(mixture.mean[chosen[0]]) < _PALE
    told = ("Nothing inside the crown's stroke is green or red; the darkest colours were taken for leaves.",) if hardly else ()
    return _Found(_cut(rgb, region, zero, one, SMOOTHNESS["paper"]), leaf, background, told)


def _by_alpha(opaque: Bool[np.ndarray, "row column"], inside, region, bare: bool | None) -> _Found:
    """What a picture that was cut out says itself."""
    mask = region & opaque
    return _Found(mask, bare=looks_bare(mask, inside) if bare is None else bare)


def _by_contrast(rgb, inside, region, marked: Marked, bare: bool | None, *, key: Key[Array, ""]) -> _Found:
    """Our rule."""
    size = float(np.sqrt(inside.sum()))
    ring_mask = ring_around(region, size)
    if ring_mask.sum() < 0.02 * region.sum():
        told = "The crown's stroke leaves nothing of the photo around it to compare with; foliage was told by its green or red alone."
        found = _by_colour(rgb, inside, region, marked, key=key)
        return _Found(found.mask, found.leaf, found.background, (told, *found.warnings))
    pixels, ring, own = Pixels.of(rgb | np.uint8(1), region), Pixels.of(rgb, ring_mask), Pixels.of(rgb, inside)  # two levels of 255 are one: an eighth of the colours
    drawn = numpy_generator(stage_key(key, "sample"))
    own, near = own.some(np.sort(drawn.permutation(len(own))[:_SAMPLE])), ring.some(np.sort(drawn.permutation(len(ring))[:_SAMPLE]))
    around = learn_surroundings(own, near, region.shape, size, key=stage_key(key, "around"))
    rare = rarely_around(around, own, near, TAIL)
    if around.leafy.all() or len(rare) < _FEW * len(own):
        if around.leafy.any() or greenness(np.median(own.colours(), axis=0)) > _GREEN:
            return _Found(region.copy(), warnings=("The crown has the colours of what is around it: all that its stroke surrounds was taken for foliage.",))
        raise _nothing(marked, "it has the colours of what is around it, and none of them is a leaf's")
    def mask_before(background: Surroundings, rare) -> Bool[np.ndarray, "row column"]:
        leaf, share = learn_leaves(own.colours(), background.log_density(own), rare, key=stage_key(key, "leaves"))
        leaf_density = without_blur(leaf, background.common()).log_density(pixels.colour)[pixels.which]
        sure = np.clip(leaf_probability(leaf_density, background.log_density(pixels), share), DOUBT, 1 - DOUBT)
        return _cut(rgb, region, -np.log(sure), -np.log1p(-sure), SMOOTHNESS["contrast"])

    mask, (neighbours, theirs) = mask_before(around, rare), around.with_neighbours(region.shape)
    own_place = inside & ~theirs
    bare = looks_bare(mask, own_place if own_place.sum() > _OWN * inside.sum() else inside) if bare is None else bare
    rare = rarely_around(neighbours, own, near, TAIL) if bare and (region & theirs).any() else []
    mask = mask_before(neighbours, rare) if len(rare) >= _FEW * len(own) else mask
    return _Found(mask, warnings=() if bare else _doubts(rgb, mask, region, marked), bare=bare)


def _doubts(rgb, mask, region, marked: Marked) -> tuple[str, ...]:
    """What to tell of foliage that hardly stands out; what has no leaf's colour either is none. Raises SketchError."""
    if not mask.any() or step_at_edge(rgb, mask, float(np.sqrt(region.sum()))) >= LEAST:
        return ()
    if greenness(np.median(rgb[mask], axis=0)) < _GREEN:
        raise _nothing(marked, "it goes on beyond the stroke as it is within, like sky or ground")
    return ("What the crown's stroke surrounds hardly stands out from what is around it; it was taken for foliage.",)


def _cut(rgb: UInt8[np.ndarray, "row column 3"], region, zero, one, smoothness: float) -> Bool[np.ndarray, "row column"]:
    """The pixels of a region whose label is 0."""
    colour = rgb.astype(np.float32)
    links = grid_links(contrast_weight(colour[:, 1:], colour[:, :-1], smoothness), contrast_weight(colour[1:], colour[:-1], smoothness), region)
    mask = np.zeros(region.shape, bool)
    mask[region] = ~least_energy(zero, one, links)
    return mask


def contrast_weight(colour: Float[np.ndarray, "*pair 3"], other: Float[np.ndarray, "*pair 3"], smoothness: float) -> Float[np.ndarray, "*pair"]:
    """λ / |I_x − I_y|, the difference at least 1."""
    return smoothness / np.maximum(np.sqrt(((colour - other) ** 2).sum(axis=-1)), 1.0)


def _check(mask, region, marked: Marked) -> None:
    if mask.sum() < _LEAST * region.sum():
        raise _nothing(marked, f"only {mask.sum()} of its {region.sum()} pixels look like leaves")


def _nothing(marked: Marked, why: str) -> SketchError:
    return SketchError(f"there is no foliage inside it: {why}.", stroke=marked.crown_name, remedy="Draw it round the crown of a tree, or give a photo that shows one.")


def _mixtures(found: _Found, rgb, region, *, key: Key[Array, ""]) -> tuple[Mixture, Mixture]:
    """θ^F and θ^B of what was found."""
    if found.leaf is not None and found.background is not None:
        return found.leaf, found.background
    rest = region & ~found.mask
    if rest.sum() < 64:
        rest = ring_around(region, float(np.sqrt(region.sum())))
    rest = rest if rest.sum() >= 64 else ~found.mask if (~found.mask).sum() >= 2 else region
    leaf = fit_mixture(rgb[found.mask], LEAF_COMPONENTS, key=stage_key(key, "leaf"))
    return leaf, fit_mixture(rgb[rest], COMPONENTS - LEAF_COMPONENTS, key=stage_key(key, "background"))


def _reduced(alpha: UInt8[np.ndarray, "row column"], factor: int) -> UInt8[np.ndarray, "row column"]:
    return np.asarray(Image.fromarray(alpha).reduce(factor)) if factor > 1 else alpha


def _enlarged(mask: Bool[np.ndarray, "row column"], factor: int, photo: Photo) -> Bool[np.ndarray, "row column"]:
    return np.repeat(np.repeat(mask, factor, axis=0), factor, axis=1)[: photo.height, : photo.width] if factor > 1 else mask
