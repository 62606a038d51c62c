"""The work of ``pons eval --journal``: read, say the price, think again, drive, show."""

from __future__ import annotations

import asyncio
import os
import sys
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from planner.outbound import Address
from planner.site import Site
from pons.evals.journal.recorded import NoJournal, RecordedDecisions, read
from pons.evals.journal.show import content, table
from pons.evals.journal.think import SecondThought, most_calls, think_again
from pons.evals.model_access import agree_on, choose_model
from wire import ConfigError

if TYPE_CHECKING:
    from planner.settings import ModelSettings
    from pons.settings import LaunchSettings

EXIT_SAME, EXIT_DIFFERS, EXIT_BAD = 0, 1, 2
MOST = 50
DRIVES = 3


@dataclass(frozen=True, slots=True)
class JournalOptions:
    """Say how much to do."""

    most: int = MOST
    """Sentences, the newest."""
    drives: int = DRIVES
    """Differing plans that are driven in lockstep."""
    as_json: bool = False
    yes: bool = False


def run(
    where: LaunchSettings,
    files: list[str],
    word: str,
    options: JournalOptions,
    called: str = "pons replay --with-model",
) -> int:
    """Think again; 0 when no decision differs, 1 when one does, 2 when it could not be done.

    Args:
        where: home, site and robot.
        files: one journal, or a home folder.
        word: the model, as :func:`choose_model` reads it.
        options: how much to do.
        called: the command's words, as an error begins.
    """
    try:
        if options.drives > 0:
            require_lockstep()  # before anything is spent
        if len(files) != 1:
            raise NoJournal(f"one_journal: give one journal or home folder; got {len(files)}")
        recorded = read(Path(files[0]))
        settings, model = choose_model(word, where.home, os.environ)
        address = Address.parse(model.url)
        recorded = replace(recorded, decisions=recorded.decisions[: options.most])
        bill = _bill(recorded, model, address.host)
        if not address.local and not agree_on(bill, yes=options.yes):
            return EXIT_BAD
        site = Site.load(where.site)
        found, cost = asyncio.run(
            think_again(recorded.decisions, site, settings, model, where.home)
        )
        found = _drive_first(found, where, options.drives)
    except (NoJournal, LockstepMissing, ConfigError) as wrong:
        print(f"{called}: {wrong}", file=sys.stderr)
        return EXIT_BAD
    show = content if options.as_json else table
    print(show(recorded, found, cost, model.name))
    return EXIT_DIFFERS if any(a.relation in ("differs", "none") for a in found) else EXIT_SAME


class LockstepMissing(Exception):
    """This installation can't drive plans; the message begins with a stable code."""


def require_lockstep() -> None:
    """Raise LockstepMissing where the tools of a checkout are not installed."""
    if find_spec("tools") is None or find_spec("tools.lockstep") is None:
        raise LockstepMissing(
            "tools_missing: plans are driven in lockstep, which is part of a checkout and not of "
            "the installed package; give --drives 0, or run this in a checkout"
        )


def _drive_first(
    found: list[SecondThought], where: LaunchSettings, most: int
) -> list[SecondThought]:
    """Drive the first plans that differ and move."""
    if most <= 0:
        return found
    from pons.evals.journal.drive import drive
    from tools.lockstep import TooLong

    left = most
    again = []
    for one in found:
        if one.plan is not None and left > 0:
            left -= 1
            print(f"driving in lockstep: {one.decision.text}", file=sys.stderr)
            try:
                went = drive(one.plan, where.site, where.robot, one.decision.start)
            except TooLong as late:
                print(f"not driven: {late}", file=sys.stderr)
            else:
                one = replace(one, driven=went)  # noqa: PLW2901  # the same sentence, driven
        again.append(one)
    return again


def _bill(recorded: RecordedDecisions, model: ModelSettings, host: str) -> str:
    count = len(recorded.decisions)
    calls = most_calls(count)
    return (
        f"{count} recorded sentences of people will be sent to {model.name} at {host}, which is "
        f"not this machine: at most {calls} calls.\n"
        f"将把 {count} 条录下的指令发送给 {host} 上的 {model.name}，"
        f"最多 {calls} 次调用。"
    )
