"""Compile each program once: in memory per bucket, and on disk between runs.

The disk cache is jax's own, in the user's cache folder; where that can't be written, programs are compiled
anew in every process and nothing else changes.
"""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jax
from jax.experimental.compilation_cache import compilation_cache
from platformdirs import user_cache_dir

_PROGRAMS: dict[tuple, Any] = {}


def compiled(function: Callable, *arguments, name: str) -> Callable:
    """`function` compiled for arguments of these shapes; the same object for the same shapes."""
    leaves, structure = jax.tree_util.tree_flatten(arguments)
    key = (name, structure, tuple((leaf.shape, str(leaf.dtype)) for leaf in leaves))
    if key not in _PROGRAMS:
        _use_disk_cache()
        _PROGRAMS[key] = jax.jit(function).lower(*arguments).compile()
    return _PROGRAMS[key]


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
