"""Compile each program once: in memory per bucket, and on disk between runs.

Finished programs lie in the user's cache folder (or in `JAX_COMPILATION_CACHE_DIR`), found by name, shapes, source text,
versions and processor, so that they need no tracing; jax's own cache beside them has to trace a program before it can
find it, and serves the small ones. Where the folder can't be written or a file in it can't be
used, programs are compiled anew and nothing else changes.
"""

import hashlib
import importlib.metadata
import os
import pickle
import platform
import threading
from collections.abc import Callable
from contextlib import nullcontext
from functools import cache, partial
from pathlib import Path
from typing import Any

import jax
from jax.experimental import serialize_executable
from jax.experimental.compilation_cache import compilation_cache
from platformdirs import user_cache_dir


class Program:
    """A compiled function of columns. One that was found on disk proves itself on its first run."""

    def __init__(self, run: Callable, result: Any, remake: Callable[[], "Program"] | None = None):
        self.run = run  # leaves → leaves
        self.result = result  # the pytree of a result, with the leaves' numbers in their places
        self._remake = remake

    def __call__(self, *arguments):
        columns = jax.tree.leaves(arguments)
        remake = self._remake
        leaves = self.run(*columns) if remake is None else self._first_run(columns, remake)
        return jax.tree.map(lambda k: leaves[k], self.result)

    def _first_run(self, columns, remake):
        try:
            leaves = jax.block_until_ready(self.run(*columns))
        except jax.errors.JaxRuntimeError:  # it was read, but does not work here
            made = remake()
            self.run, self.result = made.run, made.result
            leaves = self.run(*columns)
        self._remake = None
        return leaves


_PROGRAMS: dict[tuple, Program] = {}
_MAKING: dict[tuple, threading.Lock] = {}  # whoever asks for a program that another thread makes waits for that one


def compiled(function: Callable, *arguments, name: str, keep: bool = True) -> Program:
    """`function` compiled for arguments of these shapes; the same object for the same shapes. Without `keep` the program
    is not kept on disk: it holds code that the file's name does not tell."""
    leaves, structure = jax.tree_util.tree_flatten(arguments)
    shapes = tuple((leaf.shape, str(leaf.dtype)) for leaf in leaves)
    key = (name, structure, shapes)
    if key not in _PROGRAMS:
        with _MAKING.setdefault(key, threading.Lock()):
            if key not in _PROGRAMS:
                use_disk_cache()
                path = None if not keep else _path(f"{name} {structure} {shapes} {jax.config.jax_enable_x64}")
                columns = [jax.ShapeDtypeStruct(leaf.shape, leaf.dtype) for leaf in leaves]
                make = partial(_make, function, columns, structure, path)
                _PROGRAMS[key] = _read(path, len(leaves), make) or make()
    return _PROGRAMS[key]


def _make(function, columns, structure, path: Path | None) -> Program:
    found = {}

    def flat(*leaves):
        result, found["structure"] = jax.tree_util.tree_flatten(function(*structure.unflatten(leaves)))
        return tuple(result)

    with _OWN_CACHE_ONLY if path is not None else nullcontext():
        run = jax.jit(flat).lower(*columns).compile()
    program = Program(run, found["structure"].unflatten(range(found["structure"].num_leaves)))
    if path is not None:
        _write(path, program)
    return program


class _OwnCacheOnly:
    """Leave jax's cache out: a program that came from there can't be written a second time.
    jax asks once a process whether its cache is on, so it is made to ask again before and after. Several threads may be inside: the last that leaves turns it on again."""

    def __init__(self):
        self._turn, self._inside, self._before = threading.Lock(), 0, True

    def __enter__(self):
        with self._turn:
            self._inside += 1
            if self._inside == 1:
                self._before = jax.config.jax_enable_compilation_cache
                self._set(False)

    def __exit__(self, *why):
        with self._turn:
            self._inside -= 1
            if self._inside == 0:
                self._set(self._before)

    @property
    def allowed(self) -> bool:
        """May programs be kept? As it was chosen, whoever is inside."""
        with self._turn:
            return self._before if self._inside else jax.config.jax_enable_compilation_cache

    def _set(self, on: bool) -> None:
        jax.config.update("jax_enable_compilation_cache", on)
        compilation_cache.reset_cache()


_OWN_CACHE_ONLY = _OwnCacheOnly()


def _read(path: Path | None, count: int, remake: Callable[[], Program]) -> Program | None:
    """The program in this file; None if there is none that can be read."""
    if path is None or not path.exists():
        return None
    try:
        code, result = pickle.loads(path.read_bytes())
        inside, outside = (jax.tree.structure(tree) for tree in (((0,) * count, {}), (0,) * len(jax.tree.leaves(result))))
        return Program(serialize_executable.deserialize_and_load(code, inside, outside), result, remake)
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
    if folder is None or not _OWN_CACHE_ONLY.allowed:
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


def use_disk_cache() -> None:
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
