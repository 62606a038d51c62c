"""Change one thing at a time in bridge/core and see whether a test notices (docs/adr/0019).

``make mutants ARGS="limiter latch"``: without names all files, those first that decide motion. One
process: pytest collects once, each mutant is a fork that runs the tests that walk its line, until
one fails. Results are kept in .mutants/results.jsonl, so a run may be broken off and gone on with:
``--again`` tries what lived or was not decided once more, ``--report`` counts what is known of the
source as it is now, ``--outside`` keeps to what stands outside functions: tables, constants and
defaults of records. Nothing on disk is ever changed.
"""

from __future__ import annotations

import argparse
import ast
import gc
import importlib
import json
import os
import resource
import signal
import sys
from collections import Counter
from collections.abc import Callable
from functools import partial
from types import CodeType
from typing import NoReturn

import pytest

from tools.mutants.child import (
    PYTEST,
    files_first,
    function_at,
    import_anew,
    put_constants,
    put_function,
)
from tools.mutants.line_tests import (
    KEPT,
    ROOT,
    LineTests,
    file_of,
    first_that_fails,
    modules,
    plain,
)
from tools.mutants.mutations import Mutant, mutants_of

RESULTS = KEPT / "results.jsonl"
TESTS = ROOT / "tests" / "bridge" / "core"
FIRST = tuple(
    """
    mode_logic step fault_latch transition motion_gates stop_monitor limiter grants ownership
    leg_tracking horizon_checks path_profile pursuit operator contact_gate fence_gate obstacle_gate
    mode_table stop_profile wheel_command teleop external_velocity
    """.split()  # noqa: SIM905  # one name a word reads better
)
"""Modules that decide motion, by the last part of their names."""
UNTESTED = {
    "docs",
    "code_messages",
    "hazards",
    "fault_messages",
    "codec",
    "config",
    "decision",
}
"""Words, pages and records without a decision in them."""
LIMIT_S = 20
"""Of processor time a mutant."""
ALIVE = {"survived", "uncalled", "undecided", "broken"}
OTHER, NOTHING, UNCALLED, BROKEN = 249, 250, 251, 252
"""Exit codes of a child; below these: the number of the test that noticed."""


def known_results() -> dict[str, str]:
    """Return the results so far, by key; the last one counts."""
    if not RESULTS.exists():
        return {}
    rows = [json.loads(line) for line in RESULTS.read_text("utf-8").splitlines()]
    return {row["key"]: row["result"] for row in rows}


class MutantLoop:
    """Be pytest's run loop: run every mutant instead of every test once."""

    def __init__(self, wanted: argparse.Namespace) -> None:
        self.wanted = wanted
        self.done = known_results()

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Measure the tests once, then try the mutants."""
        sources = {name: file_of(name).read_text("utf-8") for name in self.wanted.names}
        reached = importlib.import_module("tests.bridge.core.reached")
        for start in reached.STARTS:
            reached.reached(start)  # once, unchanged, for all children
        KEPT.mkdir(exist_ok=True)
        walked = LineTests(plain(session.items))
        gc.collect()
        gc.freeze()
        for outside in parts(self.wanted):
            for name, source in sources.items():
                self._file(name, source, walked, outside=outside)
        return True

    def _file(self, name: str, source: str, walked: LineTests, *, outside: bool) -> None:
        tree, mutants = mutants_of(source)
        mutants = [one for one in mutants if in_no_function(one[0]) is outside]
        step = max(1, len(mutants) // self.wanted.sample) if self.wanted.sample else 1
        counts: Counter[str] = Counter()
        sound = not outside
        for mutant, change in mutants[::step]:
            key = f"{name}:{mutant.key}"
            result = self.done.get(key)
            if result is None or (self.wanted.again and result in ALIVE):
                sound = sound or self._sound(name, source, walked)
                number = partial(try_mutant, name, mutant, change, tree, walked, self.wanted)
                status = in_child(number, self.wanted.seconds)
                result = self._result_of(name, mutant, status, walked)
                self._keep(key, name, mutant, result)
            counts[result] += 1
        if mutants:
            print(f"{name}: {len(mutants)}, tried {counts.total()}: {dict(counts)}", flush=True)

    def _sound(self, name: str, source: str, walked: LineTests) -> bool:
        """Tell that no test fails when the unchanged module is imported anew; else end the run.

        A test that fails of the import alone would notice every mutant, and tell nothing.
        """
        code = compile(source, str(file_of(name)), "exec")
        again = (f"bridge.core.{name}", code, files_first(walked, name), pytest_choice(self.wanted))
        status = in_child(lambda: OTHER if import_anew(*again) else NOTHING, resource.RLIM_INFINITY)
        if not os.WIFEXITED(status) or os.WEXITSTATUS(status) != NOTHING:
            raise SystemExit(f"{name}, imported anew without any mutant, fails a test")
        return True

    def _result_of(self, name: str, mutant: Mutant, status: int, walked: LineTests) -> str:
        if os.WIFSIGNALED(status):
            how = signal.Signals(os.WTERMSIG(status))
            return {signal.SIGXCPU: "undecided", signal.SIGPROF: "hung"}.get(how, "killed")
        code = os.WEXITSTATUS(status)
        if code >= NOTHING:
            return {NOTHING: "survived", UNCALLED: "uncalled"}.get(code, "broken")
        keys = tests_of(walked, name, mutant)
        if code < len(keys):
            walked.noticed[f"{name}:{mutant.where}"][keys[code]] += 1
        return "killed"

    def _keep(self, key: str, name: str, mutant: Mutant, result: str) -> None:
        row = {"key": key, "result": result, "line": mutant.line, "what": mutant.what}
        with RESULTS.open("a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
        if result in ALIVE:
            print(f"{result:9} {name}.py:{mutant.line} {mutant.where} {mutant.what}", flush=True)


def parts(wanted: argparse.Namespace) -> tuple[bool, ...]:
    """Return which mutants to try, by whether they stand outside functions.

    Those may need core and tests imported anew: they come last.
    """
    return (True,) if wanted.outside else (False, True)


def in_no_function(mutant: Mutant) -> bool:
    """Tell whether a mutant changes a table, a constant or a record's default."""
    return not mutant.where or mutant.where.rpartition(".")[2][:1].isupper()


def tests_of(walked: LineTests, name: str, mutant: Mutant) -> list[str]:
    """Return the tests that walk a mutant's line, or else those that walk its function."""
    function = f"{name}:{mutant.where}"
    found = walked.tests(name, {mutant.line}, function)
    if found or not mutant.where:
        return found
    held = function_at(sys.modules[f"bridge.core.{name}"], mutant.where)
    if held is None:
        return []
    lines = {line for _, _, line in held[0].__code__.co_lines() if line is not None}
    return walked.tests(name, lines - {min(lines)}, function)


def in_child(number: Callable[[], int], seconds: int) -> int:
    """Fork, end the child with a number and return its wait status.

    Nothing may leave the child but that number: the parent's frames are above it.

    Args:
        number: run in the child, which says nothing; at most 255.
        seconds: of processor time that the child may take [s].
    """
    child = os.fork()
    if child == 0:
        exit_with(number, seconds)
    return os.waitpid(child, 0)[1]


def exit_with(number: Callable[[], int], seconds: int) -> NoReturn:
    """End this process by what a function returns, or as broken where it raises."""
    code = BROKEN
    try:
        quiet = os.open(os.devnull, os.O_WRONLY)
        os.dup2(quiet, 1)
        os.dup2(quiet, 2)
        most = seconds if seconds == resource.RLIM_INFINITY else seconds + 5
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, most))
        code = number()
    finally:
        os._exit(code)


def try_mutant(
    name: str,
    mutant: Mutant,
    change: Callable[[], None],
    tree: ast.Module,
    walked: LineTests,
    wanted: argparse.Namespace,
) -> int:
    """Make a mutant's change and return the number of the test that noticed."""
    change()
    made = compile(ast.fix_missing_locations(tree), str(file_of(name)), "exec")
    return number_of_noticing(name, mutant, made, walked, wanted)


def number_of_noticing(
    name: str, mutant: Mutant, code: CodeType, walked: LineTests, wanted: argparse.Namespace
) -> int:
    """Return the number of the test that noticed, of those that ``tests_of`` names."""
    module = sys.modules[f"bridge.core.{name}"]
    held = function_at(module, mutant.where)
    keys = tests_of(walked, name, mutant)
    if held is not None:
        put_function(*held, code)
    else:
        try:
            lines = put_constants(module, code)
        except Exception:  # noqa: BLE001  # it cannot even be imported: that is noticed
            return OTHER
        if lines is None:
            stages = files_first(walked, name)
            return (
                OTHER
                if import_anew(module.__name__, code, stages, pytest_choice(wanted))
                else NOTHING
            )
        several = {key for one, at in lines.items() for key in walked.tests(one, at, "")}
        keys = sorted(several, key=walked.order.__getitem__)
    if not keys:
        return UNCALLED
    noticed = first_that_fails(walked, keys)
    return NOTHING if noticed < 0 else min(noticed, OTHER)


def names_of(words: list[str]) -> list[str]:
    """Return the modules that words name, or all: those first that decide motion.

    Raises:
        SystemExit: a word names none, or several.
    """
    every = modules()
    by_leaf: dict[str, list[str]] = {}
    for name in every:
        by_leaf.setdefault(name.rpartition(".")[2], []).append(name)
    if not words:
        first = [name for leaf in FIRST for name in by_leaf.get(leaf, ())]
        rest = [one for one in every if one.rpartition(".")[2] not in UNTESTED | set(FIRST)]
        return first + rest
    found = []
    for word in words:
        named = [word] if word in every else by_leaf.get(word, [])
        if len(named) != 1:
            raise SystemExit(f"{word!r} names {named or 'no module'}; modules: {', '.join(every)}")
        found += named
    return found


def pytest_choice(wanted: argparse.Namespace) -> str:
    """Return pytest's choice of tests."""
    return "core_quick" if wanted.quick else "not slow"


def report(wanted: argparse.Namespace) -> None:
    """Print what is known of the source as it is: a table by file, then each that lives."""
    done, alive = known_results(), []
    print("| file | mutants | tried | noticed | undecided | alive |\n|---|---|---|---|---|---|")
    cells = ("mutants", "tried", "noticed", "undecided", "alive")
    whole: Counter[str] = Counter()
    for name in wanted.names:
        _, made = mutants_of(file_of(name).read_text("utf-8"))
        mutants = [one for one, _ in made if in_no_function(one) in parts(wanted)]
        found = Counter(done.get(f"{name}:{one.key}", "untried") for one in mutants)
        row = Counter(
            mutants=len(mutants),
            tried=len(mutants) - found["untried"],
            noticed=found["killed"] + found["hung"],
            undecided=found["undecided"],
            alive=found["survived"] + found["uncalled"],
        )
        whole += row
        print(f"| {name} |", " | ".join(str(row[cell]) for cell in cells), "|")
        alive += [
            f"{done[f'{name}:{one.key}']} {name}.py:{one.line} {one.where} {one.what}"
            for one in mutants
            if done.get(f"{name}:{one.key}") in ALIVE
        ]
    print("| all |", " | ".join(str(whole[cell]) for cell in cells), "|")
    print("\n".join(alive))


def main() -> int:
    """Try the mutants of the files that are named."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "names", nargs="*", help="as limiter or motion.limiter; none: all of bridge/core"
    )
    parser.add_argument("--sample", type=int, default=0, help="at most so many mutants a file")
    parser.add_argument("--again", action="store_true", help="try what lived once more")
    parser.add_argument("--quick", action="store_true", help="the quick suite only")
    parser.add_argument("--outside", action="store_true", help="only what is in no function")
    parser.add_argument("--seconds", type=int, default=LIMIT_S, help="of processor time a mutant")
    parser.add_argument("--report", action="store_true", help="count what is known, try nothing")
    wanted = parser.parse_args()
    wanted.names = names_of(wanted.names)
    os.chdir(ROOT)
    if wanted.report:
        report(wanted)
        return 0
    arguments = [*PYTEST, "-m", pytest_choice(wanted), str(TESTS)]
    return int(pytest.main(arguments, plugins=[MutantLoop(wanted)]))


if __name__ == "__main__":
    sys.exit(main())
