"""Choose the core before anything imports it. Importing this is the act.

Imported first, and only by ``bridge/__main__.py``: where that is the process itself, the compiled
core is used if there is one; where a test or a bench imports it, the plain source stays.
"""

from __future__ import annotations

import sys

from bridge.compiled import Core, plain, use


def chosen() -> Core:
    """Return the core of this process."""
    spec = getattr(sys.modules.get("__main__"), "__spec__", None)
    if getattr(spec, "name", None) != "bridge.__main__":
        return plain("this process is not the bridge itself")
    return use()


CORE = chosen()
