"""Compile each program once: in memory per bucket, and on disk between runs.

Two caches lie in the user's cache folder (or in `JAX_COMPILATION_CACHE_DIR`): jax's own, which still has to trace a
program before it can find it, and beside it the finished programs of this module, which are found by name, shapes,
source text, versions and processor, and need no tracing. Where the folder can't be written or a file in it can't be
used, programs are compiled anew and nothing else changes.
"""

import hashlib
import importlib.metadata
import os
import pickle
import platform
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import jax
from jax.experimental import serialize_executable
from jax.experimental.compilation_cache import compilation_cache
from platformdirs import user_cache_dir


class Program(NamedTuple):
    """A compiled function of columns."""

    run: Callable  # leaves → leaves
    result: Any  # the pytree of a result, with the leaves' numbers in their places

    def __call__(self, *arguments):
        leaves = self.run(*jax.tree.leaves(arguments))
        return jax.tree.map(lambda k: leaves[k], self.result)


_PROGRAMS: dict[tuple, Program] = {}


def compiled(function: Callable, *arguments, name: str) -> Program:
    """`function` compiled for arguments of these shapes; the same object for the same shapes."""
    leaves, structure = jax.tree_util.tree_flatten(arguments)
    shapes = tuple((leaf.shape, str(leaf.dtype)) for leaf in leaves)
    key = (name, structure, shapes)
    if key not in _PROGRAMS:
        _use_disk_cache()
        path = _path(f"{name} {structure} {shapes} {jax.config.jax_enable_x64}")
        _PROGRAMS[key] = _read(path, len(leaves)) or _make(function, leaves, structure, path)
    return _PROGRAMS[key]


def _make(function, leaves, structure, path: Path | None) -> Program:
    found = {}

    def flat(*columns):
        result, found["structure"] = jax.tree_util.tree_flatten(function(*structure.unflatten(columns)))
        return tuple(result)

    run = jax.jit(flat).lower(*leaves).compile()
    program = Program(run, found["structure"].unflatten(range(found["structure"].num_leaves)))
    if path is not None:
        _write(path, program)
    return program


def _read(path: Path | None, count: int) -> Program | None:
    """The program in this file; None if there is none that runs here."""
    if path is None or not path.exists():
        return None
    try:
        code, result = pickle.loads(path.read_bytes())
        inside, outside = (jax.tree.structure(tree) for tree in (((0,) * count, {}), (0,) * len(jax.tree.leaves(result))))
        return Program(serialize_executable.deserialize_and_load(code, inside, outside), result)
    except Exception:  # torn, foreign or outdated: made anew
        return None


def _write(path: Path, program: Program) -> None:
    """Under another name first, so that a reader never sees half of it."""
    part = path.with_suffix(f".{os.getpid()}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part.write_bytes(pickle.dumps((serialize_executable.serialize(program.run)[0], program.result)))
        part.replace(path)
    except Exception:  # a full disk, or a program of a kind that can't be kept
        part.unlink(missing_ok=True)


def _path(signature: str) -> Path | None:
    """Where a program of this signature is kept; None: nowhere."""
    folder = jax.config.jax_compilation_cache_dir
    if folder is None or not jax.config.jax_enable_compilation_cache:
        return None
    digest = hashlib.blake2b(f"{signature} {_surroundings()}".encode(), digest_size=16).hexdigest()
    return Path(folder) / "programs" / f"{digest}.pickle"


@cache
def _surroundings() -> str:
    """All that a finished program depends on besides its arguments."""
    sources = b"".join(path.read_bytes() for path in sorted(Path(__file__).parent.rglob("*.py")))
    versions = [importlib.metadata.version(name) for name in ("jax", "jaxlib", "equinox")]
    processor = Path("/proc/cpuinfo")
    lines = processor.read_text().splitlines() if processor.exists() else [platform.processor()]
    features = next((line for line in lines if line.startswith(("flags", "Features"))), lines[0])
    flags = [os.environ.get("XLA_FLAGS", ""), jax.default_backend(), platform.machine(), platform.system()]
    return " ".join([hashlib.blake2b(sources).hexdigest(), *versions, features, *flags])


def _use_disk_cache() -> None:
    """Point jax at the user's cache folder, unless a folder was chosen already (`JAX_COMPILATION_CACHE_DIR`)."""
    if jax.config.jax_compilation_cache_dir is not None:
        return
    folder = Path(user_cache_dir("sketchtree", appauthor=False)) / "jax"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return
    if os.access(folder, os.W_OK):
        compilation_cache.reset_cache()  # it may have looked for a folder before there was one
        jax.config.update("jax_compilation_cache_dir", str(folder))
        jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.0)
        jax.config.update("jax_persistent_cache_min_entry_size_bytes", 0)
