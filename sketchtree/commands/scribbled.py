"""How does a command get the tree of a project whose tree is taken from scribbles on its photo? Made anew, as `grow` makes it: the project keeps none."""

import dataclasses
from pathlib import Path

from sketchtree.commands.own_looks import with_own_looks


def begun(source: Path, templates, *, seed: int, seed_chosen: bool, season_chosen: bool, reading, tree, watch=None):
    """(what the project's tree begins as, the seed in use): of its own seed, template, height and looks where the user names no others. Raises SketchError, OptionError."""
    from sketchtree.export.skeletons.hdf5 import read_choices
    from sketchtree.keys import root_key
    from sketchtree.scribbled_tree import beginning_of, read_scribbled
    from sketchtree.watch import Watch

    watch = watch or Watch()
    with watch("read"):
        wanted, told = read_scribbled(source, reading), read_choices(source)
    seed = seed if seed_chosen else told["seed"]
    said = wanted.reading
    reading = dataclasses.replace(reading, template=said.template if reading.template == "auto" else reading.template, height=reading.height or said.height)
    templates = None if reading.template == "none" else templates
    found = beginning_of(wanted, templates, key=root_key(seed), reading=reading, tree=with_own_looks(tree, told, season_chosen=season_chosen), watch=watch)
    return dataclasses.replace(found, levels=wanted.choices.levels), seed


def grown(source: Path, db: Path | None, *, seed: int, seed_chosen: bool, season_chosen: bool = False, tree=None):
    """(the project's tree as it is grown up, the seed in use), of commands that show or write it as it is. Raises as `begun`."""
    from sketchtree.growth_tree import check_tree, grown_tree
    from sketchtree.options import ReadingOptions, TreeOptions
    from sketchtree.templates.store.database import Database

    tree, templates = tree or TreeOptions(), Database.open(db)
    check_tree(tree, templates)
    found, seed = begun(source, templates, seed=seed, seed_chosen=seed_chosen, season_chosen=season_chosen, reading=ReadingOptions(), tree=tree)
    return grown_tree(found, tree=tree), seed
