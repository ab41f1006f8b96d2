"""How near to the truth is a matte? Closed form, the paper's normalised matting and ours, on the same photos and scribbles.

    python -m benchmarks.matting [--shared DIR] [--methods NAME,...] [--only WORD] [--json FILE] [--sheet PNG]

SAD is the sum of absolute differences over the sum of the true alpha (an empty matte has 1), MSE the mean squared one, the objective Eq. 3's αᵀLα / αᵀDα. Without --shared only our
own drawn tree is measured. `--sheet` is the paper's Figure 2: photo and scribbles | closed form | normalised | ours | truth, and below the course of the normalised objective.
"""

import argparse
import json
import time
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from benchmarks.matting_cases import Case, birch_cases, drawn_cases, given_cases, real_cases
from sketchtree.keys import root_key
from sketchtree.matting.alpha import Matte
from sketchtree.matting.closed_form import normalised_objective
from sketchtree.matting.laplacian import laplacian
from sketchtree.matting.matte import MATTINGS, find_matte

ORDER = ("closed-form", "normalised", "layered")
BAR = 0.9  # of closed form's SAD


def measured(case: Case, methods) -> tuple[dict, dict[str, Matte]]:
    """(a row of the table, the mattes)."""
    matrix, row, mattes = laplacian(case.photo.rgb / 255.0), {"case": case.name}, {}
    for method in methods:
        begun = time.perf_counter()
        matte = find_matte(case.photo, case.scribbles, method=method, key=root_key(0))
        seconds = time.perf_counter() - begun
        mattes[method] = matte
        row[method] = {"seconds": round(seconds, 2), "objective": normalised_objective(matrix, matte.alpha), "falls": bool((np.diff(matte.course) <= 0).all())}
        flat = matte.alpha.ravel().astype(np.float64)
        row[method]["energy"] = float(flat @ (matrix @ flat))
        if case.truth is not None:
            row[method] |= {"sad": float(np.abs(matte.alpha - case.truth).sum() / case.truth.sum()), "mse": float(((matte.alpha - case.truth) ** 2).mean())}
    if case.truth is not None:
        row["truth"] = {"objective": normalised_objective(matrix, case.truth)}
    return row, mattes


def told(row: dict) -> str:
    """One line of the table."""
    parts = [f"{row['case']:22}"]
    for method in ORDER:
        if method in row:
            found = row[method]
            quality = f"SAD {found['sad']:.3f} MSE {found['mse']:.4f} " if "sad" in found else ""
            parts.append(f"{method} {quality}f {found['objective']:.1e} {found['seconds']:.1f} s")
    if {"closed-form", "layered"} <= row.keys() and "sad" in row["layered"]:
        parts.append(f"ratio {row['layered']['sad'] / row['closed-form']['sad']:.2f}")
    return " | ".join(parts)


def summed(rows: list[dict], methods) -> list[str]:
    """The bars, over all rows with a truth."""
    rows = [row for row in rows if "truth" in row]
    lines = []
    for method in methods if rows else ():
        sad = np.array([row[method]["sad"] for row in rows])
        line = f"{method:12} median SAD {np.median(sad):.3f} (bar .25), below the empty matte {np.mean(sad < 1):.0%} (bar 100 %)"
        if "closed-form" in methods:
            line += f", SAD at most {BAR} of closed form's {np.mean(sad <= BAR * np.array([row['closed-form']['sad'] for row in rows])):.0%} (bar 80 %)"
        lines.append(line)
    return lines


def sheet(shown: list[tuple[Case, dict[str, Matte]]], path: Path, *, cell: int = 300) -> None:
    """Figure 2's rows, and the normalised objective by step."""
    columns = ("scribbles", *ORDER, "truth")
    picture = Image.new("RGB", (cell * len(columns), (cell + 18) * len(shown) + 220), "white")
    pen = ImageDraw.Draw(picture)
    for k, (case, mattes) in enumerate(shown):
        fields = {"scribbles": _scribbled(case)} | {name: _grey(matte.alpha) for name, matte in mattes.items()}
        if case.truth is not None:
            fields["truth"] = _grey(case.truth)
        for j, name in enumerate(columns):
            if name in fields:
                field = Image.fromarray(fields[name])
                scale = (cell - 8) / max(field.size)
                field = field.resize((round(field.width * scale), round(field.height * scale)), Image.Resampling.LANCZOS)
                picture.paste(field, (j * cell + (cell - field.width) // 2, k * (cell + 18) + 18))
            pen.text((j * cell + 6, k * (cell + 18) + 3), f"{case.name}: {name}" if j == 0 else name, fill="black")
    _curves(pen, shown, (cell + 18) * len(shown) + 20, picture.width)
    picture.save(path)


def _curves(pen: ImageDraw.ImageDraw, shown, top: int, width: int) -> None:
    each = width // len(shown)
    for k, (case, mattes) in enumerate(shown):
        course = np.log10(np.maximum(mattes["normalised"].course, 1e-12)) if "normalised" in mattes else np.zeros(0)
        if len(course) < 2:
            continue
        x = k * each + 16 + np.arange(len(course)) / (len(course) - 1) * (each - 40)
        y = top + 40 + (course.max() - course) / max(np.ptp(course), 1e-9) * 130
        pen.line([(float(a), float(b)) for a, b in zip(x, y, strict=True)], fill=(30, 90, 200), width=2)
        pen.text((k * each + 16, top + 4), f"{case.name}\nobjective {10 ** course[0]:.2e} to {10 ** course[-1]:.2e}", fill="black")


def _scribbled(case: Case) -> np.ndarray:
    rgb = case.photo.rgb.copy()
    fore, back = case.scribbles.masks(case.photo)
    rgb[fore], rgb[back] = (235, 50, 40), (255, 215, 0)
    return rgb


def _grey(alpha: np.ndarray) -> np.ndarray:
    return np.repeat(np.round(255 * np.asarray(alpha)).astype(np.uint8)[..., None], 3, axis=2)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shared", type=Path)
    parser.add_argument("--methods", default=",".join(ORDER))
    parser.add_argument("--only", default="")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--sheet", type=Path)
    options = parser.parse_args()
    methods = [name for name in ORDER if name in options.methods.split(",") and name in MATTINGS]
    groups = {"drawn": drawn_cases()}
    if options.shared:
        groups |= {"birch": birch_cases(options.shared), "given": given_cases(options.shared), "real": real_cases(options.shared)}
    everything, shown = [], []
    for group, cases in groups.items():
        rows = []
        for case in (case for case in cases if options.only in f"{group}: {case.name}"):
            row, mattes = measured(case, methods)
            rows.append(row)
            shown.append((case, mattes))
            print(told(row), flush=True)
        print("\n".join(summed(rows, methods)), flush=True)
        everything += [row | {"group": group} for row in rows]
    if options.json:
        options.json.write_text(json.dumps(everything, indent=1))
    if options.sheet and shown:
        sheet(shown, options.sheet)


if __name__ == "__main__":
    main()
