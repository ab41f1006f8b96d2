"""What does the page call the messages? `page/src/messages.ts`, made of `messages.py`.

    python -m sketchtree.studio.typescript            writes it
    python -m sketchtree.studio.typescript --check    status 1 if it is not up to date

What the page receives is always encoded whole, so no field is optional there. What it sends may leave out every field that has a default; a record that
goes both ways has two types, `Stroke` and `SentStroke`, and the first fits wherever the second is asked for.
"""

import inspect
import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import msgspec
from msgspec import inspect as kinds

from sketchtree.studio import messages

TARGET = Path(__file__).parent / "page" / "src" / "messages.ts"
COMMAND = "python -m sketchtree.studio.typescript"
_LIMITS = ("VERSION", "MAX_MESSAGE", "MAX_UPLOAD", "MAX_POINTS", "MAX_STROKES", "LOWEST_PLANT", "TALLEST_PLANT")
_COMMENT = re.compile(r"^    (\w+): .*?  # (.+)$", re.MULTILINE)
_PLAIN = {kinds.BoolType: "boolean", kinds.IntType: "number", kinds.FloatType: "number", kinds.StrType: "string", kinds.NoneType: "null"}


def source() -> str:
    """The whole file."""
    requests, events = get_args(messages.Request), get_args(messages.Event)
    sent, received = _reached(requests), _reached(events)
    parts = [f"// Made from sketchtree/studio/messages.py by `{COMMAND}`: change that file, not this one.", ""]
    parts += [f"export const {name} = {getattr(messages, name)};" for name in _LIMITS] + [""]
    for record in received:
        parts += [_interface(record, record.__name__, frozenset()), ""]
    both = frozenset(record.__name__ for record in received)
    for record in sent:
        parts += [_interface(record, _sent_name(record.__name__, both), both, sent=True), ""]
    parts += [f"export type {name} = {' | '.join(one.__name__ for one in union)};" for name, union in (("Request", requests), ("Event", events))]
    return "\n".join(parts) + "\n"


def main(arguments: list[str]) -> int:
    """Write the file, or say whether it is up to date; returns the exit status."""
    if arguments not in ([], ["--check"]):
        sys.stderr.write(f"usage: {COMMAND} [--check]\n")
        return 2
    if not arguments:
        TARGET.parent.mkdir(parents=True, exist_ok=True)
        TARGET.write_text(source(), encoding="utf-8")
        return 0
    if TARGET.exists() and TARGET.read_text(encoding="utf-8") == source():
        return 0
    sys.stderr.write(f"{TARGET.name} is not what messages.py says. Run `{COMMAND}`.\n")
    return 1


def _reached(records: tuple[type, ...]) -> list[type]:
    """These records and all that are in them, those first that others are made of."""
    found: dict[type, None] = {}

    def visit(record: type) -> None:
        if record in found:
            return
        for field in kinds.type_info(record).fields:
            for inner in _structs(field.type):
                visit(inner)
        found[record] = None

    for record in records:
        visit(record)
    return list(found)


def _structs(kind: kinds.Type) -> Iterator[type]:
    if isinstance(kind, kinds.StructType):
        yield kind.cls
    for name in ("item_type", "key_type", "value_type"):
        if hasattr(kind, name):
            yield from _structs(getattr(kind, name))
    for one in getattr(kind, "types", ()):
        yield from _structs(one)


def _sent_name(name: str, both: frozenset[str]) -> str:
    return f"Sent{name}" if name in both else name


def _interface(record: type[msgspec.Struct], name: str, both: frozenset[str], *, sent: bool = False) -> str:
    comments = dict(_COMMENT.findall(inspect.getsource(record)))
    info = kinds.type_info(record)
    lines = [f"/** {' '.join(record.__doc__.split())} */", f"export interface {name} {{"]
    if info.tag is not None:
        lines.append(f"  {info.tag_field}: {json.dumps(info.tag)};")
    for field in info.fields:
        optional = "?" if sent and not field.required else ""
        comment = f" // {comments[field.name]}" if field.name in comments else ""
        lines.append(f"  {field.encode_name}{optional}: {_type(field.type, both)};{comment}")
    return "\n".join([*lines, "}"])


def _type(kind: kinds.Type, both: frozenset[str]) -> str:
    """What TypeScript calls a type; records of `both` are those that may be sent with fields left out."""
    if type(kind) in _PLAIN:
        return _PLAIN[type(kind)]
    if isinstance(kind, kinds.LiteralType):
        return " | ".join(json.dumps(value) for value in kind.values)
    if isinstance(kind, kinds.StructType):
        return _sent_name(kind.cls.__name__, both)
    if isinstance(kind, kinds.ListType):
        item = _type(kind.item_type, both)
        return f"({item})[]" if " | " in item else f"{item}[]"
    if isinstance(kind, kinds.TupleType):
        return f"[{', '.join(_type(one, both) for one in kind.item_types)}]"
    if isinstance(kind, kinds.DictType):
        return f"Record<{_type(kind.key_type, both)}, {_type(kind.value_type, both)}>"
    if isinstance(kind, kinds.UnionType):
        names = dict.fromkeys(_type(one, both) for one in kind.types)
        return " | ".join(sorted(names, key=lambda one: one == "null"))
    raise TypeError(f"a message has a field of a kind that TypeScript is not told: {kind}")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
