"""How like another tree, or the points of a scan, is a tree? Measures, not judgements; `docs/fidelity.md` defines each."""
