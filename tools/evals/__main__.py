"""Run one of our own suites: ``python -m tools.evals NAME [--model NAME@URL]``."""

from __future__ import annotations

import argparse
import asyncio
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from maps.errors import SiteError
from planner.brain import Brain, OutOfBudget
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons.evals.command import score_and_show
from pons.evals.matchers import BadMatcher
from pons.evals.model_access import with_brain, with_model
from pons.evals.suites import HOME_SITE, MissingSuite
from pons.settings import load
from tools.evals import look, outside, said, talks
from tools.evals.lines import LANGUAGES, LineVerdict, read_lines, show_lines
from tools.evals.turns import load_turns
from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from planner.brain.endpoint import EndpointBrain
    from tools.evals.lines import SuiteLine

    Hear = Callable[[SuiteLine], Awaitable[LineVerdict]]

REACHED, MISSED, REFUSED = 0, 1, 2
GOAL = 0.9
"""Of a suite's lines, none of them unsafe."""
COLUMNS = {"talk": 3, "memory": 2, "orders": 2, "look": 3}
FOLDERS = {"talk": "talks", "look": "looks"}
SUITES = (*COLUMNS, "turns", "gpsr", "zh", "person", "trial")


def main(words: list[str]) -> int:
    """Score a brain on a suite: 0 the goal is reached, 1 it is not, 2 nothing could be asked."""
    parser = argparse.ArgumentParser(prog="tools.evals", description=__doc__)
    parser.add_argument("suite", choices=SUITES)
    parser.add_argument("--model", nargs="?", const="", metavar="NAME@URL")
    parser.add_argument("--yes", action="store_true", help="a model elsewhere may be asked")
    parser.add_argument("--json", action="store_true", help="turns, gpsr, zh: as one JSON object")
    parser.add_argument("--guard", action="store_true", help="gpsr, zh: measure the guard")
    parser.add_argument("--drive", action="store_true", help="person, trial: drive to each end")
    parser.add_argument("--data", type=Path, default=outside.DATA, help="orders of others")
    parser.add_argument("--site", type=Path, default=HOME_SITE)
    given = parser.parse_args(words)
    try:
        return _score(given)
    except (ConfigError, BadMatcher, MissingSuite, SiteError, look.NoVision) as wrong:
        print(f"tools.evals: {wrong}", file=sys.stderr)
        return REFUSED


def _score(given: argparse.Namespace) -> int:
    settings, model, yes = load(), given.model, given.yes
    if given.suite in ("turns", "gpsr", "zh"):
        read = {"gpsr": outside.gpsr, "zh": outside.chinese}.get(given.suite)
        suites = load_turns(given.site) if read is None else (read(given.data),)
        return score_and_show(settings, suites, given)
    if given.suite == "look":
        if model is None:
            raise ConfigError("no_vision_model", "`look` asks a model that sees; give --model")
        count = sum(len(read_lines("looks", name, 3)) for name in LANGUAGES)
        return asyncio.run(with_model(settings, model, _look, yes=yes, count=count))

    async def score(brain: Brain) -> int:
        if given.suite in ("person", "trial"):
            hold = talks.score_person if given.suite == "person" else talks.score_trial
            reached = await talks.hold_beside(
                lambda b: hold(b, given), brain, outside=model is not None
            )
            return REACHED if reached else MISSED
        if given.suite == "talk":
            return await talks.hold_beside(
                lambda b: _hear("talk", lambda line: talks.hear_talk(line, b, given.site)),
                brain, outside=model is not None,
            )  # fmt: skip
        names, hear = vocabulary_of(Site.load(given.site)), said.hear_order
        hear = said.hear_memory if given.suite == "memory" else hear
        return await _hear(given.suite, lambda line: hear(line, brain, names))

    return asyncio.run(with_brain(settings, model, score, yes=yes))


async def _look(brain: EndpointBrain) -> int:
    looker = brain.looker()
    return await _hear("look", lambda line: look.hear_look(line, looker))


async def _hear(suite: str, hear: Hear) -> int:
    """Score a suite's lines in both languages; what was paid for is shown when a budget ends."""
    verdicts: list[LineVerdict] = []
    count = 0
    for language in LANGUAGES:
        lines = read_lines(FOLDERS.get(suite, suite), language, COLUMNS[suite])
        before, count = len(verdicts), count + len(lines)
        try:
            for line in lines:
                verdicts.append(await hear(line))  # noqa: PERF401  # what came stays
        except OutOfBudget as spent:
            print(f"tools.evals: {spent.said.en}", file=sys.stderr)
        print(show_lines(f"{suite} {language}", verdicts[before:]))
    if not verdicts:
        return REFUSED
    if all(each.told == look.BLIND for each in verdicts):
        raise look.NoVision(f"no_pictures: {look.BLIND}")
    enough = sum(each.right for each in verdicts) >= GOAL * count
    return REACHED if enough and not any(each.wrong for each in verdicts) else MISSED


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
