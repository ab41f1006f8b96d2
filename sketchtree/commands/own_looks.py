"""What does a tree wear that a file tells of? What the file says, wherever the user names nothing else."""

import dataclasses


def with_own_looks(tree, told: dict, *, season_chosen: bool):
    """The `TreeOptions` with leaf, bark, wood, season and solid of the file (`export.skeletons.hdf5.read_choices`)."""
    own = {name: told[name] for name in ("leaf", "bark", "wood") if getattr(tree, name) is None and told.get(name) is not None}
    own |= {"season": told["season"]} if not season_chosen and told.get("season") else {}
    own |= {"solid": True} if told.get("solid") and not tree.solid else {}
    return dataclasses.replace(tree, **own)
