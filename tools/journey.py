"""Count the files that a goal and a tick enter: ``python -m tools.journey [--list] [SENTENCE]``.

Four figures say how far a reader has to walk. From the sentence until the first wheel command that
is not zero they count the planner's files, its functions and the regular expressions that it runs;
the last is the number of bridge files that one driving tick with a lidar scan enters. All are taken
in lockstep: without HTTP, and with the route searched in this process. A file counts where one of
its functions was called; importing it does not count. A figure above its limit fails the tests.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import CodeType, FrameType

from bridge.core import BridgeState, CoreConfig, Decision, Inbox, step
from tools.lockstep import LockstepWorld

ROOT = Path(__file__).resolve().parents[1]
SENTENCE, OTHER = "go to the kitchen", "go to the living room"


@dataclass(frozen=True, slots=True)
class Limit:
    """Hold what a figure may be at most now, and where it is to come; the first only goes down.

    Marks raised the bridge's files from 34 to 35 (docs/adr/0079); what reads a parted goal's record
    raised the functions from 487 to 497 (docs/adr/0033), in fewer files.
    """

    most: int
    aim: int


FILES, FUNCTIONS = Limit(104, 60), Limit(497, 250)
EXPRESSIONS = Limit(282, 300)
BRIDGE_FILES = Limit(35, 25)
LIMIT_S = 20.0
UNDER_WAY_S = 2.0
"""Then it drives at full speed, and the first tick's special cases are over."""
WATCHED_S = 0.5
"""Five scans at 10 Hz."""


@dataclass
class Tracer:
    """Count the calls into each file below some folders of this repository."""

    folders: tuple[str, ...]
    calls: Counter[str] = field(default_factory=Counter)
    functions: set[CodeType] = field(default_factory=set)
    expressions: int = 0
    _names: dict[str, str | None] = field(default_factory=dict)

    @contextmanager
    def tracing(self) -> Iterator[Counter[str]]:
        """Count inside of the block, from zero; yield the counter, by path."""
        self.calls, self.functions, self.expressions = Counter(), set(), 0
        sys.setprofile(self._note)
        try:
            yield self.calls
        finally:
            sys.setprofile(None)

    def _note(self, frame: FrameType, event: str, argument: object) -> None:
        code = frame.f_code
        if event not in ("call", "c_call") or code.co_name == "<module>":
            return
        name = self._names.get(code.co_filename, "")
        if name == "":
            name = self._names[code.co_filename] = self._path_of(code.co_filename)
        if name is None:
            return
        if event == "c_call":
            self.expressions += isinstance(getattr(argument, "__self__", None), re.Pattern)
            return
        self.calls[name] += 1
        if not code.co_name.startswith("<"):
            self.functions.add(code)

    def _path_of(self, filename: str) -> str | None:
        path = Path(filename)
        if not path.is_relative_to(ROOT):
            return None
        name = path.relative_to(ROOT).as_posix()
        return name if name.split("/")[0] in self.folders else None


def planner_journey(sentence: str = SENTENCE, site: str = "home") -> Tracer:
    """Return what the planner ran from the sentence until the first wheel command.

    A drive by other words goes before it: what a process works out once is no part of the way.

    Raises:
        TooLong: no wheel turned within ``LIMIT_S`` simulated seconds.
    """
    tracer = Tracer(("planner",))
    for said in (OTHER, sentence):
        world = LockstepWorld(site=site)
        with tracer.tracing():
            world.say(said)
            world.run_until(turns_a_wheel, LIMIT_S)
    return tracer


def turns_a_wheel(world: LockstepWorld) -> bool:
    """Return whether the newest wheel command is not zero."""
    command = world.commands[-1] if world.commands else None
    return command is not None and bool(command.left_radps or command.right_radps)


def bridge_files(sentence: str = SENTENCE, site: str = "home") -> Counter[str]:
    """Return the bridge files that one driving tick with a scan enters, by calls.

    Of the ticks that bring a scan it is the one with most files: some bring a status or waypoints
    too, as they do at the robot.

    Raises:
        TooLong: no wheel turned within ``LIMIT_S`` simulated seconds.
    """
    scans = [False]

    def step_and_note(
        config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float
    ) -> Decision:
        scans[0] = inbox.scan is not None
        return step(config, state, inbox, now_s)

    world = LockstepWorld(site=site, step=step_and_note)
    world.say(sentence)
    world.run_until(turns_a_wheel, LIMIT_S)
    world.run(UNDER_WAY_S)
    tracer, most = Tracer(("bridge",)), Counter[str]()
    end_s = world.now_s + WATCHED_S
    while world.now_s < end_s:
        with tracer.tracing() as calls:
            world.tick()
        if scans[0] and len(calls) > len(most):
            most = calls
    return most


def main() -> int:
    """Print the figures beside what is aimed at, and with ``--list`` the files."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sentence", nargs="?", default=SENTENCE)
    parser.add_argument("--site", default="home", help="the name of a site")
    parser.add_argument("--list", action="store_true", help="name the files and count their calls")
    asked = parser.parse_args()
    walked = planner_journey(asked.sentence, asked.site)
    ticked = bridge_files(asked.sentence, asked.site)
    rows = (
        ("planner files until the first wheel command", len(walked.calls), FILES),
        ("planner functions until then", len(walked.functions), FUNCTIONS),
        ("regular expressions that these run", walked.expressions, EXPRESSIONS),
        ("bridge files of one driving tick with a scan", len(ticked), BRIDGE_FILES),
    )
    for what, count, limit in rows:
        print(f"{what}: {count} (at most {limit.most}, aim {limit.aim})")
    if asked.list:
        for calls in (walked.calls, ticked):
            print("".join(f"  {times:6d}  {path}\n" for path, times in sorted(calls.items())))
    return 0


if __name__ == "__main__":
    sys.exit(main())
