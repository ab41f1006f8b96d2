"""How well is the foliage of a photo found? The paper's rule against ours, over skies and meadows, and on photos with masks made by hand.

`--photos DIR` holds `tuxpaint_tree336.png`, whose alpha is laid over six backgrounds painted here; `--cases DIR` holds photos' truth (`NAME.json`, `NAME.svg`, `NAME_mask.png`,
`NAME_mask_fine.png`). Overlap (intersection over union) is measured within the region that the crown's stroke opens. `--size N` also times the mask of the first photo at N pixels.
"""

import json
import time
from pathlib import Path

import click
import numpy as np
from PIL import Image
from scipy import ndimage

from sketchtree.errors import SketchTreeError
from sketchtree.keys import root_key
from sketchtree.photo.foliage_mask import foliage_mask
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo
from sketchtree.photo.read_photo import read_photo
from sketchtree.photo.read_strokes import read_strokes

STROKES = Path(__file__).parent / "data" / "photo_strokes"
RULES = ("paper", "contrast")


def backgrounds(width: int, height: int, rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Six skies and meadows, rows × columns × 3."""
    down = np.linspace(0, 1, height)[:, None, None] * np.ones((1, width, 1))

    def noise(sigma: float, strength: float) -> np.ndarray:
        field = ndimage.gaussian_filter(rng.normal(size=(height, width)), sigma)
        return (field / field.std() * strength)[..., None]

    def fading(*colours: tuple[int, int, int]) -> np.ndarray:
        places = np.linspace(0, 1, len(colours))
        return np.concatenate([np.interp(down, places, channel) for channel in zip(*colours, strict=True)], axis=2)

    cloud = np.clip(0.5 + noise(25, 0.5) + noise(8, 0.2), 0, 1)
    return {
        "clear sky": fading((52, 110, 200), (170, 205, 235)),
        "overcast": fading((225, 228, 232), (245, 245, 243)) + noise(30, 4),
        "sunset": fading((70, 70, 120), (235, 120, 60), (255, 210, 120)) + noise(25, 6),
        "meadow": fading((92, 132, 52), (120, 150, 60)) + noise(1.2, 14) + noise(8, 8) * [1, 1, 0.5],
        "dark forest": fading((20, 34, 18), (34, 44, 26)) + noise(3, 8) + noise(15, 6),
        "clouds": np.array([80, 135, 205]) * (1 - cloud) + np.array([240, 242, 246]) * cloud,
    }


def composites(photos: Path):
    """(name, photo, marks, truths) of the cut-out tree over each background."""
    cut = np.asarray(Image.open(photos / "tuxpaint_tree336.png").convert("RGBA")).astype(float)
    alpha, rng = cut[..., 3:] / 255, np.random.default_rng(7)
    for name, behind in backgrounds(cut.shape[1], cut.shape[0], rng).items():
        grain = rng.normal(0, 2, (*cut.shape[:2], 1))
        rgb = cut[..., :3] * alpha + np.clip(behind + grain, 0, 255) * (1 - alpha)
        photo = Photo(np.rint(rgb).astype(np.uint8), name=name)
        yield f"tree336, {name}", photo, read_strokes(STROKES / "tuxpaint_tree336.svg", photo)[0], {"alpha": alpha[..., 0] > 0.5}


def cases(folder: Path):
    """The same of photos with masks by hand; with the strokes beside them, and with ours where there are any."""
    for told in sorted(folder.glob("*.json")):
        photo = read_photo(folder / json.loads(told.read_text())["image"])
        truth = {kind: np.asarray(Image.open(told.with_name(f"{told.stem}_mask{end}.png")).convert("L")) > 127 for kind, end in (("coarse", ""), ("fine", "_fine"))}
        photo = Photo(photo.rgb, name=photo.name)
        for strokes in (told.with_suffix(".svg"), STROKES / f"{told.stem}.svg"):
            if strokes.exists():
                yield f"{told.stem}{', ours' if strokes.parent == STROKES else ''}", photo, read_strokes(strokes, photo)[0], truth


def overlap(mask: np.ndarray, truth: np.ndarray) -> float:
    """Intersection over union."""
    return float((mask & truth).sum() / max((mask | truth).sum(), 1))


def measured(photo: Photo, marked: Marked, truth: dict[str, np.ndarray], rule: str) -> tuple[str, dict[str, float]]:
    """(a cell of the table, overlap with each truth)."""
    begun = time.process_time()
    try:
        found = foliage_mask(photo, marked, key=root_key(0), rule=rule)
    except SketchTreeError as error:
        return str(error)[:40], dict.fromkeys(truth, 0.0)
    spent = time.process_time() - begun
    scores = {kind: overlap(found.mask, mask & found.region) for kind, mask in truth.items()}
    return "  ".join(f"{score:.3f}" for score in scores.values()) + f"  {spent:4.1f} s{' bare' if found.bare else ''}", scores


@click.command(help=__doc__)
@click.option("--photos", type=click.Path(path_type=Path, exists=True))
@click.option("--cases", "folder", type=click.Path(path_type=Path, exists=True))
@click.option("--size", type=int, help="Also time the first photo, brought to so many pixels.")
def main(photos: Path | None, folder: Path | None, size: int | None) -> None:
    """Print the table."""
    every = [*(composites(photos) if photos else ()), *(cases(folder) if folder else ())]
    click.echo(f"{'':32}{'truth':14}" + "".join(f"{rule:32}" for rule in RULES))
    for name, photo, marked, truth in every:
        click.echo(f"{name:32}{' '.join(truth):14}" + "".join(f"{measured(photo, marked, truth, rule)[0]:32}" for rule in RULES))
    if size and every:
        _, photo, marked, _ = max(every, key=lambda each: each[1].width)
        scale = size / max(photo.width, photo.height)
        large = Photo(np.asarray(Image.fromarray(photo.rgb).resize((round(photo.width * scale), round(photo.height * scale)), Image.Resampling.BICUBIC)), name=photo.name)
        for rule in RULES:
            begun = time.process_time()
            foliage_mask(large, Marked(marked.crown * scale, marked.branches), key=root_key(0), rule=rule)
            click.echo(f"{large.name} at {large.width} × {large.height}, {rule}: {time.process_time() - begun:.1f} s of CPU")


if __name__ == "__main__":
    main()
