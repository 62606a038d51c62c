"""Compare what makes a plan of a sentence: Pons, pydantic-ai, LangChain's agent and bare httpx.

All ask one endpoint that answers at once, for the same plan in the same closed world with the same
prompt, each in a process of its own, in turns: what differs is what the client costs. Ours includes
its budget, its judgement of the reply and the fallback behind it.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner.brain import ThinkRequest
from planner.brain.prompt import Prompt
from planner.brain.schema import step_models
from planner.plan import Language
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons.settings import CHECKOUT
from tools.bench.context import MeasurementFailure
from tools.bench.endpoint import ORDER
from tools.bench.instant_llm_process import counts, instant
from tools.bench.instant_llm_server import PLAN
from tools.bench.peers.environment import NoPeers, peers_python
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tools.bench.context import BenchLab

NAME = "brains_compared"
TITLE = "sentence -> validated plan, beside others"
LONG_ONLY = True
ROUNDS = 12
EACH = 40
WARM = 20
SITE = CHECKOUT / "sites" / "home"
OURS = ("tools.bench.peers.bare_httpx", "tools.bench.peers.ours")
PEERS = ("tools.bench.peers.pydantic_ai_agent", "tools.bench.peers.langchain_agent")


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take twelve rounds in turns; where the peers can't be had, ours and httpx alone."""
    missing, python = "", None
    try:
        lab.say("making the peers' environment; the first time takes minutes")
        python = peers_python(lab.store.path.parent / "peers")
    except NoPeers as none:
        missing = str(none)
    [run] = [*lab.slices("rounds", 1, lambda _: _run(lab, python))] or [None]
    if run is None:
        return [ReportRow(TITLE, "ms", "", value="not measured", valid=False)]
    rows = [_row(name, one) for name, one in run.items()]
    if missing:
        note = f"the peers can't be installed here: {missing}"
        rows.append(ReportRow("pydantic-ai, langchain", "ms", "", value="not measured", note=note))
    rows += [
        row_of(f"CPU a goal: {name}", "ms", "", one["cpu_ms"], "mean of each round")
        for name, one in run.items()
    ]
    for name, one in run.items():
        told = f"{one['characters_per_call'] / 4:.0f} at 4 characters each"
        rows.append(
            ReportRow(f"model calls a goal: {name}", "", "1", value=f"{one['calls_per_goal']:.2f}")
        )
        rows.append(ReportRow(f"tokens of its messages: {name}", "tokens", "<= 1500", value=told))
    return rows


def _row(name: str, one: dict[str, Any]) -> ReportRow:
    rounds = [statistics.median(took) for took in one["rounds_ms"]]
    versions = ", ".join(f"{part} {number}" for part, number in one["versions"].items())
    note = f"medians of {len(rounds)} rounds {min(rounds):.2f} - {max(rounds):.2f}"
    goal = "p50 <= 8, p99 <= 25" if name == "pons" else ""
    samples = [value for took in one["rounds_ms"] for value in took]
    return row_of(name, "ms", goal, samples, f"{note}; {versions}" if versions else note)


def _run(lab: BenchLab, peers: Path | None) -> dict[str, Any]:
    """Return each contender's rounds; the order of turns moves on with each round."""
    with ExitStack() as stack:
        folder = stack.enter_context(lab.folder())
        url = stack.enter_context(instant(folder))
        facts = _facts(folder, url)
        pythons = [(Path(sys.executable), module) for module in OURS]
        pythons += [(peers, module) for module in PEERS if peers is not None]
        all_ = [
            stack.enter_context(_contender(python, module, facts, folder))
            for python, module in pythons
        ]
        for one in all_:
            one.turn(WARM)  # not counted
        before = counts(url)
        for number in range(ROUNDS):
            lab.say(f"round {number + 1}/{ROUNDS}")
            for at in range(len(all_)):
                one = all_[(at + number) % len(all_)]
                one.round(EACH)
        return {one.name: _result_row(one, before, counts(url)) for one in all_}


def _result_row(one: Contender, before: dict[str, Any], after: dict[str, Any]) -> dict[str, Any]:
    name, goals = one.name, ROUNDS * EACH
    calls = after["calls"][name] - before["calls"][name]
    characters = after["bytes"][name] - before["bytes"][name]
    return {
        "rounds_ms": one.rounds_ms,
        "cpu_ms": one.cpu_ms,
        "versions": one.versions,
        "calls_per_goal": calls / goals,
        "characters_per_call": characters / max(1, calls),
    }


class Contender:
    """Be one process that takes turns."""

    def __init__(self, process: subprocess.Popen[str], log: Path) -> None:
        self._process, self._log = process, log
        hello = self._line()
        self.name, self.versions = hello["name"], hello["versions"]
        self.rounds_ms: list[list[float]] = []
        self.cpu_ms: list[float] = []

    def round(self, count: int) -> None:
        """Take a turn and keep its times."""
        turn = self.turn(count)
        self.rounds_ms.append(turn["took_ms"])
        self.cpu_ms.append(turn["cpu_ms"])

    def turn(self, count: int) -> dict[str, Any]:
        """Have it plan so many times; return how long each took, and the CPU of one [ms]."""
        if self._process.stdin is not None:
            self._process.stdin.write(f"{count}\n")
            self._process.stdin.flush()
        turn: dict[str, Any] = self._line()
        return turn

    def _line(self) -> Any:
        line = self._process.stdout.readline() if self._process.stdout is not None else ""
        if not line:
            last = (self._log.read_text("utf-8").strip().splitlines() or ["no word"])[-1]
            raise MeasurementFailure(f"a contender ended: {last}")
        return json.loads(line)


@contextmanager
def _contender(python: Path, module: str, facts: Path, folder: Path) -> Iterator[Contender]:
    log = folder / f"{module}.log"
    clean = {k: v for k, v in os.environ.items() if not k.lower().endswith("_proxy")}
    with log.open("w") as errors:
        process = subprocess.Popen(
            [str(python), "-m", module, str(facts)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
            cwd=CHECKOUT,
            env={**clean, "PYTHONPATH": str(CHECKOUT)},
        )
    try:
        yield Contender(process, log)
    finally:
        process.kill()
        process.communicate()


def _facts(folder: Path, url: str) -> Path:
    """Write what the contenders are asked."""
    words = vocabulary_of(Site.load(SITE))
    request = ThinkRequest(text=ORDER, vocabulary=words, language=Language.EN)
    system, order = Prompt.load().messages(request)
    content = {
        "url": url,
        "system": system["content"],
        "order": order["content"],
        "said": ORDER,
        "site": str(SITE),
        "places": [entry.id for entry in words.entries],
        "kinds": list(step_models()),
        "steps": len(PLAN["steps"]),
    }
    path = folder / "facts.json"
    path.write_text(json.dumps(content, ensure_ascii=False), "utf-8")
    return path
