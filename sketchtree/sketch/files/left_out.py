"""What of a file is no stroke? Counted while reading, told in one sentence."""

from collections import Counter

_PLURAL = {
    "a hidden shape": "{} hidden shapes",
    "a text": "{} texts",
    "a picture": "{} pictures",
    "a shape outside its clip": "{} shapes outside their clips",
    "a shape without fill or stroke": "{} shapes without fill or stroke",
    "a clone of nothing": "{} clones of nothing",
    "a clone of what it lies in": "{} clones of what they lie in",
    "an embedded page": "{} embedded pages",
    "a spoilt record": "{} spoilt records",
}


class LeftOut:
    """Counts of what was left out, by what it is."""

    def __init__(self):
        self._counts: Counter[str] = Counter()

    def add(self, what: str, count: int = 1) -> None:
        """`what` with its article, one of the names above."""
        assert what in _PLURAL
        self._counts[what] += count

    def sentence(self) -> tuple[str, ...]:
        """One warning, or none: "3 hidden shapes, 2 texts and a picture were left out."."""
        parts = [what if n == 1 else _PLURAL[what].format(n) for what, n in self._counts.items() if n]
        if not parts:
            return ()
        listed = parts[0] if len(parts) == 1 else ", ".join(parts[:-1]) + " and " + parts[-1]
        total = sum(self._counts.values())
        return (listed[0].upper() + listed[1:] + (" was left out." if total == 1 else " were left out."),)
