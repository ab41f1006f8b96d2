"""Which style does an element have? The part of the CSS cascade that decides what a drawing shows.

Declarations win in this order (CSS Cascade 4, §6): presentation attributes, rules of `<style>` elements by
specificity and order, the `style` attribute, then whatever is marked `!important`. Only properties that
matter to reading strokes are kept. Style sheets are never fetched.
"""

from collections.abc import Iterator, Mapping

import cssselect2
import tinycss2
from cssselect2 import ElementWrapper

_INHERITED = frozenset({"fill", "stroke", "stroke-width", "fill-opacity", "stroke-opacity", "visibility", "color", "font-size"})
_OWN = frozenset(
    {"display", "opacity", "transform", "transform-origin", "transform-box", "translate", "rotate", "scale", "vector-effect"}
)
_PRESENTATION = _INHERITED | {"display", "opacity", "transform-origin", "vector-effect"}

Style = Mapping[str, str]


class Cascade:
    """The style sheets of one document: `style(element, inherited)` is the computed style of an element."""

    def __init__(self, root: ElementWrapper):
        self._matcher = cssselect2.Matcher()
        for element in root.iter_subtree():
            if element.local_name == "style" and _for_screen(element.etree_element.get("media", "")):
                self._add(tinycss2.parse_stylesheet(element.etree_element.text or "", True, True))

    def _add(self, rules) -> None:
        for rule in rules:
            if rule.type == "at-rule" and rule.lower_at_keyword == "media" and rule.content is not None:
                if _for_screen(tinycss2.serialize(rule.prelude)):
                    self._add(tinycss2.parse_rule_list(rule.content, True, True))
            elif rule.type == "qualified-rule":
                self._add_rule(rule)

    def _add_rule(self, rule) -> None:
        declarations = list(_declarations(rule.content))
        try:
            selectors = cssselect2.compile_selector_list(rule.prelude)
        except cssselect2.SelectorError:  # CSS says: a rule with a selector one does not know is skipped
            return
        for selector in selectors:
            if selector.pseudo_element is None and not selector.never_matches:
                self._matcher.add_selector(selector, declarations)

    def style(self, element: ElementWrapper, inherited: Style) -> Style:
        """The computed style: property → value as text. `inherited` is the parent's (or the `use`'s)."""
        attributes = element.etree_element.attrib
        layers = [[(name, attributes[name], False) for name in _PRESENTATION & attributes.keys()]]
        layers += [declarations for *_, declarations in self._matcher.match(element)]
        layers.append(list(_declarations(attributes.get("style", ""))))
        own: dict[str, str] = {}
        for important in (False, True):
            for declarations in layers:
                own.update((name, value) for name, value, mark in declarations if mark == important)
        return _computed(own, inherited)


def _computed(own: dict[str, str], inherited: Style) -> Style:
    style = {name: value for name, value in inherited.items() if name in _INHERITED}
    for name, value in own.items():
        keyword = value.lower()
        if keyword == "inherit":
            style.update({name: inherited[name]} if name in inherited else {})
        elif keyword in ("initial", "revert") or (keyword == "unset" and name in _OWN):
            style.pop(name, None)
        elif keyword != "unset":
            style[name] = value
    return style


def _declarations(content) -> Iterator[tuple[str, str, bool]]:
    """(property, value, important) of the declarations we read."""
    for item in tinycss2.parse_blocks_contents(content, True, True):
        if item.type == "declaration" and item.lower_name in _INHERITED | _OWN:
            yield item.lower_name, tinycss2.serialize(item.value).strip(), item.important


def _for_screen(media: str) -> bool:
    queries = [query.lower().replace("only ", "").strip() or "all" for query in media.split(",")]
    return any(query.startswith(("all", "screen", "(")) for query in queries)
