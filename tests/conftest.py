"""What every test shares: shapes are checked, and nothing a test compiles or caches outlives it."""

import os

os.environ.setdefault("JAX_PLATFORMS", "cpu")

from jaxtyping import install_import_hook  # noqa: E402

_HOOK = install_import_hook(
    ["sketchtree.traverse", "sketchtree.keys", "sketchtree.similarity"], "beartype.beartype"
)
