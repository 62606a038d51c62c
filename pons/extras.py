"""Start what comes with an extra; where it is not installed, say how to install it."""

from __future__ import annotations

import os
import sys
from importlib.util import find_spec
from typing import TYPE_CHECKING

from pons.terminal import pick

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

EXIT_USAGE = 2


def become_fleet(settings: LaunchSettings, words: list[str]) -> int:
    """Be ``pons fleet``, by becoming its process."""
    if find_spec("dbos") is None:
        return tell_missing("fleet")
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
        return tell_missing("mcp")
    return serve(settings, words)


def tell_missing(extra: str) -> int:
    """Say how an extra is installed; return the exit status of that."""
    cure = f"pip install 'pons-robot[{extra}]'"
    told = pick(f"the library is not here; install it: {cure}", f"缺少所需的库；请安装：{cure}")
    print(f"{extra}_missing: {told}", file=sys.stderr)
    return EXIT_USAGE
