"""End with the next status of a file, and note where it was started: a planner that asks to leave.

``python -m tests.pons.ending_planner FILE SITE``; with no status left it refuses to start.
"""

from __future__ import annotations

import sys
from pathlib import Path

from wire import ConfigError


def main(file: Path, site: str) -> int:
    """Return the status; the file's first line holds those that are left."""
    left, *noted = file.read_text("utf-8").splitlines()
    first, *later = left.split() or [str(ConfigError.exit_status)]
    file.write_text("\n".join([" ".join(later), *noted, site]), "utf-8")
    return int(first)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2]))
