"""What is matting measured on? Trees with a known alpha before backgrounds that code makes, and photos that are given.

`drawn_tree` is ours: limbs that fork, drawn with soft edges. The birch (Tux Paint, GPL) and photos behind it come from a folder that is not part of the project.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.ndimage import gaussian_filter

from sketchtree.matting.scribbles import Scribbles, read_scribbles
from sketchtree.photo.photo import Photo

SCRIBBLES = Path(__file__).parent / "data" / "matting_scribbles"
SETS = ("few", "usual", "many")
_BEHIND = {"leafy": "leafy_american_elm.jpg", "house": "severely_pruned_tree.jpg", "orchard": "pair_nectarine_6_4_14.jpg", "cherry": "wild_cherry_colour.jpg"}


@dataclass(frozen=True, eq=False)
class Case:
    """One photo with scribbles, and its truth where there is one."""

    name: str
    photo: Photo
    scribbles: Scribbles
    truth: np.ndarray | None


def made_backgrounds(rows: int, columns: int) -> dict[str, np.ndarray]:
    """Flat, gradient, clouds, grass and brick, of values 0 to 1."""
    draw = np.random.default_rng(0)

    def noise(sigma: float) -> np.ndarray:
        field = gaussian_filter(draw.normal(size=(rows, columns)), sigma)
        return (field / field.std())[..., None]

    down = np.broadcast_to(np.linspace(0, 1, rows)[:, None, None], (rows, columns, 1))
    rough = noise(1.0) * 0.08 + noise(3.0) * 0.06
    tiles = ((np.indices((rows, columns)).sum(axis=0) // 6) % 2)[..., None] * 0.08
    whole = np.ones((rows, columns, 3))
    found = {
        "flat white": whole * 0.95,
        "flat blue": whole * [0.4, 0.6, 0.9],
        "sky": (1 - down) * [0.25, 0.45, 0.85] + down * [0.85, 0.9, 0.97],
        "sunset": (1 - down) * [0.3, 0.3, 0.55] + down * [0.98, 0.6, 0.3],
        "grass": np.array([0.35, 0.5, 0.2]) + rough * [1, 1.1, 0.6],
        "meadow": down * [0.4, 0.6, 0.25] + (1 - down) * [0.7, 0.8, 0.5] + rough * 0.6,
        "clouds": np.array([0.45, 0.62, 0.88]) + np.clip(noise(14.0), 0, 3) * 0.2,
        "brick": np.array([0.6, 0.35, 0.28]) + tiles + noise(0.7) * 0.03,
    }
    return {name: np.clip(values, 0, 1) for name, values in found.items()}


def before(fore: np.ndarray, alpha: np.ndarray, back: np.ndarray, name: str) -> Photo:
    """A tree of colours and alpha before a background, as a photo of eight bits."""
    mixed = alpha[..., None] * fore + (1 - alpha[..., None]) * back
    return Photo(np.clip(np.round(255 * mixed), 0, 255).astype(np.uint8), None, name)


def drawn_tree(rows: int = 160, columns: int = 120, *, finer: int = 4) -> tuple[np.ndarray, np.ndarray, Scribbles]:
    """(colours, alpha, scribbles) of a tree of ours: trunk, limbs and twigs that fork at fixed angles, bark lighter on one side."""
    draw = np.random.default_rng(3)
    limbs: list[tuple[np.ndarray, np.ndarray, float, float]] = []

    def grow(start: np.ndarray, turn: float, length: float, width: float, level: int) -> None:
        end = start + length * np.array([np.sin(turn), -np.cos(turn)])
        limbs.append((start, end, width, 0.72 * width))
        if level < 6:
            for side in (-1, 1):
                grow(end, turn + side * draw.uniform(0.22, 0.62), length * draw.uniform(0.66, 0.86), width * 0.66, level + 1)

    grow(np.array([0.5 * columns, rows + 2.0]), 0.0, 0.3 * rows, 4.2, 0)
    y, x = (np.mgrid[: rows * finer, : columns * finer] + 0.5) / finer
    inside, light = np.zeros(x.shape, bool), np.zeros(x.shape)
    for start, end, thick, thin in limbs:
        along = end - start
        at = np.clip(((x - start[0]) * along[0] + (y - start[1]) * along[1]) / (along @ along), 0, 1)
        half = thick + (thin - thick) * at
        beside = x - start[0] - at * along[0]
        own = np.hypot(beside, y - start[1] - at * along[1]) <= half
        light = np.where(own & ~inside, beside / np.maximum(half, 1e-9), light)
        inside |= own
    alpha = inside.reshape(rows, finer, columns, finer).mean(axis=(1, 3))
    weight = np.maximum(alpha, 1e-9)
    shade = 0.24 + 0.1 * (light * inside).reshape(rows, finer, columns, finer).mean(axis=(1, 3)) / weight
    fore = np.clip(shade, 0.05, 1)[..., None] * np.array([1.0, 0.86, 0.74])
    return fore, alpha, _scribbles_on(limbs, rows, columns)


def _scribbles_on(limbs, rows: int, columns: int) -> Scribbles:
    trunk = np.array([limbs[0][0] - [0, 6], limbs[0][1]])
    limb = np.array([limbs[1][0], 0.4 * limbs[1][0] + 0.6 * limbs[1][1]])
    beside = ([[4, 6], [0.3 * columns, 4]], [[0.9 * columns, 5], [0.96 * columns, 0.3 * rows]], [[6, 0.8 * rows], [0.3 * columns, 0.92 * rows]])
    return Scribbles((trunk, limb), tuple(np.array(line) for line in (*beside, [[0.7 * columns, 0.95 * rows], [0.94 * columns, 0.8 * rows]])), 2.0, "drawn")


def drawn_cases() -> list[Case]:
    """Our own tree before every background that code makes."""
    fore, alpha, scribbles = drawn_tree()
    return [Case(f"drawn, {name}", before(fore, alpha, back, name), scribbles, alpha) for name, back in made_backgrounds(*alpha.shape).items()]


def birch_cases(shared: Path) -> list[Case]:
    """The birch before twelve backgrounds, each with three sets of scribbles."""
    picture = np.asarray(Image.open(shared / "photos" / "tuxpaint_birch.png").convert("LA")).astype(float) / 255
    fore, alpha = np.repeat(picture[..., :1], 3, axis=2), picture[..., 1]
    backs = made_backgrounds(*alpha.shape) | {name: _cropped(shared / "photos" / file, alpha.shape) for name, file in _BEHIND.items()}
    backs["house"] = 0.4 + 0.6 * backs["house"]
    cases = []
    for name, back in backs.items():
        photo = before(fore, alpha, back, name)
        cases += [Case(f"{name}, {few}", photo, read_scribbles(SCRIBBLES / f"birch_{few}.json", photo), alpha) for few in SETS]
    return cases


def given_cases(shared: Path) -> list[Case]:
    """The three composites of `matting_cases`, with their own scribbles."""
    from sketchtree.photo.read_photo import read_photo

    found = []
    for name in ("birch_sky", "birch_photo", "birch_grass"):
        photo = read_photo(shared / "matting_cases" / f"{name}.png")
        truth = np.asarray(Image.open(shared / "matting_cases" / f"{name}_alpha.png").convert("L")) / 255
        found.append(Case(name, photo, read_scribbles(shared / "matting_cases" / f"{name}.json", photo), truth))
    return found


def real_cases(shared: Path) -> list[Case]:
    """Photos of bare trees with scribbles of ours; nobody knows the truth."""
    from sketchtree.photo.read_photo import read_photo

    photos = {name: read_photo(shared / "photos" / f"{name}.jpg") for name in ("bare_sugar_maple", "bare_tulip_tree", "bare_english_elm")}
    return [Case(name, photo, read_scribbles(SCRIBBLES / f"{name}.json", photo), None) for name, photo in photos.items()]


def _cropped(path: Path, shape: tuple[int, int]) -> np.ndarray:
    image = Image.open(path).convert("RGB")
    scale = max(shape[1] / image.width, shape[0] / image.height)
    return np.asarray(image.resize((int(image.width * scale) + 1, int(image.height * scale) + 1)))[: shape[0], : shape[1]] / 255.0
