"""Does a bare trunk show which tree it is? By how it branches, and by the colour of its bark: `python -m benchmarks.trunk_species --shared DIR`

Sugar maple, tulip tree and English elm (Levison 1914), and the birch before several backgrounds. A row each: which place the tree's own template (maple and elm: its genus) has among the broadleaves of the
database by footprint and branching, how probable the first is, and what that one is; then the lightness (L*) and the chroma of the photo within its trunk and within its limbs.
"""

import argparse
from pathlib import Path

import numpy as np
from scipy.ndimage import distance_transform_edt
from skimage.color import rgb2lab

from benchmarks.matting_cases import Case, birch_cases, given_cases, real_cases
from benchmarks.trunk_limbs import BIRCH
from sketchtree.keys import root_key, stage_key
from sketchtree.matting.matte import find_matte
from sketchtree.photo_choice import broadleaves
from sketchtree.templates.store.database import Database
from sketchtree.trunk.limbs import trunk_drawing
from sketchtree.trunk.skeletonise import trunk_skeleton

OWN = {"bare_sugar_maple": "norway_maple", "bare_tulip_tree": None, "bare_english_elm": "american_elm"}  # of the tulip tree there is no template; all others are birches
_THICK, _THIN = 0.6, 0.3  # of the widest place's width: from which a pixel is of the trunk, up to which of a limb


def row(case: Case, templates: Database) -> dict:
    """Everything about one picture."""
    matte = find_matte(case.photo, case.scribbles, key=stage_key(root_key(0), "matte")).alpha
    _, graph = trunk_drawing(trunk_skeleton(matte))
    found = broadleaves(graph, templates)
    own = OWN.get(case.name, "silver_birch")
    names = [one.name for one in found]
    inner = distance_transform_edt(matte >= 0.98)
    lab = rgb2lab(case.photo.rgb)
    trunk, limbs = lab[inner >= _THICK * inner.max()], lab[(inner >= 1) & (inner <= _THIN * inner.max())]
    seen = {f"{name} {what}": int(np.median(value)) for name, of in (("trunk", trunk), ("limbs", limbs)) for what, value in (("L*", of[:, 0]), ("chroma", np.hypot(*of[:, 1:].T)))}
    odds = np.exp([one.score - found[0].score for one in found])
    return {"limbs": len(graph.limb_id), "own": own, "place": names.index(own) + 1 if own else None, "first": names[0], "p": round(float(1 / odds.sum()), 2)} | seen


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--shared", type=Path, required=True)
    shared, templates = parser.parse_args().shared, Database.open()
    every = {case.name: case for case in (*birch_cases(shared), *given_cases(shared))}
    for case in (*real_cases(shared), *(every[name] for name in BIRCH)):
        print(case.name, row(case, templates), flush=True)


if __name__ == "__main__":
    main()
