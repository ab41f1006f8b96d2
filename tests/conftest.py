"""What every test shares: shapes are checked, nothing a test compiles or caches outlives it, and files that take long begin first."""

import atexit
import os
import tempfile

os.environ.setdefault("JAX_PLATFORMS", "cpu")
_STOCK = tempfile.TemporaryDirectory(prefix="sketchtree-stock-")  # what the studio keeps for its next start
atexit.register(_STOCK.cleanup)
os.environ["SKETCHTREE_CACHE"] = _STOCK.name

from jaxtyping import install_import_hook  # noqa: E402
from long_files import long_first  # noqa: E402

_HOOK = install_import_hook(
    ["sketchtree.traverse", "sketchtree.keys", "sketchtree.similarity"], "beartype.beartype"
)


def pytest_configure(config):
    """xdist would have files with many tests first, which are seldom the long ones."""
    config.option.loadscopereorder = False


def pytest_collection_modifyitems(items):
    """Long files first, the longest before all."""
    items.sort(key=long_first)
