"""Load what the first call would load, before anybody waits for it."""

from __future__ import annotations

import importlib
import importlib.util
import sys


def warm_up() -> None:
    """Load what httpx loads at its first call (0.15 s), so that no goal pays for it.

    httpcore looks for sniffio at each of its locks; where that is not installed, each look searches
    the whole path (0.5 ms a call). None in ``sys.modules`` is Python's word for "there is none".
    """
    importlib.import_module("anyio._backends._asyncio")
    if "sniffio" not in sys.modules and importlib.util.find_spec("sniffio") is None:
        sys.modules["sniffio"] = None  # type: ignore[assignment]  # docs.python.org, "The module cache"
