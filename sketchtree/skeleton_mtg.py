"""A tree as a Multiscale Tree Graph (MTG, Godin & Caraglio 1998), the text format of AMAPmod and OpenAlea, form A.

A header (CODE, CLASSES, DESCRIPTION, FEATURES), then one line an entity or a chain of them. The column in which a line begins tells what
it grows on: the last entity of the column to the left, or, after `^`, of the same column. `<` continues the axis, `+` bears a
lateral, `/` refines at a finer scale; `E1<<E5` stands for E1<E2<…<E5, its figures for E5.

Read are the entities with coordinates (`XX YY ZZ` or `X Y Z`), at whatever scale, and those between two of them that bear laterals, evenly spaced
along their axis.
Radii come from `TopDia` (tenths of the unit of length, as AMAPmod's digitisers write it), `diameter` or `radius` (the unit itself); an
entity without one has its predecessor's.
"""

import os
import re
from dataclasses import dataclass

import numpy as np

from sketchtree.axes import NULL
from sketchtree.errors import SkeletonError
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_rows import filled_radius, observed

_ENTITY = re.compile(r"(<<|<|\+|/)\s*([A-Za-z$]+)(\d*)")
_RADIUS = {"topdia": 0.05, "diameter": 0.5, "dia": 0.5, "radius": 1.0}  # feature → radius in units of length
CHAIN = 100_000  # entities that one `<<` may stand for


@dataclass
class Entity:
    """One entity: what it grows on, how, where it ends."""

    above: int  # row of the entity before it, or NULL
    lateral: bool  # borne by it (`+`), else continuing or refining it
    point: tuple[float, float, float] | None = None
    radius: float = np.nan


def read_mtg(path: str | os.PathLike) -> TreeSkeleton:
    """The tree of an MTG file, in the file's units and axes. Raises `SkeletonError` naming the line at fault."""
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            lines = [(number, text.split("#")[0].rstrip("\r\n")) for number, text in enumerate(file, 1)]
    except OSError as error:
        raise SkeletonError(f"Can't read {path}: {(error.strerror or 'unknown error').lower()}.", remedy="Check the path.") from error
    entities = _entities(path, *_body(path, lines))
    if sum(entity.point is not None for entity in entities) < 2:
        raise SkeletonError(f"{path}: fewer than two entities have coordinates.", remedy="Give a digitised tree, with figures in XX, YY and ZZ.")
    return _skeleton(path, entities)


def _body(path, lines):
    """The lines after the header, and at which tab each feature stands."""
    heads = {text.split(":")[0].strip().upper(): i for i, (_, text) in enumerate(lines) if ":" in text}
    if "MTG" not in heads or "FEATURES" not in heads:
        lacks = "FEATURES" if "MTG" in heads else "MTG"
        raise SkeletonError(f"{path} is no MTG file: it has no section `{lacks}:`.", remedy="Give a file of AMAPmod or OpenAlea.")
    code = re.search(r"FORM-\w", lines[heads["CODE"]][1]) if "CODE" in heads else None
    if code and code.group() != "FORM-A":
        raise SkeletonError(f"{path}: it is written in {code.group()}, and only FORM-A is read.", remedy="Save it as FORM-A.")
    rest = [(number, text) for number, text in lines[heads["MTG"] + 1 :] if text.strip()]
    if not rest or rest[0][1].split("\t")[0].strip().upper() not in ("ENTITY-CODE", "TOPO"):
        raise SkeletonError(f"{path}: after `MTG:` there is no line of columns that begins with ENTITY-CODE.", remedy="Add it.")
    cells = [cell.strip() for cell in rest[0][1].split("\t")]
    feature = {cell.lower(): i for i, cell in enumerate(cells) if cell and i > 0}
    axes = next((names for names in (("xx", "yy", "zz"), ("x", "y", "z")) if set(names) <= set(feature)), None)
    if axes is None:
        raise SkeletonError(f"{path}, line {rest[0][0]}: there are no columns XX, YY and ZZ.", remedy="Give a digitised tree.")
    thick = next((name for name in _RADIUS if name in feature), None)
    return rest[1:], min(feature.values()), [feature[name] for name in axes], feature.get(thick), _RADIUS.get(thick)


def _entities(path, lines, width, axes, thick, scale) -> list[Entity]:
    entities, last = [], {}  # column → row of its last entity
    for number, text in lines:
        cells = [cell.strip() for cell in text.split("\t")]
        column = next((i for i, cell in enumerate(cells[:width]) if cell), None)
        if column is None:
            raise _wrong(path, number, "no entity stands before its figures", text)
        code = cells[column].replace(" ", "")
        again, code = code.startswith("^"), code.removeprefix("^")
        above = last.get(column) if again else next((last[c] for c in range(column - 1, -1, -1) if c in last), None)
        if above is None and (entities and column > 0 or again):
            raise _wrong(path, number, "there is no entity for it to grow on", text)
        matches = list(_ENTITY.finditer(code))
        if not matches or "".join(match.group() for match in matches) != code:
            raise _wrong(path, number, f"`{code[:40]}` is no chain of entities", text)
        row = NULL if above is None else above
        for i, (edge, symbol, index) in enumerate(match.groups() for match in matches):
            row = _chain(path, number, text, entities, row, edge, symbol, index, matches[i - 1] if i else None)
        last = {c: r for c, r in last.items() if c < column} | {column: row}
        values = [_number(path, number, text, cells, at) for at in axes]
        if None not in values:
            entities[row].point = tuple(values)
        across = None if thick is None else _number(path, number, text, cells, thick)
        if across is not None:
            entities[row].radius = across * scale
    return entities


def _chain(path, number, text, entities, row, edge, symbol, index, before) -> int:
    """Adds an entity, or all that `<<` stands for; the row of the last."""
    count = 1
    if edge == "<<":
        if before is None or before.group(2) != symbol or not (before.group(3) and index) or not 0 < int(index) - int(before.group(3)) <= CHAIN:
            raise _wrong(path, number, f"`<<{symbol}{index}` does not count up", text)
        count = int(index) - int(before.group(3))
    for _ in range(count):
        entities.append(Entity(row, edge == "+"))
        row = len(entities) - 1
    return row


def _number(path, number, text, cells, at) -> float | None:
    if at >= len(cells) or cells[at] in ("", "?", "NA"):
        return None
    try:
        value = float(cells[at].replace(",", "."))
    except ValueError:
        value = np.nan
    if not abs(value) < 1e15:
        raise _wrong(path, number, f"`{cells[at][:20]}` is no number", text)
    return value


def _skeleton(path, entities: list[Entity]) -> TreeSkeleton:
    points = [None if e.point is None else np.array(e.point) for e in entities]
    bears = _bearers(entities)
    _space_evenly(entities, points)
    kept, node, pending = [], np.full(len(entities), NULL), np.zeros(len(entities), bool)
    for i, entity in enumerate(entities):  # one of no length, or spaced and bearing nothing, is where the one before it is
        above = NULL if entity.above == NULL else node[entity.above]
        lateral = entity.lateral or (entity.above != NULL and pending[entity.above])
        idle = points[i] is None or entity.point is None and not bears[i]
        if idle or above != NULL and np.linalg.norm(points[i] - points[kept[above][0]]) < 1e-9:
            node[i], pending[i] = above, lateral and above != NULL
            continue
        node[i] = len(kept)
        radius = entity.radius if entity.radius > 0 or above == NULL else kept[above][3]
        kept.append((i, above, lateral, radius))
    parent, radius = np.array([row[1] for row in kept]), np.array([row[3] for row in kept], float)
    tip = np.array([points[row[0]] for row in kept])
    return observed(path, parent, tip, filled_radius(radius), ~np.array([row[2] for row in kept]))


def _bearers(entities: list[Entity]) -> list[bool]:
    """Which entities bear a lateral that is digitised, itself or further out."""
    digitised, bears = [entity.point is not None for entity in entities], [False] * len(entities)
    for i in range(len(entities) - 1, -1, -1):
        above = entities[i].above
        if digitised[i] and above != NULL:
            digitised[above] = True
            bears[above] |= entities[i].lateral
    return bears


def _space_evenly(entities: list[Entity], points: list) -> None:
    """Gives the entities between two digitised ones of an axis their places."""
    for i, entity in enumerate(entities):
        if entity.point is None or entity.lateral:
            continue
        between, row = [], entity.above
        while row != NULL and points[row] is None:
            between.append(row)
            row = entities[row].above
            if entities[between[-1]].lateral:
                break
        if row == NULL or points[row] is None:
            continue
        for k, unknown in enumerate(reversed(between), 1):
            points[unknown] = points[row] + (points[i] - points[row]) * k / (len(between) + 1)
            entities[unknown].radius = entity.radius


def _wrong(path, number, what, text) -> SkeletonError:
    return SkeletonError(f"{path}, line {number}: {what} (`{' '.join(text.split())[:60]}`).", remedy="Repair the line, or start it with #.")
