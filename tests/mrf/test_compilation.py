"""Programs are compiled once a shape, and kept on disk between runs."""

import threading
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import jax
import numpy as np
import pytest

from sketchtree.mrf import compilation
from sketchtree.mrf.compilation import compiled


def _double(x):
    return 2 * x


def test_the_same_shapes_share_one_program():
    one = compiled(_double, np.zeros(3, np.float32), name="double")
    assert compiled(_double, np.ones(3, np.float32), name="double") is one
    assert compiled(_double, np.ones(4, np.float32), name="double") is not one
    np.testing.assert_array_equal(one(np.ones(3, np.float32)), [2, 2, 2])


def test_a_folder_chosen_by_the_user_is_kept(tmp_path, monkeypatch):
    before = jax.config.jax_compilation_cache_dir
    try:
        jax.config.update("jax_compilation_cache_dir", str(tmp_path))
        compilation.use_disk_cache()
        assert jax.config.jax_compilation_cache_dir == str(tmp_path)
    finally:
        jax.config.update("jax_compilation_cache_dir", before)


def test_without_a_writable_folder_nothing_is_kept(monkeypatch, tmp_path):
    before = jax.config.jax_compilation_cache_dir
    blocked = tmp_path / "file"
    blocked.write_text("")
    monkeypatch.setattr(compilation, "user_cache_dir", lambda *a, **k: str(blocked))
    try:
        jax.config.update("jax_compilation_cache_dir", None)
        compilation.use_disk_cache()
        assert jax.config.jax_compilation_cache_dir is None
    finally:
        jax.config.update("jax_compilation_cache_dir", before)


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """A folder of its own, and a memory that forgets."""
    before = jax.config.jax_compilation_cache_dir
    jax.config.update("jax_compilation_cache_dir", str(tmp_path))
    monkeypatch.setattr(compilation, "_PROGRAMS", {})
    yield tmp_path / "programs"
    jax.config.update("jax_compilation_cache_dir", before)


class Pair(NamedTuple):
    """A result with names."""

    half: np.ndarray
    twice: np.ndarray


def test_another_process_finds_the_program_without_tracing(kept):
    traced = []

    def both(x):
        traced.append(1)
        return Pair(x / 2, 2 * x)

    x = np.arange(5, dtype=np.float32)
    made = compiled(both, x, name="both")(x)
    compilation._PROGRAMS.clear()
    found = compiled(both, x, name="both")(x)
    assert len(traced) == len(list(kept.glob("*.pickle"))) == 1
    assert isinstance(found, Pair)
    for a, b in zip(made, found, strict=True):
        np.testing.assert_array_equal(a, b)


def test_a_torn_file_is_made_anew(kept):
    x = np.arange(5, dtype=np.float32)
    compiled(_double, x, name="double")
    (file,) = kept.glob("*.pickle")
    whole = file.read_bytes()
    file.write_bytes(whole[: len(whole) // 2])
    compilation._PROGRAMS.clear()
    np.testing.assert_array_equal(compiled(_double, x, name="double")(x), 2 * x)
    assert len(file.read_bytes()) > len(whole) // 2


def test_another_version_looks_for_another_file(kept, monkeypatch):
    here = compilation._path("double")
    monkeypatch.setattr(compilation, "_surroundings", lambda: "jax of tomorrow")
    assert compilation._path("double") != here


def test_without_a_folder_no_program_is_kept(monkeypatch):
    before = jax.config.jax_compilation_cache_dir
    try:
        jax.config.update("jax_compilation_cache_dir", None)
        assert compilation._path("double") is None
    finally:
        jax.config.update("jax_compilation_cache_dir", before)


def test_a_program_that_does_not_run_is_made_anew(kept):
    def broken(*leaves):
        raise jax.errors.JaxRuntimeError("NOT_FOUND")

    x = np.arange(5, dtype=np.float32)
    made = compiled(_double, x, name="double")
    found = compilation.Program(broken, made.result, lambda: made)
    np.testing.assert_array_equal(found(x), 2 * x)
    np.testing.assert_array_equal(found(x), 2 * x)


def test_a_program_from_jax_s_own_cache_is_not_written_again(kept):
    """Written twice it would lack its functions."""
    jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.0)
    jax.config.update("jax_persistent_cache_min_entry_size_bytes", 0)
    x = np.linspace(0, 1, 3000, dtype=np.float32)
    jax.jit(_double)(x)  # jax has looked at its settings, and taken its cache into use
    for _ in range(2):
        compilation._PROGRAMS.clear()
        jax.clear_caches()
        for file in kept.glob("*.pickle"):
            file.unlink()
        made = compiled(_waves, x, name="waves")(x)
    compilation._PROGRAMS.clear()
    np.testing.assert_array_equal(compiled(_waves, x, name="waves")(x), made)


def _waves(x):
    return jax.lax.fori_loop(0, 9, lambda _, y: jax.numpy.cumsum(jax.numpy.sin(y) + x), x)


def test_who_asks_for_a_program_that_is_being_made_waits_for_that_one(kept):
    traced, begun, waits = [], threading.Event(), threading.Event()

    def slow(x):
        traced.append(1)
        begun.set()
        waits.wait(60)
        return 2 * x

    x = np.arange(6, dtype=np.float32)
    with ThreadPoolExecutor(2) as pool:
        first = pool.submit(compiled, slow, x, name="slow")
        assert begun.wait(60)
        second = pool.submit(compiled, slow, x, name="slow")
        assert not second.done()
        waits.set()
        assert first.result() is second.result() and traced == [1]


def test_programs_made_side_by_side_are_all_kept_and_the_cache_is_on_afterwards(kept):
    inside = threading.Barrier(2, timeout=60)

    def made(factor):
        def times(x):
            inside.wait()
            return factor * x

        return compiled(times, np.arange(7, dtype=np.float32), name=f"times {factor}")

    with ThreadPoolExecutor(2) as pool:
        list(pool.map(made, (2.0, 3.0)))
    assert len(list(kept.glob("*.pickle"))) == 2 and jax.config.jax_enable_compilation_cache
