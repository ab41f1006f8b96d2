"""What do the rows say? Lines to read while they are made, and the table of `docs/many_photos.md` with its bars."""

import numpy as np

OURS = ("traced", "grown")
PLAIN = ("plain 5 l", "plain 10 l")
COLUMNS = ("S_T", "shape", "geometry", "structure", "chamfer", "recall", "precision", "tips")
APART = 0.05  # of S_T, above plain space colonisation


def lines(name: str, rows: dict[str, dict[str, float]]) -> list[str]:
    """All figures of one model."""
    told = [f"\n{name}", f"{'':14}" + "".join(f"{column:>10}" for column in (*COLUMNS, "limbs", "length", "feet", "seconds"))]
    for way, row in rows.items():
        figures = "".join(f"{row[column]:10.3f}" if column in row else " " * 10 for column in COLUMNS)
        told.append(f"  {way:12}{figures}{row['limbs']:10,.0f}{row['length']:10.1f}{row['feet']:10.0f}{row.get('seconds', 0.0):10.1f}")
    return told


def table(rows: dict[str, dict[str, dict[str, float]]]) -> list[str]:
    """Markdown: S_T of every model that has all ways, and on how many the bars are met. Plain: the better of the two."""
    told = ["| model | " + " | ".join((*OURS, "plain", "another seed, best", "mean")) + " |", "| --- " * (len(OURS) + 4) + "|"]
    above = {way: np.zeros(3, int) for way in OURS}
    every = []
    for name, found in rows.items():
        if not all(way in found for way in (*OURS, *PLAIN, "another seed")):
            continue
        plain, seeds = max(found[way]["S_T"] for way in PLAIN), [found["another seed"][name] for name in ("S_T", "mean")]
        every.append([*(found[way]["S_T"] for way in OURS), plain, *seeds])
        for way in OURS:
            above[way] += [found[way]["S_T"] >= plain + APART, *(found[way]["S_T"] > seed for seed in seeds)]
        told.append(f"| {name.replace('_', ' ')} | " + " | ".join(f"{value:.3f}" for value in every[-1]) + " |")
    if every:
        told.append("| mean | " + " | ".join(f"{value:.3f}" for value in np.mean(every, axis=0)) + " |")
    told += ["", *(f"{way}: above plain by {APART} on {won} of {len(every)}, above the best of other seeds on {over}, above their mean on {usual}" for way, (won, over, usual) in above.items())]
    return [*told, "Guo et al. 2018 print 0.893 (theirs) and 0.815 (space colonisation): other models, other weights, not comparable."]
