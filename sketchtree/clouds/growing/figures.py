"""Which figure of a growth is to be another, and what? Texts of people, as on the command line.

    branching=55      a figure of the species, or of how it grows, by name
    internode=0.8x    so many times what it is
    tropism=up        words, where a figure has some

The paper's Figure 13: similar plants by slightly other parameters.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from sketchtree.clouds.growing.species import FIGURES, TROPISM, Species
from sketchtree.clouds.growing.wanted import INFLUENCE, RANGES
from sketchtree.errors import OptionError


@dataclass(frozen=True)
class Figure:
    """What may be changed."""

    says: str
    between: tuple[float, float] | None  # None: words only
    words: Mapping[str, object] = field(default_factory=dict)


KNOWN: dict[str, Figure] = {
    "internode": Figure("l: metres in a box of 10 m", FIGURES["internode"]),
    "roll": Figure("φ: degrees from lateral to lateral", FIGURES["roll"]),
    "branching": Figure("ψ: degrees between a lateral and its shoot", FIGURES["branching"]),
    "gamma": Figure("γ of Eq. 5: how fast wood gets thinner", FIGURES["gamma"]),
    "alpha": Figure("α of Eq. 9: how much points pull", RANGES["alpha"]),
    "beta": Figure("β of Eq. 9: how much the tropism does", RANGES["beta"]),
    "tropism": Figure("V_tropism", None, TROPISM),
    "theta": Figure("θ: degrees of the cone that a bud sees", RANGES["theta"]),
    "influence": Figure("d_i: internodes that a bud looks", INFLUENCE, {"logistic": None}),
    "least": Figure("internodes of a logistic d_i, at least", RANGES["least"]),
    "most": Figure("internodes of a logistic d_i, at most", RANGES["most"]),
    "kill": Figure("d_k / d_i", RANGES["kill"]),
    "start": Figure("H_0 of Eq. 6, internodes", RANGES["start"]),
    "rate": Figure("ρ_0 of Eq. 6", RANGES["rate"]),
    "eps_d": Figure("ε_D of Eq. 8: metres in the box", RANGES["eps_d"]),
    "eps_a": Figure("ε_A of Eq. 8", RANGES["eps_a"]),
    "weights": Figure("weights of Eq. 8", None, {"on": True, "off": False}),
    "spread": Figure("degrees by which angles differ by chance", RANGES["spread"]),
}
"""Every figure by the name that people give it."""

_FIELD = {"weights": "weighted"}  # where it has another name in `Growing`


@dataclass(frozen=True)
class Change:
    """One figure, and what it is to be."""

    name: str
    text: str  # as it was said

    def of(self, kind: Species) -> Species:
        """The species with that figure. Raises OptionError for a value out of range."""
        value = self._value(kind)
        if self.name in FIGURES:
            return replace(kind, **{self.name: value})
        return replace(kind, growing=replace(kind.growing, **{_FIELD.get(self.name, self.name): value}))

    def _value(self, kind: Species):
        figure = KNOWN[self.name]
        if self.text in figure.words:
            return figure.words[self.text]
        number = float(self.text.removesuffix("x"))
        if self.text.endswith("x"):
            now = getattr(kind if self.name in FIGURES else kind.growing, self.name)
            if now is None:
                raise OptionError(f"`{self.name}={self.text}`: there is no number to multiply, since {self.name} is logistic.", remedy="Give internodes.")
            number *= now
        low, high = figure.between
        if not low <= number <= high:
            meant = f", which is {number:g}," if self.text.endswith("x") else ""
            raise OptionError(f"`{self.name}={self.text}`{meant} is out of range.", remedy=f"Give {low:g} to {high:g}.")
        return number


def changes(said: str) -> tuple[Change, ...]:
    """NAME=V1,V2,… Raises OptionError for what there is not, and for a value that no species could have."""
    name, equals, values = said.partition("=")
    name = name.strip()
    if not equals or not values.strip():
        raise OptionError(f"`{said}` names no value.", remedy="Say NAME=VALUE, such as branching=55.")
    if name not in KNOWN:
        raise OptionError(f"No figure of growth is called {name!r}.", remedy=f"Choose one of: {', '.join(KNOWN)}.")
    found = tuple(Change(name, text.strip()) for text in values.split(","))
    for change in found:
        _check(change)
    twice = next((change.text for k, change in enumerate(found) if change in found[:k]), None)
    if twice is not None:
        raise OptionError(f"`{said}` says {twice} twice.", remedy="Say it once.")
    return found


def _check(change: Change) -> None:
    figure, text = KNOWN[change.name], change.text
    if text in figure.words:
        return
    words = " or ".join(figure.words)
    if figure.between is None:
        raise OptionError(f"`{change.name}={text}`: {change.name} is no such thing.", remedy=f"Give {words}.")
    low, high = figure.between
    span = f"{low:g} to {high:g}, or so many times what it is (0.8x)" + (f", or {words}" if words else "")
    try:
        number = float(text.removesuffix("x"))
    except ValueError:
        raise OptionError(f"`{change.name}={text}` is no number.", remedy=f"Give {span}.") from None
    if not math.isfinite(number) or number < 0 or (not text.endswith("x") and not low <= number <= high):
        raise OptionError(f"`{change.name}={text}` is out of range.", remedy=f"Give {span}.")
