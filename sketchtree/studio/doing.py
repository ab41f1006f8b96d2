"""What does each request of a page do? One function a request; what can't be done raises SketchTreeError, and nothing has happened then."""

import asyncio
import traceback
from collections.abc import Awaitable, Callable
from dataclasses import replace
from typing import Any

from sketchtree.editing import operations
from sketchtree.editing.document import Document
from sketchtree.editing.edits import Adopted
from sketchtree.errors import OptionError, SeveralTrees, SketchError, SketchTreeError
from sketchtree.sketch.strokes import Stroke
from sketchtree.studio import filing, messages, wire
from sketchtree.studio.change import Change
from sketchtree.studio.desk import Desk, Page, trouble_of

_SETTLES = 5.0  # seconds that an edit waits, aside, for a limb that is not there yet
_PENDING = 32  # edits that may wait so, and files
_AGAIN = 4  # times that limbs are traced for a drawing that is drawn on
_FILE = "file"  # tasks that read or write one
Edit = Callable[[Document, int], Document]
FAULT = messages.Trouble(
    message="Something went wrong in the program; nothing of the drawing is different.", remedy="The terminal that runs the studio has the details.", about="program"
)


async def do(desk: Desk, page: Page, request: messages.Request) -> None:
    """Do what is asked. Raises SketchTreeError."""
    if not page.greeted and not isinstance(request, messages.Hello):
        raise OptionError("The first message must be a `hello`.", remedy="Load the page again.")
    await _DOING[type(request)](desk, page, request)


async def _hello(desk: Desk, page: Page, request: messages.Hello) -> None:
    if request.version != messages.VERSION:
        page.outbox.put(messages.Trouble(message="This page is of another version of the program.", remedy="Load the page again.", about="program"))
        return
    desk.greet(page)
    _aside(desk, page, lambda: filing.welcome(desk, page))


async def _strokes(desk: Desk, page: Page, request: messages.Strokes) -> None:
    async with desk.turn:
        old = desk.document.strokes
        put = {said.id: _stroke(said, old.get(said.id)) for said in request.put}
        put = {name: stroke for name, stroke in put.items() if old.get(name) is not stroke}
        stay = {said.id for said in request.put}
        gone = tuple(name for name in dict.fromkeys(request.gone) if name in old and name not in stay)
        count = len(old) - len(gone) + sum(name not in old for name in put)
        if count > messages.MAX_STROKES:
            raise SketchError(f"The drawing would have {count} strokes; {messages.MAX_STROKES} is the most.", remedy="Erase some first.")
        if not desk.change(Change(put, gone), request.label):
            desk.answer(page)  # it waits for one


def _stroke(said: messages.Stroke, old: Stroke | None) -> Stroke:
    """The stroke; the old one where the page says what is known, as it does after the line was cut."""
    return old if old is not None and wire.stroke_out(old) == said else wire.stroke_in(said, old)


async def _sketching(desk: Desk, page: Page, request: messages.Sketching) -> None:
    if request.stroke is not None:
        wire.stroke_in(request.stroke)
    desk.engine.ghost(desk.revision, desk.document, request.stroke, None)


async def _choose(desk: Desk, page: Page, request: messages.Choose) -> None:
    async with desk.turn:
        named = tuple(sorted(request.options))
        desk.step(wire.choose(desk.document, request.options), ", ".join(named) or "options", alike=("choose", named))


async def _choose_trunk(desk: Desk, page: Page, request: messages.ChooseTrunk) -> None:
    async with desk.turn:
        desk.step(desk.document.replace(trunk=wire.trunk_in(request.trunk)), request.label or "trunk", alike=("trunk", request.label))


async def _choose_points(desk: Desk, page: Page, request: messages.ChoosePoints) -> None:
    async with desk.turn:
        document = desk.document.replace(points=wire.points_in(request.points))
        under = document.underlay
        if document.points.traced and under is not None and under.photo:
            document = document.replace(underlay=replace(under, photo=False))  # one tree at a time stands in the place of the strokes'
        desk.step(document, request.label or "points", alike=("points", request.label))


async def _turned(desk: Desk, page: Page, request: messages.Turned) -> None:
    async with desk.turn:
        document = desk.document
        if document.cloud is not None and document.points.turn != request.turn:
            desk.remember(document.replace(points=replace(document.points, turn=request.turn)))


async def _set_cloud(desk: Desk, page: Page, request: messages.SetCloud) -> None:
    async with desk.turn:
        document, said = desk.document, request.cloud
        if said is None:
            desk.step(document.replace(cloud=None, points=document.points.drawn), "point cloud")
            return
        cloud = desk.clouds.get(said.digest)
        if cloud is None:
            raise OptionError("Those points are not here any more.", remedy="Open their cloud again.")
        desk.step(document.replace(cloud=wire.cloud_in(said, cloud)), "point cloud", alike="cloud")


async def _glance(desk: Desk, page: Page, request: messages.Glance) -> None:
    shown = None if request.template is None else wire.choose(desk.document, {"template": request.template})
    desk.engine.glance(desk.revision, shown)


async def _hold(desk: Desk, page: Page, request: messages.Hold) -> None:
    if request.live:
        desk.engine.ghost(desk.revision, desk.document, None, request)
        return
    await _edit(desk, page, int(request.limb), lambda document, limb: operations.hold(document, limb, request.share, request.depth), "depth")


async def _flip(desk: Desk, page: Page, request: messages.Flip) -> None:
    await _edit(desk, page, int(request.limb), operations.flip, "flip")


async def _lock(desk: Desk, page: Page, request: messages.Lock) -> None:
    if request.on:
        await _edit(desk, page, int(request.limb), lambda document, limb: operations.lock(document, limb, True), "lock")
        return
    async with desk.turn:
        desk.step(operations.lock(desk.document, int(request.limb), False), "unlock")


async def _delete(desk: Desk, page: Page, request: messages.Delete) -> None:
    await _edit(desk, page, int(request.limb), operations.delete, "delete", undrawn=operations.clear)


async def _mirror(desk: Desk, page: Page, request: messages.Mirror) -> None:
    async with desk.turn:
        desk.step(operations.mirror(desk.document), "mirror")


async def _settle(desk: Desk, page: Page, request: messages.Settle) -> None:
    async with desk.turn:
        desk.step(operations.settle_anew(desk.document), "settle")


async def _edit(desk: Desk, page: Page, limb: int, what: Edit, label: str, undrawn: Callable[[Document, Adopted], Document] | None = None) -> None:
    """An edit of one limb. An undrawn one is looked for aside, and `undrawn` done to it, or it is adopted: nothing else waits meanwhile. Raises SketchTreeError."""
    async with desk.turn:
        if _edited(desk, limb, what, label):
            return
    if len(desk.pending) >= _PENDING:
        raise OptionError("Too many edits wait for the tree.", remedy="Wait until it is ready, then pick the limb again.")

    async def find_and_edit() -> None:
        found = await _undrawn(desk, limb)
        async with desk.turn:
            if not _edited(desk, limb, what, label):
                desk.step(what(desk.document, limb) if found is None else _of_undrawn(desk.document, found, what, undrawn), label)

    task = _aside(desk, page, find_and_edit)
    desk.pending[task] = desk.revision
    task.add_done_callback(desk.pending.pop)


def _edited(desk: Desk, limb: int, what: Edit, label: str) -> bool:
    """Does it, if the limb is drawn or adopted. Raises SketchTreeError."""
    document = desk.with_limb(operations.limb_now(desk.document, limb))
    if document is None:
        return False
    desk.step(what(document, limb), label)
    return True


def _of_undrawn(document: Document, found: Adopted, what: Edit, undrawn: Callable[[Document, Adopted], Document] | None) -> Document:
    """The edit of a limb that was found."""
    return what(operations.adopt(document, found), found.limb) if undrawn is None else undrawn(document, found)


async def _undrawn(desk: Desk, limb: int) -> Adopted | None:
    """An undrawn limb as the tree has it; None: it is drawn. The tree it was picked on may be one that is being made. Raises SketchTreeError."""
    try:
        return await desk.engine.find(desk.document, limb)
    except SketchTreeError:
        if await desk.settles(lambda _: desk.with_limb(limb) is not None, _SETTLES):
            return None
    return await desk.engine.find(desk.document, limb)


async def _readings(desk: Desk, page: Page, request: messages.Readings) -> None:
    _aside(desk, page, lambda: _look_for_readings(desk), only="readings")


async def _look_for_readings(desk: Desk) -> None:
    revision, document = desk.revision, desk.document
    event, settled = await desk.engine.alternatives(revision, document)
    desk.other_readings = (event.revision, document, settled)
    desk.tell(event)


async def _pick(desk: Desk, page: Page, request: messages.Pick) -> None:
    async with desk.turn:
        if desk.other_readings is None or desk.other_readings[0] != request.revision:
            raise OptionError("Those readings are not the newest.", remedy="Look at the readings again, then pick.")
        _, document, settled = desk.other_readings
        if any(getattr(document, name) is not getattr(desk.document, name) for name in ("strokes", "edits", "reading")):
            raise OptionError("The drawing is another since those readings were made.", remedy="Look at the readings again, then pick.")
        if request.reading >= len(settled):
            raise OptionError(f"There are {len(settled)} readings.", remedy="Pick one of them.")
        desk.step(operations.pick(desk.document, settled[request.reading]), "reading")


async def _undo(desk: Desk, page: Page, request: messages.Undo) -> None:
    last = next(reversed(desk.pending), None)
    if last is not None and desk.pending[last] == desk.revision:  # what was asked last is not done yet
        last.cancel()
        desk.answer(page)
        return
    async with desk.turn:
        desk.walk(on=False)


async def _redo(desk: Desk, page: Page, request: messages.Redo) -> None:
    async with desk.turn:
        desk.walk(on=True)


async def _cancel(desk: Desk, page: Page, request: messages.Cancel) -> None:
    desk.engine.cancel()
    for task in desk.tasks:
        if task.get_name() in ("readings", "traced", "propose"):
            task.cancel()


async def _new(desk: Desk, page: Page, request: messages.New) -> None:
    async with desk.turn:
        desk.step(Document.blank(), "new")


async def _open(desk: Desk, page: Page, request: messages.Open) -> None:
    task = _file(desk, page, lambda: _open_or_ask(desk, page, request))
    desk.pending[task] = desk.revision  # undo takes it back before it is done
    task.add_done_callback(desk.pending.pop)


async def _open_or_ask(desk: Desk, page: Page, request: messages.Open) -> None:
    """A cloud in which several trees stand is asked about; where nothing is different that is said too, since the page waits."""
    before = desk.revision
    try:
        await filing.open_named(desk, request.name, example=request.example, reading=request.cloud)
    except SeveralTrees as several:
        page.outbox.put(messages.Several(name=request.name, trees=list(several.trees)))
        return
    if desk.revision == before:
        desk.answer(page)


async def _save(desk: Desk, page: Page, request: messages.Save) -> None:
    _file(desk, page, lambda: filing.save(desk, request.name, over=request.over))


def _file(desk: Desk, page: Page, work: Callable[[], Awaitable[None]]) -> asyncio.Task:
    """A file is read or written aside, in the order in which that was asked."""
    if sum(task.get_name() == _FILE for task in desk.tasks) >= _PENDING:
        raise OptionError("Too many files wait to be opened or saved.", remedy="Wait until they are.")
    return _aside(desk, page, work, name=_FILE, about="file")


async def _set_underlay(desk: Desk, page: Page, request: messages.SetUnderlay) -> None:
    async with desk.turn:
        document, said = desk.document, request.underlay
        if said is None:
            desk.step(document.replace(underlay=None), "picture")
            return
        picture = desk.pictures.get(said.digest)
        if picture is None:
            raise OptionError("That picture is not here any more.", remedy="Add it again.")
        points = document.points.drawn if said.photo else document.points
        desk.step(document.replace(underlay=wire.underlay_in(said, picture), points=points), "picture", alike="underlay")


async def _use_traced(desk: Desk, page: Page, request: messages.UseTraced) -> None:
    task = _aside(desk, page, lambda: _take_over(desk), only="traced")
    desk.pending[task] = desk.revision  # undo takes it back before it is done
    task.add_done_callback(desk.pending.pop)


async def _take_over(desk: Desk) -> None:
    """The traced limbs of the drawing as it is when they are there: one that was drawn on meanwhile is traced again."""
    for _ in range(_AGAIN):
        document = desk.document
        made = await desk.engine.with_traced(document)
        async with desk.turn:
            if all(getattr(desk.document, name) is getattr(document, name) for name in ("strokes", "underlay", "cloud")):
                settled = {} if made.settled is document.settled else {"settled": made.settled}
                desk.step(desk.document.replace(strokes=made.strokes, underlay=made.underlay, points=made.points, **settled), "traced limbs")
                return
    raise OptionError("The drawing was another each time its limbs were traced.", remedy="Lift the pen for a moment, then use them.")


async def _propose(desk: Desk, page: Page, request: messages.Propose) -> None:
    task = _aside(desk, page, lambda: _mark(desk), only="propose")
    desk.pending[task] = desk.revision  # undo takes it back before it is done
    task.add_done_callback(desk.pending.pop)


async def _mark(desk: Desk) -> None:
    """The photo's main tree is marked, unless somebody drew meanwhile."""
    document = desk.document
    made, why = await desk.engine.proposed(document)
    async with desk.turn:
        if desk.document.strokes is document.strokes and desk.document.underlay is document.underlay:
            desk.step(desk.document.replace(strokes=made.strokes), "proposed strokes")
            desk.scribe.after(lambda revision=desk.revision: desk.tell(messages.Proposed(revision=revision, why=why)))  # after the strokes


async def _grow(desk: Desk, page: Page, request: messages.Grow) -> None:
    if request.on:
        desk.engine.grow(desk.revision, desk.document, at_once=True)
    else:
        desk.engine.stop_growing()


def _aside(
    desk: Desk, page: Page, work: Callable[[], Awaitable[None]], only: str | None = None, name: str | None = None, about: str | None = None
) -> asyncio.Task:
    """Do it beside the other requests; of the same `only`, the newest wins. What can't be done is `about` that."""
    for task in desk.tasks if only is not None else ():
        if task.get_name() == only:
            task.cancel()

    async def run() -> None:
        try:
            await work()
        except SketchTreeError as error:
            page.outbox.put(trouble_of(error, about))
        except Exception as error:  # noqa: BLE001 - whatever it is, the page is told
            traceback.print_exception(error)
            page.outbox.put(FAULT)

    task = asyncio.get_running_loop().create_task(run(), name=only or name)
    desk.tasks.add(task)
    task.add_done_callback(desk.tasks.discard)
    return task


_DOING: dict[type, Callable[[Desk, Page, Any], Awaitable[None]]] = {
    messages.Hello: _hello, messages.Strokes: _strokes, messages.Sketching: _sketching, messages.Choose: _choose, messages.ChooseTrunk: _choose_trunk,
    messages.ChoosePoints: _choose_points, messages.Turned: _turned, messages.SetCloud: _set_cloud, messages.Glance: _glance,
    messages.Hold: _hold, messages.Flip: _flip, messages.Mirror: _mirror, messages.Lock: _lock, messages.Delete: _delete, messages.Settle: _settle,
    messages.Readings: _readings, messages.Pick: _pick, messages.Undo: _undo, messages.Redo: _redo, messages.Cancel: _cancel, messages.New: _new,
    messages.Open: _open, messages.Save: _save, messages.SetUnderlay: _set_underlay,
    messages.UseTraced: _use_traced, messages.Grow: _grow, messages.Propose: _propose,
}  # fmt: skip
