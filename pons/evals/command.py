"""The command ``pons eval``: a suite, an exam of a minute, or a journal thought again."""

from __future__ import annotations

import argparse
import asyncio
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from maps.errors import SiteError
from planner.brain import Brain, OfflineBrain, OutOfBudget
from pons.evals.matchers import BadMatcher
from pons.evals.model_access import with_brain
from pons.evals.report import as_json, content, has_passed, table
from pons.evals.score import SentenceVerdict, score_each
from pons.evals.suites import HOME_SITE, MissingSuite, Suite, load, suite_names
from pons.launch_words import chinese_line
from pons.terminal import below
from wire import ConfigError

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

REACHED, MISSED, REFUSED = 0, 1, 2


@dataclass(frozen=True, slots=True)
class SuiteScore:
    """Hold one suite's results."""

    name: str
    verdicts: tuple[SentenceVerdict, ...]
    left: int
    """Sentences not asked: the budget was up."""


def main(settings: LaunchSettings, words: list[str]) -> int:
    """Score a brain on a suite: 0 the goal is reached, 1 it is not, 2 nothing could be asked."""
    parser = _parser()
    said = parser.parse_args(words)
    if said.quick or said.journal is not None:
        if said.suite is not None or (said.quick and said.journal is not None):
            parser.error("give one of SUITE, --quick and --journal")
        return _quick(settings, said) if said.quick else _journal(settings, said)
    if said.suite is None:
        parser.error("give a SUITE, --quick or --journal")
    try:
        return score_and_show(settings, load(said.suite, said.site), said)
    except (MissingSuite, BadMatcher, SiteError) as wrong:
        print(f"pons eval: {wrong}{below('', {'zh': _in_chinese(wrong)})}", file=sys.stderr)
        return REFUSED
    except ConfigError as wrong:
        print(f"pons eval: {wrong}{chinese_line(str(wrong))}", file=sys.stderr)
        return REFUSED


def score_and_show(
    settings: LaunchSettings, suites: tuple[Suite, ...], said: argparse.Namespace
) -> int:
    """Score a brain, or the guard, on suites as ``main`` does.

    Raises:
        ConfigError: the model may not be asked.
    """
    if said.guard:
        return _guard(suites)

    async def score(brain: Brain) -> tuple[str, list[SuiteScore]]:
        return await score_whole(suites, brain)

    count = sum(len(suite.cases) for suite in suites)
    asking = with_brain(settings, said.model, score, yes=said.yes, count=count)
    brain, scored = asyncio.run(asking)
    if not any(one.verdicts for one in scored) and any(one.left for one in scored):
        return REFUSED
    if said.json:
        print(as_json(content(one.name, brain, one.verdicts, one.left) for one in scored))
    else:
        print("\n\n".join(table(one.name, brain, one.verdicts, one.left) for one in scored))
    return REACHED if all(has_passed(one.verdicts, one.left) for one in scored) else MISSED


def _in_chinese(wrong: MissingSuite | BadMatcher | SiteError) -> str:
    """Return in Chinese why nothing could be asked; the names stand in the line above."""
    if isinstance(wrong, SiteError):
        return wrong.message["zh"]
    if isinstance(wrong, BadMatcher):
        return "句集文件有一行无法读取：请按上面所示修改"
    return "没有这个句集：请从上面列出的名称中选择，或给出 .tsv 文件"


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="pons eval",
        description="Score what a brain plans. Exit status: 0 goal reached, 1 not, 2 not asked.",
        epilog="Examples: pons eval --quick; pons eval replies --model qwen3:8b",
    )
    parser.add_argument(
        "suite",
        nargs="?",
        help=f"{', '.join(suite_names())}, or a .tsv file",
    )
    parser.add_argument("--quick", action="store_true", help="examine a model for a minute")
    parser.add_argument(
        "--journal",
        metavar="FILE",
        help="think the sentences of a journal (missions.db) or a home folder again",
    )
    parser.add_argument(
        "--model",
        nargs="?",
        const="",
        metavar="NAME@URL",
        help="ask a model: the owner's, or NAME, URL or NAME@URL; else the offline brain",
    )
    parser.add_argument(
        "--guard",
        action="store_true",
        help="measure the guard against motion nobody asked for on the suite: no brain is scored",
    )
    parser.add_argument("--yes", action="store_true", help="a model elsewhere may be asked")
    parser.add_argument("--most", type=int, default=50, metavar="N", help="the newest sentences")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--site", type=Path, default=HOME_SITE, help="whose names ours use")
    return parser


def _quick(settings: LaunchSettings, said: argparse.Namespace) -> int:
    from pons.evals import quick

    word = said.model or ""
    return quick.run(settings, word, as_json=said.json, yes=said.yes, called="pons eval --quick")


def _journal(settings: LaunchSettings, said: argparse.Namespace) -> int:
    from pons.evals.journal import command

    options = command.JournalOptions(max(0, said.most), said.json, said.yes)
    word = said.model or ""
    return command.run(settings, [said.journal], word, options, "pons eval --journal")


def _guard(suites: tuple[Suite, ...]) -> int:
    """Measure the guard: 0 nothing unasked is walked and little is asked in vain, 1 otherwise."""
    from pons.evals.guard_score import score_guard, show

    scores = [asyncio.run(score_guard(suite)) for suite in suites]
    print("\n".join(map(show, scores)))
    return REACHED if all(score.has_passed for score in scores) else MISSED


def _tell_progress(done: int, count: int) -> None:
    """Show on a terminal how far a slow model is."""
    if sys.stderr.isatty():
        print(f"\r{done} of {count}", end="" if done < count else "\n", file=sys.stderr, flush=True)


async def score_whole(suites: tuple[Suite, ...], brain: Brain) -> tuple[str, list[SuiteScore]]:
    """Score to the end of the suites or of the budget, or to Ctrl-C: paid results are kept."""
    verdicts: list[list[SentenceVerdict]] = [[] for _ in suites]
    count = sum(len(suite.cases) for suite in suites)
    try:
        for suite, mine in zip(suites, verdicts, strict=True):
            async for verdict in score_each(suite, brain):
                mine.append(verdict)
                if not isinstance(brain, OfflineBrain):
                    _tell_progress(sum(map(len, verdicts)), count)
    except OutOfBudget as spent:
        print(f"pons eval: {spent.said.en}", file=sys.stderr)
    except asyncio.CancelledError:  # how asyncio.run hands Ctrl-C on
        if (task := asyncio.current_task()) is not None:
            task.uncancel()
        print("\npons eval: interrupted; this was scored until then", file=sys.stderr)
    scored = [
        SuiteScore(suite.name, tuple(mine), len(suite.cases) - len(mine))
        for suite, mine in zip(suites, verdicts, strict=True)
    ]
    return f"{brain.tag.name} {brain.tag.version}", scored
