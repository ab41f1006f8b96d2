"""What the samples say: depths, Θ and their spread, with what tells whether there are enough of them.

Samples are draws of ψ at T = 1 with Θ integrated out; Θ is drawn given each (exactly, it is conjugate; see `conjugate`).
The median-and-stretch answer is a point estimate and no draw; it is never among the samples.
"""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key

from sketchtree.errors import ExportError, InferenceError
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.mrf.answer import diagnostics
from sketchtree.mrf.answer.intervals import Intervals, intervals_of
from sketchtree.mrf.answer.labels import apical_labels
from sketchtree.mrf.compilation import compiled
from sketchtree.mrf.conjugate import draw_theta, theta_names
from sketchtree.mrf.depths import depth_of
from sketchtree.mrf.factor_graph import FactorGraph

_AT_ONCE = 32  # samples whose Θ is looked up by one call of the program


@dataclass(frozen=True, eq=False)
class Posterior:
    """Samples of one drawing's depths, in the order draw, chain."""

    graph: FactorGraph
    elevation: Float[np.ndarray, "draw chain segment"]  # ψ, radians
    value: Float[np.ndarray, "draw chain"]  # E, nats
    answer: Float[np.ndarray, " segment"]  # z of the answer, H = 1: sides are told against it
    model: Any  # the LogPosterior
    key: Key[Array, ""]  # of the draws of Θ

    def __len__(self) -> int:
        return self.value.size

    @cached_property
    def depth(self) -> Float[np.ndarray, "sample segment"]:
        """z of every tip, sketch units."""
        flat = self.elevation.reshape(len(self), -1)
        return depth_of(self.graph, flat.T.astype(np.float64)).T * self.graph.scale

    @property
    def log_posterior(self) -> Float[np.ndarray, " sample"]:
        """E of every sample, nats, up to a constant."""
        return self.value.reshape(-1).astype(np.float64)

    @property
    def steepness(self) -> Float[np.ndarray, "draw chain segment"]:
        """|dz|/|v|, the same for a tree and its mirror image."""
        return np.abs(np.sin(self.elevation.astype(np.float64)))

    @property
    def theta_names(self) -> tuple[str, ...]:
        """What the columns of `theta` are."""
        return theta_names()

    @cached_property
    def theta(self) -> Float[np.ndarray, "sample parameter"]:
        """Θ drawn given each sample's depths."""
        flat = self.elevation.reshape(len(self), -1)
        segments = len(self.model.page.length)
        padded = np.zeros((-(-len(flat) // _AT_ONCE) * _AT_ONCE, segments), self.model.page.length.dtype)
        padded[: len(flat), : flat.shape[1]] = flat
        beliefs = []
        for some in np.split(padded, len(padded) // _AT_ONCE):
            arguments = (self.model, jnp.asarray(some))
            beliefs.append(jax.tree.map(np.asarray, compiled(_updated, *arguments, name="theta", keep=not self.model.own)(*arguments)))
        together = jax.tree.map(lambda *x: np.concatenate(x)[: len(flat)].astype(np.float64), *beliefs)
        return draw_theta(together, numpy_generator(self.key))

    @cached_property
    def apical(self) -> Bool[np.ndarray, "sample segment"]:
        """Whether each segment continues its parent's limb: known from the strokes, drawn where the reader joined two."""
        flat = self.elevation.reshape(len(self), -1).astype(np.float64)
        theta = dict(zip(self.theta_names, self.theta.T, strict=True))
        return apical_labels(self.graph, flat, theta, numpy_generator(stage_key(self.key, "labels")))

    @cached_property
    def rhat(self) -> float:
        """The worst R̂ over |dz|/|v| of all segments and E; NaN with too few draws."""
        return _worst(diagnostics.rhat, self._told, np.nanmax)

    @cached_property
    def ess(self) -> float:
        """The least effective sample size over |dz|/|v| of all segments and E; NaN with too few draws."""
        return _worst(diagnostics.ess, self._told, np.nanmin)

    @property
    def _told(self):
        moving = self.steepness[:, :, ~self.graph.is_base]
        return np.concatenate([moving, self.value[..., None].astype(np.float64)], axis=2)

    @cached_property
    def intervals(self) -> Intervals:
        """Spread of every segment's |dz|/|v|, calibrated, and on which side of the page it lies."""
        return intervals_of(self.graph, self.steepness.reshape(len(self), -1), self.depth / self.graph.scale, self.answer)

    def same_side(self, one: int, other: int) -> float:
        """Share of the samples in which two limbs' tips lie on one side of where their limbs start."""
        start = self.graph.parent[self.graph.limb_first[[one, other]]]
        rise = self.depth[:, self.graph.limb_tip[[one, other]]] - self.depth[:, start]
        return float(np.mean(rise[:, 0] * rise[:, 1] > 0))

    def columns(self, segment_id: Int[np.ndarray, " segment"] | None = None, scale: float = 1.0) -> dict[str, np.ndarray]:
        """What `write` writes: z (sample, segment) in sketch units times `scale`; theta (sample, parameter) and the
        parameters' names; apical (sample, segment); log_posterior and chain (sample); segment_id, by default 1, 2, …"""
        return {
            "z": self.depth * scale,
            "theta": self.theta,
            "parameter": np.array(self.theta_names),
            "apical": self.apical,
            "log_posterior": self.log_posterior,
            "chain": np.tile(np.arange(self.value.shape[1]), self.value.shape[0]),
            "segment_id": np.arange(1, len(self.graph) + 1) if segment_id is None else np.asarray(segment_id)[: len(self.graph)],
        }

    def write(self, path: str | Path, **options) -> None:
        """P.npz with the arrays of `columns`, whose `options` it takes."""
        if Path(path).suffix.lower() != ".npz":
            raise ExportError(f"A posterior is written as .npz, not as {Path(path).name}.", remedy="Let the name end in .npz.")
        with open(path, "wb") as file:
            np.savez_compressed(file, **self.columns(**options))

    def to_arviz(self) -> Any:
        """The samples for the package ArviZ, which has to be installed. Dimensions: chain, draw, segment | parameter."""
        try:
            import arviz
        except ModuleNotFoundError as missing:
            raise InferenceError("The package `arviz` is not installed.", remedy="Install it: pip install arviz.") from missing
        draws, chains = self.value.shape

        def shaped(x):
            return np.moveaxis(x.reshape(draws, chains, -1), 0, 1)

        groups = {
            "posterior": {"z": shaped(self.depth), "steepness": np.moveaxis(self.steepness, 0, 1), "theta": shaped(self.theta)},
            "sample_stats": {"lp": self.value.T.astype(np.float64)},
        }
        rows = np.arange(1, len(self.graph) + 1)
        coords = {"segment": rows, "parameter": list(self.theta_names)}
        dims = {"z": ["segment"], "steepness": ["segment"], "theta": ["parameter"]}
        if hasattr(arviz, "InferenceData"):
            return arviz.from_dict(**groups, coords=coords, dims=dims)
        return arviz.from_dict(groups, coords=coords, dims=dims)


def _updated(model, elevation):
    return jax.vmap(model.updated)(elevation)


def _worst(figure, draws, of):
    found = figure(draws)
    return float(of(found)) if np.isfinite(found).any() else float("nan")
