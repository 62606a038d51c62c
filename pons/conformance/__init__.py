"""Play broken and hostile brains at a bridge over the real wire, and judge it from outside.

The kit knows nothing of a bridge's inside: it sees the commands that reach the drive, what the
simulator says is true, and the bridge's own status. docs/conformance.md holds the matrix.
"""

from pons.conformance.command import main

__all__ = ["main"]
