"""Where do drawings come from and go to? The folder's files, examples, what is uploaded; and the project file."""

import asyncio
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import msgspec

from sketchtree.editing.document import Document
from sketchtree.editing.laid_cloud import laid_under
from sketchtree.errors import ExportError, SketchError
from sketchtree.studio import examples, messages
from sketchtree.studio.desk import Desk, Page
from sketchtree.studio.folder import PROJECT, is_name, project_name
from sketchtree.studio.ids import fitting
from sketchtree.studio.journal_lines import Line
from sketchtree.studio.recovery import StudioError, journal_of
from sketchtree.studio.scribbled_example import scribbled_example
from sketchtree.studio.underlays import placed

_PLAIN = messages.CloudReading()


async def welcome(desk: Desk, page: Page) -> None:
    """Tell a page what there is to choose from."""
    catalogue = await desk.engine.catalogue()
    shown = catalogue.examples or [messages.Choice(name=name, title=examples.title(name), picture=f"/picture/example/{name}.png") for name in examples.names()]
    folder = desk.files.folder
    page.outbox.put(
        msgspec.structs.replace(
            catalogue, version=messages.VERSION, examples=shown, recovered=desk.recovered,
            folder="" if folder is None else folder.name, files=[] if folder is None else await asyncio.to_thread(folder.files),
        )
    )  # fmt: skip


async def open_named(desk: Desk, name: str, *, example: bool, reading: messages.CloudReading = _PLAIN) -> None:
    """A file of the folder, or an example, takes the place of what is there, once it is read, as a step. `reading`: of points. Raises SketchTreeError."""
    if example and name in examples.SCRIBBLED:
        await _open_scribbled(desk, name)
        return
    if example:
        await open_bytes(desk, examples.data(name), name)
        return
    folder = desk.files.folder
    if folder is None:
        raise SketchError("There is no folder to open from.", remedy="Upload the file instead.")
    async with desk.filing:
        signature = folder.signature(name)
        data = await asyncio.to_thread(folder.read, name)
        document = await read(desk, data, name, reading)
        async with desk.turn:
            desk.files.signatures[name] = signature
            desk.step(document, "open", saved_as=name if name.lower().endswith(PROJECT) else None)


async def _open_scribbled(desk: Desk, name: str) -> None:
    """The example of a photo with scribbles on it takes the place of what is there, as a step."""
    document = fitting(await asyncio.to_thread(scribbled_example, name))
    async with desk.turn:
        desk.step(document, "open")


async def open_bytes(desk: Desk, data: bytes, name: str, reading: messages.CloudReading = _PLAIN) -> None:
    """A drawing, a project or a point cloud takes the place of what is there, once it is read, as a step. Raises SketchTreeError."""
    async with desk.filing:
        document = await read(desk, data, name, reading)
        async with desk.turn:
            desk.step(document, "open")


async def lay(desk: Desk, data: bytes, name: str, reading: messages.CloudReading = _PLAIN) -> None:
    """The points of a cloud lie behind the drawing, once they are read, as a step. Raises SketchTreeError."""
    async with desk.filing:
        cloud = (await read(desk, data, name, reading)).cloud
        if cloud is None:
            raise SketchError(f"{name} is no point cloud.", remedy="Give PLY, LAS, LAZ, XYZ, NPZ or NPY.")
        async with desk.turn:
            document = desk.document
            desk.step(document.replace(cloud=laid_under(cloud, document.strokes.values()), points=document.points.drawn), "point cloud")


async def read(desk: Desk, data: bytes, name: str, reading: messages.CloudReading = _PLAIN) -> Document:
    """The document of a file, called as the file is. Raises SketchTreeError; SeveralTrees, where a cloud has several and none was chosen."""
    if not is_name(name):
        raise SketchError("That is no name of a drawing.", remedy="Rename the file, without a path, a colon, or a dot at its start.")
    if len(data) > messages.MAX_UPLOAD:
        raise SketchError(f"{name} has {len(data) / 1e6:.0f} MB; {messages.MAX_UPLOAD / 1e6:.0f} MB is the most.", remedy="Choose a smaller file.")
    document = await desk.engine.read(data, name, reading)
    return fitting(document).replace(name=Path(name).stem)


async def trace(desk: Desk, picture: bytes, name: str) -> None:
    """A picture to trace over lies under the drawing, as a step. Raises SketchTreeError."""
    underlay = await asyncio.to_thread(placed, picture, name, desk.document)
    async with desk.turn:
        desk.step(desk.document.replace(underlay=underlay), "picture")


async def open_photo(desk: Desk, picture: bytes, name: str) -> None:
    """A photo in which a tree is to be marked lies under an empty page, as a step. Raises SketchTreeError."""
    page = Document.blank(name=Path(name).stem or "photo")
    underlay = await asyncio.to_thread(placed, picture, name, page)
    async with desk.turn:
        desk.step(page.replace(underlay=replace(underlay, photo=True, opacity=1.0)), "photo")


async def save(desk: Desk, name: str, *, over: bool) -> None:
    """The project as it is now, as a file of the folder; drawing goes on meanwhile. Afterwards its journal has only what was done since. Raises SketchTreeError."""
    folder = desk.files.folder
    if folder is None:
        raise ExportError("There is no folder to save in.", remedy="Download the project instead.")
    file = project_name(name)
    stem = file[: -len(PROJECT)]
    async with desk.filing:
        async with desk.turn:
            document, state = desk.document, desk.history.state
        found, known = await asyncio.to_thread(folder.signature, file), desk.files.signatures.get(file)
        if found is not None and not over and (found != known or stem != document.name):
            what = "has been changed by another program" if stem == document.name and known is not None else "is there already"
            raise ExportError(f"{file} {what}.", remedy="Choose another name, or save over it.")
        journal = await _journal_for(desk, folder.path_of(file))
        try:
            data = await desk.engine.project(document.replace(name=stem))
            desk.files.signatures[file] = await asyncio.to_thread(folder.write, file, data)
        except BaseException:
            if journal is not desk.scribe.journal:
                journal.close()
            raise
        async with desk.turn:
            await _turn_to(desk, journal, lambda: desk.is_in_file(document, state, stem, file))
            files = await asyncio.to_thread(folder.files)
            desk.tell(messages.Saved(name=stem, files=files, drawing=desk.document.name, saved=desk.saved))


async def _journal_for(desk: Desk, path: Path):
    """The journal that the project will have. Raises StudioError where another studio has that project."""
    present = desk.scribe.journal
    if present is None or present.project is not None and os.path.abspath(present.project) == os.path.abspath(path):
        return present
    try:
        return await asyncio.to_thread(journal_of, path)
    except StudioError as error:
        raise StudioError(error.message, remedy="Save under another name.") from error


async def _turn_to(desk: Desk, journal, kept: Callable[[], tuple[Line, ...]]) -> None:
    """The project is in its file: the journal begins anew with the lines that `kept` gives, which are in it before those of the last one go. `desk.turn` is held."""
    before = desk.scribe.journal
    if journal is None:
        kept()
        return
    if journal is not before:
        await asyncio.to_thread(journal.set_aside)
    await desk.scribe.rest()
    desk.scribe.turn_to(journal)
    if lines := kept():
        desk.scribe.write(lines, lambda: None)
        await desk.scribe.rest()
    elif journal is before:
        await asyncio.to_thread(journal.clear)
    if journal is not before:
        journal.keep_key(before.key)
        before.keep_key(None)
        if not desk.scribe.owes:
            await asyncio.to_thread(before.clear)
        before.close()
