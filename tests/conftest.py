"""What every test shares: shapes are checked, and nothing a test compiles or caches outlives it."""

import atexit
import os
import tempfile

os.environ.setdefault("JAX_PLATFORMS", "cpu")
_STOCK = tempfile.TemporaryDirectory(prefix="sketchtree-stock-")  # what the studio keeps for its next start
atexit.register(_STOCK.cleanup)
os.environ["SKETCHTREE_CACHE"] = _STOCK.name

from jaxtyping import install_import_hook  # noqa: E402

_HOOK = install_import_hook(
    ["sketchtree.traverse", "sketchtree.keys", "sketchtree.similarity"], "beartype.beartype"
)
