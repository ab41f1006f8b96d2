"""Which template, which leaf, which bark: the best match, or what the user named."""

import numpy as np

from sketchtree.errors import OptionError, TemplateError
from sketchtree.foliage.models import leaf_names, plain_names
from sketchtree.geometry.bark import bark_names
from sketchtree.parameters import Habit
from sketchtree.sketch.graph import SketchGraph
from sketchtree.templates.store.database import Database
from sketchtree.templates.exemplar import Exemplar
from sketchtree.templates.matching.match import Match, match


_LOYAL = ((2, np.inf), (5, 5.0), (8, 4.0))  # with fewer limbs, nats that another exemplar must be likelier than the one in use before it takes its place:
_LOYAL_AT_LAST = 1.0  # a trunk says nothing, a few limbs little, and a species that changes with every stroke is no help


def choose_template(
    graph: SketchGraph, templates: Database | None, wanted: str, *, before: str | None = None, rank: bool = True
) -> tuple[list[Match], Exemplar | None]:
    """All exemplars ranked (§7), and the one to use: the one the user named, or the best; the one in use `before` stays while no other is much likelier, the longer the less is drawn.
    Without `rank` a named one is taken unranked. Raises TemplateError."""
    if wanted == "none" or templates is None:
        return [], None
    if wanted != "auto" and wanted not in templates.names:
        names = ", ".join(templates.names)
        raise TemplateError(f"There is no template called “{wanted}”.", remedy=f"Choose auto, none or one of: {names}.")
    if wanted != "auto" and not rank:
        return [], templates.exemplar(wanted)
    matches = match(graph, templates)
    return matches, templates.exemplar(_best(matches, before, len(graph.limb_id)) if wanted == "auto" else wanted)


def _best(matches: list[Match], before: str | None, limbs: int) -> str:
    margin = next((nats for fewer, nats in _LOYAL if limbs < fewer), _LOYAL_AT_LAST)
    return next((one for one in matches if one.name == before and one.score > matches[0].score - margin), matches[0]).name


def leaf_model(wanted: str | None, habit: Habit, templates: Database | None) -> str | None:
    """The leaf model to use; None for no leaves. `wanted` is a model, an exemplar, "auto" for the habit's own, or "none"."""
    if wanted is None or wanted == "auto":
        return habit.leaf
    if wanted == "none":
        return None
    if wanted in leaf_names() or wanted in plain_names():
        return wanted
    if templates is not None and wanted in templates.names:
        return templates.exemplar(wanted).habit.leaf
    raise OptionError(f"There is no leaf called “{wanted}”.", remedy=f"Choose none, a template's name or one of: {', '.join(leaf_names() + plain_names())}.")


def bark_model(wanted: str | None, habit: Habit) -> str:
    """The bark to use, the template's by default."""
    if wanted is not None and wanted not in bark_names():
        raise OptionError(f"There is no bark called “{wanted}”.", remedy=f"Choose one of: {', '.join(bark_names())}.")
    return wanted or habit.bark
