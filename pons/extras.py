"""Start what comes with an extra; where it is not installed, say how to install it."""

from __future__ import annotations

import os
import sys
from importlib.util import find_spec
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_USAGE = 2


def become_fleet(settings: LaunchSettings, words: list[str]) -> int:
    """Be ``pons fleet``, by becoming its process."""
    if find_spec("dbos") is None:
        print("fleet_missing: pip install 'pons-robot[fleet]'", file=sys.stderr)
        return EXIT_USAGE
    sys.stdout.flush()
    environment = {**os.environ, "PONS_HOME": str(settings.home)}
    os.execve(sys.executable, [sys.executable, "-m", "fleet", *words], environment)
    return EXIT_USAGE  # not reached: this process is the fleet's now


def serve_mcp(settings: LaunchSettings, words: list[str]) -> int:
    """Be ``pons mcp``."""
    try:
        from pons.mcp.command import main as serve
    except ModuleNotFoundError as missing:
        if missing.name not in ("mcp", "mcp_types"):
            raise
        print("mcp_missing: pip install -e '.[mcp]'", file=sys.stderr)
        return EXIT_USAGE
    return serve(settings, words)
