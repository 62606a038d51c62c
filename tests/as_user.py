"""Be another user in its own process: ``python -m tests.as_user UID GID,GID… MODULE [WORD …]``.

Loads the module as root, which may read this checkout and its interpreter, and only then becomes
the user, with these groups and no others; then calls the module's ``main`` with the words.
"""

from __future__ import annotations

import importlib
import os
import sys
from contextlib import suppress

LOADED = (
    "pons.bridge_client",
    "pons.operator",
    "pons.running",
    "pons.stop",
    "pons.up",
    "http.client",
    "encodings.idna",
)
"""What a command imports only when it needs it."""


def main(arguments: list[str]) -> int:
    """Return what the module's own ``main`` does."""
    uid, groups = int(arguments[0]), [int(one) for one in arguments[1].split(",")]
    module = importlib.import_module(arguments[2])
    for name in LOADED:
        importlib.import_module(name)
    import zenoh

    with suppress(zenoh.ZError):
        zenoh.KeyExpr("")  # an error's text is looked up once
    os.setgroups(groups)
    os.setresgid(groups[0], groups[0], groups[0])
    os.setresuid(uid, uid, uid)
    return int(module.main(arguments[3:]) or 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
