"""How does a command get the tree of a project whose tree is the one that stands in the points behind its drawing? Traced anew: the project keeps none."""

from pathlib import Path

from sketchtree.commands.own_looks import with_own_looks


def traced(source: Path, templates, *, seed: int, seed_chosen: bool, season_chosen: bool, reading, tree, watch=None):
    """(the project's tree, the seed in use): of its own seed, template, height and looks where the user names no others. Raises SketchError, OptionError."""
    from sketchtree.export.skeletons.hdf5 import read_choices
    from sketchtree.keys import root_key
    from sketchtree.laid_tree import read_laid, tree_of

    told = read_choices(source)
    seed = seed if seed_chosen else told["seed"]
    laid = read_laid(source, reading, with_own_looks(tree, told, season_chosen=season_chosen))
    return tree_of(laid, None if laid.reading.template == "none" else templates, key=root_key(seed), watch=watch), seed


def begun(source: Path, templates, *, seed: int, seed_chosen: bool, season_chosen: bool, reading, tree, watch=None):
    """(what the project's tree begins as, the seed in use), of commands that let it grow. Raises as `traced`."""
    found, seed = traced(source, templates, seed=seed, seed_chosen=seed_chosen, season_chosen=season_chosen, reading=reading, tree=tree, watch=watch)
    return found.finish.begun(found.skeleton), seed


def grown(source: Path, db: Path | None, *, seed: int, seed_chosen: bool, season_chosen: bool = False, tree=None):
    """(the project's tree, the seed in use), of commands that show or write it as it is. Raises as `traced`."""
    from sketchtree.growth_tree import check_tree
    from sketchtree.options import ReadingOptions, TreeOptions
    from sketchtree.templates.store.database import Database

    tree, templates = tree or TreeOptions(), Database.open(db)
    check_tree(tree, templates)
    return traced(source, templates, seed=seed, seed_chosen=seed_chosen, season_chosen=season_chosen, reading=ReadingOptions(), tree=tree)
