"""Does everything work here?

Each check is one thing the program may need, what was found, and what it takes to mend it. A check that fails and is *needed* stops the main job; others
only what they name.
"""

import importlib.metadata
import importlib.util
import os
import platform
import shutil
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

NEEDED, WANTED = "needed", "wanted"

_EXTRAS = (
    ("usd", "pxr", "usd-core", "writing .usd .usda .usdc .usdz"),
    ("solid", "manifold3d", "manifold3d", "--solid"),
    ("cluster", "distributed", "distributed", "--scheduler"),
    ("studio", "starlette", "starlette", "sketchtree studio"),
    ("photo", "sklearn", "scikit-learn", "sketchtree photo"),
    ("photo", "ortools", "ortools", "sketchtree photo"),
    ("growth", "pymatting", "pymatting", "mattes as the papers make them"),
    ("video", "imageio_ffmpeg", "imageio-ffmpeg", "films as .mp4, where the machine has no ffmpeg of its own"),
)  # extra, module, distribution, for what


@dataclass(frozen=True)
class Check:
    """One thing looked at."""

    name: str
    fine: bool
    found: str
    remedy: str = ""
    weight: str = NEEDED

    @property
    def line(self) -> str:
        """One line for a person."""
        mark = "ok     " if self.fine else ("BROKEN " if self.weight == NEEDED else "missing")
        return f"{mark} {self.name}: {self.found}" + (f" {self.remedy}" if self.remedy and not self.fine else "")


def checks() -> Iterator[Check]:
    """All checks, one after the other as they are made."""
    yield Check("Python", sys.version_info >= (3, 11), platform.python_version(), "Use 3.11 or newer.")
    yield from _packages()
    yield _database()
    yield _folder()
    yield _inference()
    yield _picture()
    yield from _extras()
    yield _program("ffmpeg", "films as .mp4")


def _packages() -> Iterator[Check]:
    """Every package this one requires, against the bounds that it states."""
    from packaging.requirements import Requirement

    try:
        required = importlib.metadata.requires("sketchtree") or []
    except importlib.metadata.PackageNotFoundError:
        yield Check("packages", False, "sketchtree is not installed, only found.", "Install it: `pip install .`", WANTED)
        return
    wrong, count = [], 0
    for requirement in map(Requirement, required):
        if requirement.marker is not None and not requirement.marker.evaluate({"extra": ""}):
            continue
        count += 1
        try:
            version = importlib.metadata.version(requirement.name)
        except importlib.metadata.PackageNotFoundError:
            wrong.append(f"{requirement.name} is not installed")
            continue
        if not requirement.specifier.contains(version, prereleases=True):
            wrong.append(f"{requirement.name} {version} is not {requirement.specifier}")
    yield Check("packages", not wrong, "; ".join(wrong) + "." if wrong else f"{count} installed, all within their bounds", "Run `pip install .` again.")


def _database() -> Check:
    from sketchtree.errors import SketchTreeError
    from sketchtree.templates.store.database import Database

    try:
        names = Database.open(None).names
    except SketchTreeError as error:
        return Check("templates", False, str(error))
    return Check("templates", bool(names), f"{len(names)} exemplars", "Install the package again.")


def _folder() -> Check:
    """Compiled programs are kept between runs, so that the next one starts at once."""
    import jax

    from sketchtree.mrf.compilation import use_disk_cache

    use_disk_cache()
    folder = jax.config.jax_compilation_cache_dir
    remedy = "Every run compiles anew, some 5 s. Name a folder in JAX_COMPILATION_CACHE_DIR."
    return Check("compilation cache", folder is not None and os.access(folder, os.W_OK), folder or "no folder can be written.", remedy, WANTED)


def _inference() -> Check:
    try:
        import jax
        import jax.numpy as jnp

        total = float(jnp.arange(4.0).sum())
    except Exception as error:  # whatever a broken installation raises
        return Check("jax", False, f"{type(error).__name__}: {error}.", "Install jax and jaxlib of one version.")
    kind = jax.devices()[0].platform
    return Check("jax", total == 6.0, f"{jax.__version__} on {kind}")


def _picture() -> Check:
    """A picture of one triangle."""
    import numpy as np

    from sketchtree.geometry.mesh import Material, Mesh
    from sketchtree.view import preview

    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    mesh = Mesh("wood", corners, np.tile([[0.0, 0, 1]], (3, 1)), corners[:, :2], np.array([[0, 1, 2]]), Material("wood"))
    with tempfile.TemporaryDirectory(prefix="sketchtree-doctor-") as folder:
        drawn, reason = preview([mesh], Path(folder) / "p.png", size=(64, 48), timeout=60.0)
    return Check("pictures", drawn, "OpenGL off screen" if drawn else reason, "", WANTED)


def _extras() -> Iterator[Check]:
    for extra, module, distribution, purpose in _EXTRAS:
        there = importlib.util.find_spec(module) is not None
        found = f"{distribution} {importlib.metadata.version(distribution)}, for {purpose}" if there else f"for {purpose}."
        yield Check(extra, there, found, f"`pip install 'sketchtree[{extra}]'`", WANTED)


def _program(name: str, purpose: str) -> Check:
    there = shutil.which(name) is not None
    return Check(name, there, f"for {purpose}" + ("" if there else "."), f"Install the program `{name}`.", WANTED)
