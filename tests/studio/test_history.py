"""Steps are taken back and done again, without limit; like steps in quick succession are one."""

import numpy as np

from sketchtree.editing.document import Document
from sketchtree.editing.settled import Settled
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio.change import apply, change, inverse
from sketchtree.studio.history import History


def _with(document: Document, *names: str) -> Document:
    return document.replace(strokes={**document.strokes, **{name: Stroke(name, [[0, 0], [1, 1]]) for name in names}})


def step(history: History, document: Document, label: str, **how) -> bool:
    return history.step(change(history.document, document), label, **how)


def test_undo_and_redo_give_back_the_very_strokes():
    history = History(Document())
    seen = [history.document.strokes]
    for k in range(200):
        step(history, _with(history.document, f"s{k}"), "branch", now=0.0)
        seen.append(history.document.strokes)
    for strokes in reversed(seen[:-1]):
        assert history.undo() and list(history.document.strokes) == list(strokes) and all(history.document.strokes[name] is strokes[name] for name in strokes)
    assert not history.undo()
    for strokes in seen[1:]:
        assert history.redo() and list(history.document.strokes) == list(strokes)
    assert not history.redo()


def test_a_step_after_undo_ends_what_could_be_done_again():
    history = History(Document())
    step(history, _with(history.document, "a"), "branch", now=0.0)
    history.undo()
    assert history.redo_label == "branch"
    step(history, _with(history.document, "b"), "crown", now=0.0)
    assert history.redo_label is None and history.undo_label == "crown"


def test_like_steps_within_a_second_are_one():
    history = History(Document())
    for k in range(5):
        step(history, history.document.replace(seed=k + 1), "seed", now=0.8 * k, alike="seed")
    assert history.document.seed == 5
    history.undo()
    assert history.document.seed == 0 and not history.undo()


def test_like_steps_far_apart_are_two():
    history = History(Document())
    step(history, history.document.replace(seed=1), "seed", now=0.0, alike="seed")
    step(history, history.document.replace(seed=2), "seed", now=1.1, alike="seed")
    history.undo()
    assert history.document.seed == 1


def test_undo_parts_like_steps():
    history = History(Document())
    step(history, history.document.replace(seed=1), "seed", now=0.0, alike="seed")
    history.undo()
    history.redo()
    assert not step(history, history.document.replace(seed=2), "seed", now=0.1, alike="seed")
    history.undo()
    assert history.document.seed == 1


def test_where_the_depths_had_settled_comes_back_with_the_step():
    history = History(Document())
    first, second = Settled(template="oak"), Settled(template="birch")
    step(history, _with(history.document, "a"), "branch", now=0.0)
    history.keep(history.document.replace(settled=first))
    step(history, _with(history.document, "b"), "branch", now=0.0)
    history.keep(history.document.replace(settled=second))
    history.undo()
    assert history.document.settled is first
    history.redo()
    assert history.document.settled is second


def test_every_state_has_its_own_number_and_keeps_it():
    history = History(Document())
    step(history, _with(history.document, "a"), "branch", now=0.0)
    first = history.state
    step(history, _with(history.document, "b"), "branch", now=0.0)
    history.undo()
    assert history.state == first
    step(history, _with(history.document, "c"), "branch", now=0.0)
    assert history.state > first + 1


def test_a_change_leads_from_one_document_to_the_other_in_any_order_of_strokes():
    rng = np.random.default_rng(0)
    for _ in range(50):
        old, new = (_with(Document(), *[f"s{k}" for k in rng.permutation(8)[: rng.integers(0, 8)]]) for _ in range(2))
        what = change(old, new)
        assert list(apply(old, what).strokes) == list(new.strokes)
        assert list(apply(new, inverse(what, old)).strokes) == list(old.strokes)


def test_nothing_different_is_no_change():
    document = _with(Document(seed=100_000), "a")
    assert not change(document, document.replace(seed=int("100000")))
