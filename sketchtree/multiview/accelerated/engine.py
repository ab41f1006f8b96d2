"""What works PatchMatch out: numba, or jax?

jax where it has a GPU, else numba. Both try the same planes in the same order, with the same numbers drawn by chance.
"""

import jax

from sketchtree.errors import OptionError

ENGINES = ("auto", "numba", "jax")


def engine_of(wanted: str) -> str:
    """`numba` or `jax`, as wanted. Raises OptionError for any other."""
    if wanted not in ENGINES:
        raise OptionError(f"There is no engine called {wanted!r}.", remedy=f"Choose one of: {', '.join(ENGINES)}.")
    if wanted != "auto":
        return wanted
    return "jax" if jax.default_backend() == "gpu" else "numba"
