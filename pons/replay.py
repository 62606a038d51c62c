"""Run a recording again and say whether every command came out the same: ``pons replay FILE``."""

from __future__ import annotations

import sys
from pathlib import Path


def run(file: str) -> int:
    """Replay; 0 when no tick differs, 1 when one does, 2 when the file is none."""
    from bridge.replay import BadRecording, replay

    try:
        report = replay(Path(file))
    except BadRecording as wrong:
        print(wrong, file=sys.stderr)
        return 2
    print(f"{report.ticks} ticks replayed, {report.differing} differing, {report.gaps} gaps")
    if report.first_difference is not None:
        print(f"first difference: {report.first_difference}")
    return 1 if report.differing else 0
