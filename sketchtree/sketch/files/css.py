"""Which style does an element have? The part of the CSS cascade that decides what a drawing shows.

Declarations win in this order (CSS Cascade 4, §6): presentation attributes, rules of `<style>` elements by
specificity and order, the `style` attribute, then whatever is marked `!important`. Custom properties (`--ink`) are
inherited and put in where `var()` asks for them. Only properties that matter to reading strokes are kept. Style
sheets of other files are never fetched. What of a style is not read is told.
"""

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from functools import lru_cache
from xml.etree.ElementTree import Element

import cssselect2
import tinycss2
from cssselect2 import ElementWrapper

from sketchtree.sketch.files.document import local_name

_INHERITED = frozenset(
    {"fill", "stroke", "stroke-width", "fill-opacity", "stroke-opacity", "visibility", "color", "font-size", "fill-rule", "clip-rule"}
)
GEOMETRY = frozenset({"d", "x", "y", "cx", "cy", "r", "rx", "ry", "width", "height"})  # SVG 2: attributes that CSS may set
_OWN = frozenset(
    {"display", "opacity", "transform", "transform-origin", "transform-box", "translate", "rotate", "scale", "vector-effect"}
    | {"clip-path", "mask", "mask-type", "overflow"}
) | GEOMETRY
_READ = _INHERITED | _OWN
_PRESENTATION = _INHERITED | {"display", "opacity", "transform-origin", "vector-effect", "clip-path", "mask", "mask-type", "overflow"}
_SIMPLE = re.compile(r"[^\"'\\(){}\[\]/@<]*")  # a style attribute that colons and semicolons alone divide
_VARIABLE = re.compile(r"var\(\s*(--[^\s,()]+)\s*(?:,([^()]*(?:\([^()]*\)[^()]*)*))?\)", re.IGNORECASE)
_LONGEST = 10_000  # characters of a value once its variables are put in
_MOST_SIBLINGS = 500  # elements in one group up to which selectors that look at all of them are tried
_GROUPED = frozenset({"supports", "layer", "container", "scope", "starting-style"})  # at-rules around others, not read
_LONGEST_SHEET = 1_000_000  # characters of all sheets, what is embedded in them (fonts) left out
_LONGEST_SELECTOR = 5_000  # … of the selectors of one rule
_LONGEST_STYLE = 100_000  # … of one `style` attribute
_MOST_TRIED = 5_000_000  # rules for the same name, class or id × elements
_EMBEDDED = re.compile(r"data:[^\s\"')]{80,}")
_NO_STYLE = "{} is too long, or nests its brackets too deep; {} was left out."
_LOOKS_AROUND = re.compile(r"~(?!=)|-of-type|:nth-last", re.IGNORECASE)
_LOOKS_INSIDE = re.compile(r":has\(", re.IGNORECASE)

Style = Mapping[str, str]
Declarations = tuple[tuple[str, str, bool], ...]  # (property, value, important)


class Cascade:
    """The style sheets of one document: `style(element, inherited)` is the computed style of an element."""

    def __init__(self, root: Element):
        self._told: dict[str, None] = {}  # an ordered set
        self._deep: dict[Element, None] = {}  # … of elements whose own style can't be read
        self._unread: dict[str, list[str]] = {}  # why → rules that were left out
        self._matcher = cssselect2.Matcher()
        self._rules: Counter[str] = Counter()  # by the id, class or name they are for
        self._most = max(_MOST_TRIED // sum(1 for _ in root.iter()), 100)
        self._length = 0
        self._siblings = False  # whether a selector looks at the elements before one
        sheets = [element for element in root.iter() if local_name(element.tag) == "style"]
        self._crowded = bool(sheets) and max(len(element) for element in root.iter()) > _MOST_SIBLINGS
        for element in sheets:
            if element.get("type", "text/css").strip() in ("", "text/css") and _for_screen(element.get("media", "")):
                self._add_sheet(element.text or "")
        self._wrapper: dict[Element, ElementWrapper] = {}
        if self._rules:
            self._wrapper = {e.etree_element: e for e in ElementWrapper.from_xml_root(root).iter_subtree()}
        if self._siblings:
            for wrapper in self._wrapper.values():
                _ = wrapper.previous_siblings  # kept there; asked of the last first, it would call itself for each

    def _add_sheet(self, text: str) -> None:
        text = _EMBEDDED.sub("", text)
        self._length += len(text)
        try:
            if self._length > _LONGEST_SHEET:
                raise RecursionError
            self._add(tinycss2.parse_stylesheet(text, True, True))
        except RecursionError:
            self._told[_NO_STYLE.format("A style sheet", "the rest of it")] = None

    @property
    def warnings(self) -> list[str]:
        """What was left out, a line for every reason."""
        found = [*self._told, *(_said(rules, why) for why, rules in self._unread.items())]
        if self._deep:
            first = next(iter(self._deep))
            whose = f"'{first.get('id', '')[:40]}'" if first.get("id") else f"a <{local_name(first.tag)}>"
            more = f" (and of {len(self._deep) - 1} more)" if len(self._deep) > 1 else ""
            found.append(_NO_STYLE.format(f"The style of {whose}{more}", "it"))
        return found

    def _add(self, rules) -> None:
        for rule in rules:
            if rule.type == "at-rule" and rule.lower_at_keyword == "media" and rule.content is not None:
                if _for_screen(tinycss2.serialize(rule.prelude)):
                    self._add(tinycss2.parse_rule_list(rule.content, True, True))
            elif rule.type == "at-rule" and rule.lower_at_keyword == "import":
                self._told["A style sheet of another file was left out; lines may look other than drawn."] = None
            elif rule.type == "at-rule" and rule.lower_at_keyword in _GROUPED and rule.content is not None:
                self._leave(f"@{rule.lower_at_keyword}{tinycss2.serialize(rule.prelude)}", "at-rules of its kind are not read")
            elif rule.type == "qualified-rule":
                self._add_rule(rule)

    def _add_rule(self, rule) -> None:
        items = tinycss2.parse_blocks_contents(rule.content, True, True)
        declarations, prelude = _declarations(items), tinycss2.serialize(rule.prelude)
        for inner in (item for item in items if item.type == "qualified-rule"):
            self._leave(tinycss2.serialize(inner.prelude), "rules inside rules are not read")
        if len(prelude) > _LONGEST_SELECTOR:
            self._leave(prelude, "its selector is too long")
            return
        if _LOOKS_INSIDE.search(prelude):
            self._leave(prelude, "selectors that look inside are not read")
            return
        if self._crowded and _LOOKS_AROUND.search(prelude):
            self._leave(prelude, "it compares too many elements with each other")
            return
        try:
            selectors = cssselect2.compile_selector_list(rule.prelude)
        except cssselect2.SelectorError:  # CSS says: a rule with a selector one does not know is skipped
            if declarations:
                self._leave(prelude, "its selector is not understood")
            return
        for selector in selectors:
            if declarations and selector.pseudo_element is None and not selector.never_matches:
                self._add_selector(selector, declarations, prelude)

    def _add_selector(self, selector, declarations: Declarations, prelude: str) -> None:
        self._siblings |= "~" in prelude
        key = selector.id or selector.class_name or selector.local_name or ""
        self._rules[key] += 1
        if self._rules[key] > self._most:
            self._leave(prelude, f"more than {self._most} others are for the same elements")
            return
        self._matcher.add_selector(selector, declarations)

    def _leave(self, rule: str, why: str) -> None:
        self._unread.setdefault(why, []).append(rule.strip()[:40])

    def style(self, element: Element, inherited: Style) -> Style:
        """The computed style: property → value as text. `inherited` is the parent's (or the `use`'s)."""
        attributes = element.attrib
        layers: list = [[(name, attributes[name], False) for name in attributes if name in _PRESENTATION]]
        if self._rules:
            layers += [declarations for *_, declarations in self._matcher.match(self._wrapper[element])]
        if "style" in attributes:
            layers.append(self._own(element))
        own: dict[str, str] = {name: value for layer in layers for name, value, mark in layer if not mark}
        own.update((name, value) for layer in layers for name, value, mark in layer if mark)
        return _computed(own, inherited)

    def _own(self, element: Element) -> Declarations:
        """The declarations of its `style` attribute."""
        found = _of_attribute(element.attrib["style"])
        if found is None:
            self._deep[element] = None
        return found or ()


def _said(rules: list[str], why: str) -> str:
    more = f" (and {len(rules) - 1} more of them) was" if len(rules) > 1 else " was"
    return f"The style rule '{rules[0]}'{more} left out: {why}."


def geometry(style: Style) -> dict[str, str]:
    """What a style says of a shape's geometry, as attributes."""
    found = {name: style[name] for name in GEOMETRY & style.keys()}
    if "d" in found:
        data = found.pop("d").strip()
        if data.startswith("path(") and data.endswith(")"):
            found["d"] = data[5:-1].strip(" \"'")
    return found


def _computed(own: dict[str, str], inherited: Style) -> Style:
    style = {name: value for name, value in inherited.items() if name in _INHERITED or name[:2] == "--"}
    variables = {name: value for name, value in own.items() if name[:2] == "--"}
    style.update(variables)
    for name, value in own.items():
        if name in variables:
            continue
        if "var(" in value:
            value = _with_variables(value, style)
        keyword = value.strip().lower()
        if keyword == "inherit":
            style.update({name: inherited[name]} if name in inherited else {})
        elif keyword in ("initial", "revert") or (keyword in ("unset", "") and name in _OWN):
            style.pop(name, None)
        elif keyword not in ("unset", ""):
            style[name] = value
    return style


def _with_variables(value: str, style: Style) -> str:
    """The value with every `var(--name, fallback)` put in; "" (as if it were not there) if one is missing or they never end."""
    for _ in range(20):
        if len(value) > _LONGEST:
            return ""
        found = list(_VARIABLE.finditer(value))
        if not found:
            return value
        if any(match[1] not in style and match[2] is None for match in found):
            return ""
        value = _VARIABLE.sub(lambda match: style.get(match[1], match[2] or "").strip(), value)
    return ""


@lru_cache(maxsize=4096)
def _of_attribute(text: str) -> Declarations | None:
    """The declarations of a `style` attribute; drawings repeat few of them often. None for one without end."""
    if len(text) > _LONGEST_STYLE:
        return None
    if not _SIMPLE.fullmatch(text):
        try:
            return _declarations(tinycss2.parse_blocks_contents(text, True, True))
        except RecursionError:
            return None
    found = []
    for part in text.split(";"):
        name, colon, value = part.partition(":")
        name, (value, mark, _) = name.strip(), value.partition("!")
        if colon and (name.lower() in _READ or name[:2] == "--"):
            found.append((name if name[:2] == "--" else name.lower(), value.strip(), bool(mark)))
    return tuple(found)


def _declarations(items) -> Declarations:
    """The declarations we read."""
    return tuple(_read(items))


def _read(items) -> Iterator[tuple[str, str, bool]]:
    for item in items:
        if item.type == "declaration" and (item.lower_name in _READ or item.name[:2] == "--"):
            name = item.name if item.name[:2] == "--" else item.lower_name
            yield name, tinycss2.serialize(item.value).strip(), item.important


def _for_screen(media: str) -> bool:
    """Whether a media query holds for a bright screen; what can't be told (widths, resolutions) holds."""
    return any(_holds(query.lower().strip()) for query in media.split(","))


def _holds(query: str) -> bool:
    query, negated = query.removeprefix("only ").strip() or "all", query.startswith("not ")
    query = query.removeprefix("not ").strip()
    dark = re.search(r"prefers-color-scheme\s*:\s*dark", query) is not None
    return (query.startswith(("all", "screen", "(")) and not dark) != negated
