"""Run every check in order, print what was found, and return the worst verdict as exit status."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import TYPE_CHECKING

from pons.doctor import jitter as late
from pons.doctor import machine, mind, place
from pons.doctor.finding import Finding, Verdict

if TYPE_CHECKING:
    from pons.settings import Settings

EXIT = {Verdict.OK: 0, Verdict.WARN: 1, Verdict.FAIL: 2}
"""0: all is well; 1: something works less well; 2: something must be mended first."""
MARKS = {Verdict.OK: "ok  ", Verdict.WARN: "warn", Verdict.FAIL: "FAIL"}


def run(settings: Settings, *, as_json: bool = False, jitter: bool = False) -> int:
    """Be ``pons doctor``."""
    found = findings(settings)
    _, robot = place.robot(settings.robot)
    rows = late.measure(robot.realtime.priority) if jitter else []
    if as_json:
        content = {"findings": [asdict(one) for one in found]}
        if jitter:
            content["jitter"] = [asdict(row) for row in rows]
        print(json.dumps(content, ensure_ascii=False, indent=1))
    else:
        print("\n".join(line for one in found for line in lines(one)))
        if jitter:
            print(f"\n{late.table(rows)}")
            if len(rows) < 2:
                print(
                    "cyclictest did not run beside it (Debian: rt-tests; it needs the same rights)"
                )
    return max(EXIT[one.verdict] for one in found)


def findings(settings: Settings) -> list[Finding]:
    """Return what every check finds, the machine first."""
    described, robot = place.robot(settings.robot)
    sited, site = place.site(settings.site)
    running = bool(place.listening(settings.home))
    return [
        machine.python(),
        machine.page_size(),
        machine.real_time(robot.realtime.priority, virtual=robot.drive.virtual),
        machine.locked_memory(),
        machine.node(),
        place.home(settings.home),
        place.disk(settings.home),
        place.sockets(settings.home),
        place.port(settings.host, settings.port, running=running),
        described,
        sited,
        mind.model(settings.home),
        mind.recogniser(site),
    ]


def lines(one: Finding) -> list[str]:
    """Return a finding for a terminal: both languages, and the fix below."""
    shown = [f"{MARKS[one.verdict]}  {one.name:<14} {one.found.en}"]
    if one.fix is not None:
        shown += [
            f"      {'':<14} {one.found.zh}",
            f"      {'':<14} -> {one.fix.en}",
            f"      {'':<14} -> {one.fix.zh}",
        ]
    return shown
