"""What do trees look like that grow toward points? Sheets as Figures 6, 7, 9, 12 and 13 of Guo et al. 2018, of clouds of our own trees.

    python -m benchmarks.cloud_sheets -o FOLDER [weights] [species] [roots] [cycles] [variations]
"""

import argparse
from pathlib import Path

from benchmarks.cloud_sheets import cycle_by_cycle, several_roots, three_species, variations, weights

SHEETS = {"weights": weights.sheet, "species": three_species.sheet, "roots": several_roots.sheet, "cycles": cycle_by_cycle.sheet, "variations": variations.sheet}


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sheets", nargs="*", default=list(SHEETS), metavar="SHEET", help=", ".join(SHEETS))
    parser.add_argument("-o", "--out", type=Path, required=True)
    asked = parser.parse_args()
    for name in asked.sheets:
        path = asked.out / f"cloud_{name}.png"
        SHEETS[name](path)
        print(path, f"{path.stat().st_size / 1e3:.0f} kB", flush=True)


if __name__ == "__main__":
    main()
