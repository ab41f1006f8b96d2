"""What was done to make a forest: the report of every tree, and what they have in common.

The keys of a single tree's report are there too: counts are sums, heights the greatest; what only one tree can have is empty or null.
"""

from sketchtree.forest import Forest
from sketchtree.reading_report import frame, plain, reading
from sketchtree.report import of_tree


def forest_report(
    forest: Forest, *, command: str, seed: int, seconds: dict[str, float], options: dict, warnings: tuple[str, ...] = ()
) -> dict:
    """The report of one run, by `report.schema.json`; one entry of `trees` a sketch."""
    trees = [_tree(forest, k) for k in range(len(forest.trees))]
    found = {
        "attachments": [],
        "roles": [],
        "cuts": [],
        "segments": _sums([tree["segments"] for tree in trees]),
        "height": max(tree["height"] for tree in trees),
        "leaves": sum(tree["leaves"] for tree in trees),
        "triangles": _sums([tree["triangles"] for tree in trees]),
        "trees": trees,
    }
    return plain(frame(command, seed, seconds, options, (*forest.warnings, *warnings)) | found)


def _tree(forest: Forest, k: int) -> dict:
    """One entry."""
    model, place = forest.trees[k], forest.place[k].tolist()
    found = {"sketch": forest.names[k], "copy": forest.copies[k], "place": place, "warnings": list(model.warnings)}
    found |= reading(model.drawn.graph, model.skeleton.segment_count) | of_tree(model.drawn, model)
    moved = [a + b for a, b in zip(found["transform"]["translate"], place, strict=True)]
    return found | {"transform": found["transform"] | {"translate": moved}}


def _sums(counts: list[dict]) -> dict:
    """Entry by entry."""
    return {name: sum(count[name] for count in counts) for name in counts[0]}
