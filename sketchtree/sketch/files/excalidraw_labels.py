"""What does an Excalidraw drawing call its strokes? Labels from texts, groups and frames.

The nearest that says something decides: `customData.label` (or `name`), the element's id, the text inside it, a short text
in its innermost group, in the groups around it, the name of its frame.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from sketchtree.sketch.files.labels import is_automatic, kind_named, meaning
from sketchtree.sketch.strokes import StrokeKind

FEW_WORDS = 3  # a text of more is a note, not a label
FRAMES = frozenset({"frame", "magicframe"})


@dataclass(frozen=True)
class Labels:
    """Short texts by what they name, and the ids of all texts."""

    inside: dict[str, str]  # id of the container → the text in it
    group: dict[str, str]  # id of the innermost group of a text → that text
    frame: dict[str, str]  # id of a frame → its name
    texts: frozenset[str]  # ids of the text elements
    words: frozenset[str]  # the texts that name something

    @classmethod
    def of(cls, elements: Iterable[dict[str, Any]]) -> "Labels":
        """Every label of a scene."""
        inside, group, frame, texts = {}, {}, {}, set()
        for element in elements:
            if element["type"] in FRAMES:
                frame[text_of(element.get("id"))] = text_of(element.get("name"))
            elif element["type"] == "text":
                texts.add(text_of(element.get("id")))
                text = text_of(element.get("originalText")) or text_of(element.get("text"))
                groups = groups_of(element)
                if len(text.split()) > FEW_WORDS:
                    continue
                if isinstance(element.get("containerId"), str):
                    inside[element["containerId"]] = text
                elif groups:
                    group.setdefault(groups[0], text)
        return cls(inside, group, frame, frozenset(texts), frozenset(inside.values()) | frozenset(group.values()))

    def names(self, element: dict[str, Any]) -> list[str]:
        """What names one element, the closest name first."""
        custom = element.get("customData")
        custom = custom if isinstance(custom, dict) else {}
        own = [text_of(custom.get("label")), text_of(custom.get("name")), text_of(element.get("id"))]
        own.append(self.inside.get(own[-1], ""))
        groups = [name for group in groups_of(element) for name in (self.group.get(group, ""), group)]
        return [name for name in (*own, *groups, self.layer_frame(element)) if name]

    def kind(self, element: dict[str, Any]) -> StrokeKind | None:
        """The kind that the names of one element give; None if they say nothing."""
        return kind_named(*self.names(element))

    def layer(self, element: dict[str, Any]) -> str | None:
        """The nearest name that says something, else that of the innermost named group or frame."""
        groups = [self.group.get(group, "") for group in groups_of(element)]
        named = [name for name in (*groups, self.layer_frame(element)) if not is_automatic(name)]
        return next((name for name in self.names(element) if meaning(name) is not None), next(iter(named), None))

    def layer_frame(self, element: dict[str, Any]) -> str:
        """Name of the frame of one element, "" for none."""
        return self.frame.get(text_of(element.get("frameId")), "")

    def is_note(self, element: dict[str, Any]) -> bool:
        """Whether an arrow starts or ends at a text: it points something out, and is no branch."""
        ends = (element.get("startBinding"), element.get("endBinding"))
        return element["type"] == "arrow" and any(isinstance(end, dict) and text_of(end.get("elementId")) in self.texts for end in ends)


def text_of(value: Any) -> str:
    """A JSON value as a name: a text, or a number in words; "" for anything else."""
    return value.strip() if isinstance(value, str) else str(value) if isinstance(value, int) and not isinstance(value, bool) else ""


def groups_of(element: dict[str, Any]) -> list[str]:
    """Ids of the groups of one element, innermost first."""
    groups = element.get("groupIds")
    return [group for group in groups if isinstance(group, str)] if isinstance(groups, list) else []
