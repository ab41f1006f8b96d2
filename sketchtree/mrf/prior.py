"""What is believed about the tree before its depths are known.

Two views of the same belief: Chen's Θ (§4), which the method `chen` uses, and hyperparameters per branching order, which the
default method learns Θ under (`conjugate.limb_prior`): the generic ones or those learnt from a folder of trees,
moved by the limb statistics of an exemplar.
"""

import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from sketchtree.errors import InferenceError, SketchTreeError, TemplateError
from sketchtree.parameters import GENERIC, LimbStatistics, TreeParameters
from sketchtree.skeleton import TreeSkeleton

_FORMAT = 1


@dataclass(frozen=True, eq=False)
class Prior:
    """Θ of the matched exemplar, and its limbs' statistics (None: a tree of no particular kind)."""

    theta: TreeParameters = GENERIC
    limbs: LimbStatistics | None = None
    belief: Any = None  # hyperparameters, a `conjugate.LimbBelief`; None: the generic ones

    @classmethod
    def from_skeletons(cls, trees: str | Path | Iterable[TreeSkeleton]) -> "Prior":
        """A prior learnt from trees with known depths: skeletons, or a folder of .swc, .json or .npz files (see `learn`)."""
        from sketchtree.mrf.learn import learnt_prior

        return learnt_prior(trees)

    def save(self, path: str | Path) -> None:
        """Write the prior as JSON. Raises `TemplateError` where that is not possible."""
        content: dict[str, Any] = {"sketchtree_prior": _FORMAT, "theta": self.theta.as_dict()}
        content["limbs"] = None if self.limbs is None else {k: np.asarray(v).tolist() for k, v in vars(self.limbs).items()}
        content["belief"] = None if self.belief is None else {k: np.asarray(v).tolist() for k, v in vars(self.belief).items()}
        try:
            Path(path).write_text(json.dumps(content, indent=1) + "\n")
        except OSError as error:
            raise TemplateError(f"Can't write {path}: {(error.strerror or 'unknown error').lower()}.", remedy="Choose another place.") from error

    @classmethod
    def load(cls, path: str | Path) -> "Prior":
        """The prior that `save` wrote. Raises `TemplateError` where the file is none, or its numbers are no prior."""
        from sketchtree.mrf.conjugate import LimbBelief, checked_belief

        try:
            content = json.loads(Path(path).read_text())
            version = content["sketchtree_prior"]
        except OSError as error:
            raise TemplateError(f"Can't read {path}: {(error.strerror or 'unknown error').lower()}.", remedy="Check the path.") from error
        except (ValueError, KeyError, TypeError) as error:
            raise TemplateError(f"{path} is not a prior of ours.", remedy="Give a file written by `Prior.save`.") from error
        if version != _FORMAT:
            raise TemplateError(f"{path} has prior format {version}; this version reads {_FORMAT}.", remedy="Update sketchtree.")
        try:
            theta = checked_theta(TreeParameters(**content["theta"]))
            limbs = content["limbs"] and LimbStatistics(**{k: np.array(v) for k, v in content["limbs"].items()})
            belief = content["belief"] and checked_belief(LimbBelief(**{k: np.array(v, float) for k, v in content["belief"].items()}))
        except SketchTreeError as error:
            raise TemplateError(f"{path}: {error.message}", remedy=error.remedy) from error
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise TemplateError(f"{path} is a prior with missing or misspelt parts.", remedy="Give a file written by `Prior.save`.") from error
        return cls(theta, limbs or None, belief or None)


def checked_theta(theta: TreeParameters) -> TreeParameters:
    """Θ itself. Raises `InferenceError` naming the parameter that is not finite, or the σ that is not positive."""
    for name, value in theta.as_dict().items():
        if not np.isfinite(value) or name.startswith("sigma") and value <= 0:
            raise InferenceError(f"`{name}` of Θ is {value}.", remedy="Give finite numbers; every σ above 0.")
    return theta
