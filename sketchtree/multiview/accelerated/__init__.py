"""How is PatchMatch worked out where there is a GPU? The same search as `patchmatch`, all pixels of one colour at once, by jax."""
