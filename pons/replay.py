"""Run recordings again and say whether every command came out the same: ``pons replay FILE...``.

With a model it is another name of ``pons eval --journal``.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from pons.settings import LaunchSettings

EXIT_SAME, EXIT_DIFFERS, EXIT_BAD = 0, 1, 2


def run(files: Sequence[str]) -> int:
    """Replay; 0 when no tick differs, 1 when one does, 2 when a file is none."""
    from bridge.replay import BadRecording, replay

    try:
        report = replay([Path(file) for file in files])
    except BadRecording as wrong:
        print(wrong, file=sys.stderr)
        return EXIT_BAD
    print(f"{report.ticks} ticks replayed, {report.differing} differing, {report.gaps} gaps")
    if report.first_difference is not None:
        print(f"first difference: {report.first_difference}")
    if report.other_core is not None:
        print(
            f"recorded by core {report.other_core}, which is not this one; for a replay to the "
            "last bit use the version that recorded it"
        )
    return EXIT_DIFFERS if report.differing else EXIT_SAME


def with_model(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Think recorded sentences again with the model that was named."""
    from pons.evals.journal import command

    options = command.JournalOptions(max(0, said.most), said.json, said.yes)
    return command.run(settings, said.files, said.with_model, options)
