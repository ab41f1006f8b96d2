"""Programs are compiled once a shape, and kept on disk between runs."""

import jax
import numpy as np

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
        compilation._use_disk_cache()
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
        compilation._use_disk_cache()
        assert jax.config.jax_compilation_cache_dir is None
    finally:
        jax.config.update("jax_compilation_cache_dir", before)
