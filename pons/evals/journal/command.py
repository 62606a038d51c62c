"""The work of ``pons eval --journal``: read, say the price, think again, show."""

from __future__ import annotations

import asyncio
import os
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from planner.outbound import Address
from planner.site import Site
from pons.evals.journal.recorded import NoJournal, RecordedDecisions, read
from pons.evals.journal.show import content, table
from pons.evals.journal.think import most_calls, think_again
from pons.evals.model_access import agree_on, choose_model
from pons.terminal import pick
from wire import ConfigError

if TYPE_CHECKING:
    from planner.settings import ModelSettings
    from pons.settings import LaunchSettings

EXIT_SAME, EXIT_DIFFERS, EXIT_BAD = 0, 1, 2
MOST = 50


@dataclass(frozen=True, slots=True)
class JournalOptions:
    """Say how much to do."""

    most: int = MOST
    """Sentences, the newest."""
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
    except (NoJournal, ConfigError) as wrong:
        print(f"{called}: {wrong}", file=sys.stderr)
        return EXIT_BAD
    show = content if options.as_json else table
    print(show(recorded, found, cost, model.name))
    return EXIT_DIFFERS if any(a.relation in ("differs", "none") for a in found) else EXIT_SAME


def _bill(recorded: RecordedDecisions, model: ModelSettings, host: str) -> str:
    count = len(recorded.decisions)
    calls = most_calls(count)
    return pick(
        f"{count} recorded sentences of people will be sent to {model.name} at {host}, which is "
        f"not this machine: at most {calls} calls.",
        f"将把 {count} 条录下的指令发送给 {host}（不是本机）上的 {model.name}，"
        f"最多 {calls} 次调用。",
    )
