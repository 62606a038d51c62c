"""Play broken and hostile brains at a bridge over the real wire, and judge it from outside.

The kit knows nothing of a bridge's inside: it sees the commands that reach the drive, what the
simulator says is true, and the bridge's own status. docs/conformance.md holds the matrix.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pons.settings import LaunchSettings


def main(settings: LaunchSettings, arguments: list[str]) -> int:
    """Be ``pons conformance``."""
    from pons.conformance import command  # late: its helpers need no map, and must load quickly

    return command.main(settings, arguments)


__all__ = ["main"]
