"""Run ``pons conformance``: play broken and hostile brains at a bridge and print the results.

Starts simulator, localization and bridge in a home of its own; leaves nothing behind. Exit status:
0 every cell held, 1 one did not, 2 nothing could be tested or a row not be judged, 130 Ctrl-C.
"""

from __future__ import annotations

import argparse
import json
import signal
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from pons.conformance import matrix
from pons.conformance.adapter import CannotTest
from pons.conformance.catalogue import FAULTS, choose_faults
from pons.conformance.fault import W, X
from pons.conformance.runner import NAMES, play_all
from pons.conformance.site_track import find_track
from pons.conformance.system_under_test import OURS, SystemUnderTest
from pons.machine import commit, machine, today
from pons_assets import SITES
from wire import ConfigError, load_robot

if TYPE_CHECKING:
    from types import FrameType

    from pons.conformance.adapter import Adapter
    from pons.conformance.fault import Fault
    from pons.conformance.runner import MatrixRow
    from pons.conformance.track import TestTrack
    from pons.settings import LaunchSettings

EXIT_HELD, EXIT_BROKEN, EXIT_UNTESTED, EXIT_INTERRUPTED = 0, 1, 2, 130
KINDS = {name: kind for kind, name in NAMES.items()}
SITE = SITES / "two_room"


def parser() -> argparse.ArgumentParser:
    """Return the grammar of the command."""
    top = argparse.ArgumentParser(prog="pons conformance", description=__doc__)
    top.add_argument("faults", nargs="*", metavar="FAULT", help="play these only; --list shows all")
    top.add_argument("--list", action="store_true", help="list the faults and end")
    top.add_argument("--quick", action="store_true", help="the short run, under 40 s")
    top.add_argument("--brain", choices=sorted(KINDS), help="that brain's rows only")
    top.add_argument("--site", type=Path, default=SITE, help="folder of a site")
    top.add_argument("--json", type=Path, metavar="FILE", help="write all of it there")
    top.add_argument("--docs", type=Path, metavar="FILE", help="put the matrix into this page")
    top.add_argument("--seed", type=int, default=1, help="of all chance (default 1)")
    which = top.add_mutually_exclusive_group()
    which.add_argument(
        "--connect", action="store_true",
        help="test the bridge that runs in $PONS_HOME; its drive must be virtual",
    )  # fmt: skip
    which.add_argument(
        "--bridge", default=OURS, metavar="MODULE",
        help="start another bridge that speaks the wire: python -m MODULE --home … --site …",
    )  # fmt: skip
    return top


def main(settings: LaunchSettings, arguments: list[str]) -> int:
    """Run the kit; print; return the exit status."""
    said = parser().parse_args(arguments)
    if said.list:
        for fault in FAULTS:
            print(f"{fault.name:20} {' '.join(fault.kinds):18} {fault.what}")
        return EXIT_HELD
    for number in (signal.SIGINT, signal.SIGTERM):  # a shell's background job ignores Ctrl-C else
        signal.signal(number, _as_interrupt)
    try:
        kinds = (KINDS[said.brain],) if said.brain else (X, W)
        faults = choose_faults(said.faults, quick=said.quick, kinds=kinds)
        settings = replace(settings, site=said.site.absolute())
        track = find_track(settings.site, load_robot(settings.robot).base.radius_m)
        rig = SystemUnderTest(settings, track, module=said.bridge, join=said.connect)
        lines = run(rig, track, faults, said.seed)
    except (CannotTest, ConfigError, OSError) as why:
        print(f"pons conformance: {why}", file=sys.stderr)
        return EXIT_UNTESTED
    except KeyboardInterrupt:
        print("\npons conformance: interrupted; all that was started is ended", file=sys.stderr)
        return EXIT_INTERRUPTED
    site = settings.site.name
    origin = matrix.Origin(rig.name, site, commit(), today(), machine(), said.seed)
    failed = matrix.tries(lines)
    print(f"\n{matrix.table(lines)}\n\n{failed}{origin.line()}\n{matrix.summary(lines)}")
    _write(said, lines, origin)
    return status_of(lines)


def status_of(lines: list[MatrixRow]) -> int:
    """Return the exit status: a row that could not be judged is no pass and no failure."""
    if not lines or any(line.has_failed for line in lines):
        return EXIT_BROKEN
    return EXIT_HELD if all(line.has_passed for line in lines) else EXIT_UNTESTED


def run(
    adapter: Adapter, track: TestTrack, faults: tuple[Fault, ...], seed: int
) -> list[MatrixRow]:
    """Play the faults at one bridge, telling each row as it ends."""
    count = sum(len(fault.kinds) for fault in faults)
    began_s = time.monotonic()
    _say(f"starting {adapter.name}; {count} rows")
    lines: list[MatrixRow] = []
    with adapter:
        for line in play_all(adapter, track, faults, seed, _say):
            lines.append(line)
            at_s = time.monotonic() - began_s
            _say(matrix.one_line(line, len(lines), count, at_s))
    return lines


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def _write(said: argparse.Namespace, lines: list[MatrixRow], origin: matrix.Origin) -> None:
    if said.json is not None:
        text = json.dumps(matrix.record(lines, origin), ensure_ascii=False, indent=1)
        said.json.write_text(text + "\n", "utf-8")
    if said.docs is not None:
        page = matrix.into_page(said.docs.read_text("utf-8"), matrix.markdown(lines, origin))
        said.docs.write_text(page, "utf-8")


def _as_interrupt(_number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt
