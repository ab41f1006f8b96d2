"""What do the numbers of an InkML trace mean? Its channels: position, force and time, their units and ranges.

    pressure   (F − min) / (max − min), max the largest F of the file where none is given
    y          × resolution of x / resolution of y, where a digitizer's axes differ: circles stay round
    time       T in milliseconds, after the trace's own offset

Channels of other names (tilt, buttons …) are not read. Y grows downwards unless its orientation is "-ve".
"""

from dataclasses import dataclass
from xml.etree.ElementTree import Element

import numpy as np
from jaxtyping import Float

METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "in": 0.0254, "pt": 0.0254 / 72, "pc": 0.0254 / 6, "himetric": 1e-5}
SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
_MILLISECOND = 1e-3


@dataclass(frozen=True)
class Channel:
    """One column of a trace."""

    name: str  # X, Y, F, T …
    low: float | None = None
    high: float | None = None
    units: str | None = None
    flipped: bool = False  # its orientation is "-ve"
    resolution: float | None = None  # values per metre, or per second


@dataclass(frozen=True)
class TraceFormat:
    """The columns of a trace: the regular channels stand in every point, the others may be left away."""

    regular: tuple[Channel, ...] = (Channel("X"), Channel("Y"))
    intermittent: tuple[Channel, ...] = ()
    absolute_time: bool = False  # T counts from a time stamp and not from the trace's start

    def column(self, name: str) -> int | None:
        """Where a channel stands; None if the trace has none of that name."""
        return next((k for k, channel in enumerate(self.regular + self.intermittent) if channel.name == name), None)

    def channel(self, name: str) -> Channel | None:
        """The channel of that name, if there is one."""
        column = self.column(name)
        return None if column is None else (self.regular + self.intermittent)[column]


def trace_format(element: Element, properties: dict[tuple[str, str], tuple[float, str]]) -> TraceFormat:
    """A `traceFormat` element. `properties` are the source's: (channel, property) → (value, units).

    Raises ValueError, with words that fit after "in FILE, ", when a trace of it could not be placed.
    """
    regular, intermittent = [], []
    absolute = False
    for child in element:
        tag = local(child)
        inner = [child] if tag == "channel" else [c for c in child if local(c) == "channel"]
        for channel in inner:
            (intermittent if tag == "intermittentChannels" else regular).append(_channel(channel, properties))
            absolute |= bool(channel.get("respectTo")) and channel.get("name") == "T"
    names = [channel.name for channel in regular + intermittent]
    if not {"X", "Y"} <= {channel.name for channel in regular}:
        raise ValueError(f"a trace format has the channels {', '.join(names) or 'none'}; X and Y were expected")
    return TraceFormat(tuple(regular), tuple(intermittent), absolute)


def _channel(element: Element, properties: dict[tuple[str, str], tuple[float, str]]) -> Channel:
    name = (element.get("name") or "").strip()
    name = name.upper() if name.upper() in ("X", "Y", "F", "T") else name
    given = properties.get((name, "resolution"))
    per = None
    if given and given[0] > 0 and given[1].startswith("1/"):
        per = METRES.get(given[1][2:], SECONDS.get(given[1][2:]))
    return Channel(
        name,
        number(element.get("min")),
        number(element.get("max")),
        (element.get("units") or "").strip() or None,
        (element.get("orientation") or "").strip() == "-ve",
        given[0] / per if given and per else None,
    )


def per_metre(channel: Channel) -> float | None:
    """How many of a channel's values make a metre; None where the file does not say."""
    if channel.resolution:
        return channel.resolution
    return 1.0 / METRES[channel.units] if channel.units in METRES else None


def positions(table: Float[np.ndarray, "point channel"], form: TraceFormat) -> Float[np.ndarray, "point 2"]:
    """Points in the units of X, y UP; NaN where the pen's place is not known."""
    x, y = table[:, form.column("X")], -table[:, form.column("Y")]
    along, across = form.channel("X"), form.channel("Y")
    if along.resolution and across.resolution:
        y = y * (along.resolution / across.resolution)
    return np.column_stack([-x if along.flipped else x, -y if across.flipped else y])


def forces(table: Float[np.ndarray, "point channel"], form: TraceFormat, largest: float) -> Float[np.ndarray, " point"] | None:
    """Pressure 0-1 at every point; None without a force channel. `largest` is the greatest F of the file."""
    channel = form.channel("F")
    if channel is None or np.isnan(force := table[:, form.column("F")]).all():
        return None
    low = channel.low or 0.0
    high = channel.high if channel.high is not None else max(largest, 1.0)
    force = np.clip((force - low) / (high - low), 0.0, 1.0) if high > low else np.ones(len(table))
    return np.where(np.isnan(force), np.nanmedian(force), force)


def times(table: Float[np.ndarray, "point channel"], form: TraceFormat, begin: float | None, lasts: float | None) -> np.ndarray | None:
    """Milliseconds at every point, from the T channel, or spread over what the trace says it lasts; None without either.

    `begin` is when the trace began, `lasts` how long it took, both in milliseconds.
    """
    channel = form.channel("T")
    if channel is not None and np.isfinite(clock := table[:, form.column("T")]).all():
        unit = SECONDS.get(channel.units or "ms", _MILLISECOND)
        unit = 1.0 / channel.resolution if channel.resolution else unit
        return clock * (unit / _MILLISECOND) + (0.0 if form.absolute_time else begin or 0.0)
    if begin is not None and lasts is not None:
        return begin + np.linspace(0.0, lasts, len(table))
    return None


def local(element: Element) -> str:
    """The element's name without its namespace; "" for comments and instructions."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def number(text: str | None) -> float | None:
    """A finite number, or None."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        return None
    return value if np.isfinite(value) else None
