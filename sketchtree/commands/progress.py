"""What a long run says while it works: a bar on a terminal, plain lines elsewhere, JSON on request."""

import json
import sys
import time
from contextlib import contextmanager

PATIENCE = 2.0  # seconds after which a stage says how far it is


class Progress:
    """Told of every stage by name; speaks on stderr only.

    `quiet` says nothing, `json_log` one JSON object a line, a terminal gets a bar, anything else a line a stage.
    """

    def __init__(self, stages: tuple[str, ...], *, quiet: bool = False, json_log: bool = False):
        self._stages = stages
        self._json = json_log
        self._plain = not quiet and not json_log and not sys.stderr.isatty()
        self._bar = None if quiet or json_log or self._plain else _bar(len(stages))
        self._began = self._stage_began = time.perf_counter()
        self._stage, self._now, self._next = "", 0, 0.1

    def __call__(self, stage: str) -> None:
        """A stage begins."""
        self._stage, self._next, self._stage_began = stage, 0.1, time.perf_counter()
        self._now = self._stages.index(stage) if stage in self._stages else self._now
        if self._json:
            _line(event="stage", stage=stage, seconds=round(time.perf_counter() - self._began, 3))
        elif self._plain:
            sys.stderr.write(f"{stage} …\n")
        elif self._bar is not None:
            self._bar.update(0, completed=self._now, description=stage)

    def part(self, done: float) -> None:
        """How much of the present stage is done, 0-1: the bar moves on; without one, a line for every tenth of a long stage."""
        if self._bar is not None:
            self._bar.update(0, completed=self._now + min(max(done, 0.0), 1.0))
        elif (self._plain or self._json) and done >= self._next and time.perf_counter() - self._stage_began > PATIENCE:
            self._next = int(done * 10) / 10 + 0.1
            if self._json:
                _line(event="part", stage=self._stage, done=round(done, 3), seconds=round(time.perf_counter() - self._began, 3))
            else:
                sys.stderr.write(f"{self._stage} … {done:.0%}\n")

    def say(self, text: str, *, event: str = "note", **facts) -> None:
        """A sentence for the user: a warning, or what was written; `facts` go into the JSON beside it."""
        if self._json:
            _line(event=event, text=text, **facts)
        elif self._plain:
            sys.stderr.write(f"{text}\n")
        elif self._bar is not None:
            self._bar.console.print(text, markup=False, highlight=False, soft_wrap=True)

    @contextmanager
    def running(self):
        """Show the bar for as long as the run lasts."""
        if self._bar is None:
            yield self
            return
        with self._bar:
            yield self
            self._bar.update(0, completed=len(self._stages), description="done")


def _bar(total: int):
    from rich.console import Console
    from rich.progress import BarColumn, Progress as RichProgress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description:<10}"), BarColumn(), TimeElapsedColumn())
    bar = RichProgress(*columns, console=Console(stderr=True), transient=False)
    bar.add_task("start", total=total)
    return bar


def _line(**fields) -> None:
    sys.stderr.write(json.dumps(fields) + "\n")
