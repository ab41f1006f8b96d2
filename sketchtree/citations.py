"""Whose methods are these? The works that this program stands on, and how to cite them and it."""

from dataclasses import dataclass

from sketchtree.version import __version__


@dataclass(frozen=True)
class Work:
    """One publication."""

    key: str
    authors: tuple[str, ...]
    title: str
    where: str  # journal or proceedings
    year: int
    serves: str  # what we use it for
    volume: str = ""
    number: str = ""

    @property
    def line(self) -> str:
        """One line of text."""
        place = ", ".join(part for part in (self.where, f"{self.volume} ({self.number})" if self.number else self.volume) if part)
        return f"{', '.join(self.authors)} ({self.year}): {self.title}. {place}."

    @property
    def bibtex(self) -> str:
        """An entry for BibTeX."""
        kind, holder = ("inproceedings", "booktitle") if self.where.startswith("Proceedings") else ("article", "journal")
        fields = {"author": " and ".join(self.authors), "title": f"{{{self.title}}}", holder: self.where, "year": str(self.year)}
        fields |= {name: value for name, value in (("volume", self.volume), ("number", self.number)) if value}
        body = ",\n".join(f"  {name} = {{{value}}}" for name, value in fields.items())
        return f"@{kind}{{{self.key},\n{body}\n}}"


WORKS = (
    Work("chen2008sketch", ("Xuejin Chen", "Boris Neubert", "Ying-Qing Xu", "Oliver Deussen", "Sing Bing Kang"),
         "Sketch-Based Tree Modeling Using Markov Random Field", "ACM Transactions on Graphics", 2008,
         "reading depths off a sketch, templates, replication blocks; `--method chen`", "27", "5"),
    Work("tan2008single", ("Ping Tan", "Tian Fang", "Jianxiong Xiao", "Peng Zhao", "Long Quan"),
         "Single Image Tree Modeling", "ACM Transactions on Graphics", 2008,
         "`sketchtree photo`: foliage, tracing, growth by attractors", "27", "5"),
    Work("okabe2005interactive", ("Makoto Okabe", "Shigeru Owada", "Takeo Igarashi"),
         "Interactive Design of Botanical Trees Using Freehand Sketches and Example-Based Editing", "Computer Graphics Forum", 2005,
         "`--method okabe`", "24", "3"),
    Work("wang2008rotation", ("Wenping Wang", "Bert Jüttler", "Dayue Zheng", "Yang Liu"),
         "Computation of Rotation Minimizing Frames", "ACM Transactions on Graphics", 2008, "frames along limbs", "27", "1"),
)  # fmt: skip
"""Works in the order of what they matter to a result."""

PROGRAM_KEY = "sketchtree"


def program_line() -> str:
    """This program, as one line of text."""
    return f"SketchTree developers: SketchTree, version {__version__}. Freehand strokes in, a complete textured 3D tree out."


def program_bibtex() -> str:
    """This program, for BibTeX."""
    fields = {"author": "{SketchTree developers}", "title": "{SketchTree}: freehand strokes in, a complete textured {3D} tree out", "version": __version__}
    body = ",\n".join(f"  {name} = {{{value}}}" for name, value in fields.items())
    return f"@software{{{PROGRAM_KEY},\n{body}\n}}"


def works_for(command: str | None, method: str | None = None) -> tuple[Work, ...]:
    """The works behind a run of that command with that `--method` (of a photo: `--lift`); all for None."""
    if command is None:
        return WORKS
    unused = {"okabe2005interactive": method != "okabe", "tan2008single": command != "photo"}
    return tuple(work for work in WORKS if not unused.get(work.key, False))
