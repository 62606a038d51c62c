"""Change one thing at a time in bridge/core and see whether a test notices (docs/adr/0019).

``make mutants ARGS="--sample 20 limiter latch"``: at most 20 mutants a file, chosen evenly; without
names all files. Tests are the quick suite; ``--all --again`` tries its survivors on all that need
no hypothesis. One process: pytest collects once, each mutant is a fork in which one function's
code is replaced and the tests that call it run, quickest first. A change outside functions (tables,
windows) imports the core anew. Results are kept in .mutants/results.jsonl, so a run may be broken
off and gone on with. Nothing on disk is ever changed.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import json
import os
import pickle
import resource
import signal
import sys
import time
from collections import defaultdict
from pathlib import Path
from types import CodeType, FrameType, FunctionType, ModuleType

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from scripts.mutation import Mutant, changed, mutants_of

ROOT = Path(__file__).resolve().parents[1]
CORE = ROOT / "bridge" / "core"
KEPT = ROOT / ".mutants" / "results.jsonl"
PYTEST = ["-q", "-x", "-p", "no:randomly", "-p", "no:cacheprovider"]
FIRST = ("limiter", "latch", "transition", "modes", "decide", "stops", "operator", "grants",
         "ownership", "gate", "contactgate", "fencegate", "obstaclegate")  # fmt: skip
LIMIT_S = 90
"""Of processor time."""
UNTESTED = {"docs", "hazards", "row_words", "__init__", "codec", "config", "decision"}
"""Words, pages and records without a decision in them."""


def function_at(module: ModuleType, qualname: str) -> FunctionType | None:
    """Return the live function of a module by its qualified name."""
    found: object = module
    for part in qualname.split("."):
        found = vars(found).get(part) if hasattr(found, "__dict__") else None
    for inner in ("fget", "__func__", "__wrapped__"):
        found = getattr(found, inner, found)
    return found if isinstance(found, FunctionType) else None


def code_at(code: CodeType, qualname: str) -> CodeType:
    """Return the code of a function inside a module's code."""
    for part in qualname.split("."):
        code = next(c for c in code.co_consts if isinstance(c, CodeType) and c.co_name == part)
    return code


class Loop:
    """Be pytest's run loop: run every mutant instead of every test once."""

    def __init__(self, wanted: argparse.Namespace) -> None:
        self.wanted = wanted
        self.done = {}
        if KEPT.exists():
            rows = [json.loads(line) for line in KEPT.read_text("utf-8").splitlines()]
            self.done = {row["key"]: row["result"] for row in rows}

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Measure the tests once, then try the mutants."""
        if not self.wanted.tests:
            reached = importlib.import_module("tests.bridge.core.reached")
            for start in reached.STARTS:
                reached.reached(start)  # once, unchanged, for all children
        items = [i for i in session.items if not getattr(i.obj, "is_hypothesis_test", False)]  # type: ignore[attr-defined]  # functions only
        calls = self._baseline(items)
        for name in self.wanted.names:
            path = CORE / f"{name}.py"
            mutants = mutants_of(path.read_text("utf-8"))
            step = max(1, len(mutants) // self.wanted.sample) if self.wanted.sample else 1
            chosen = mutants[::step][: self.wanted.sample or None]
            counts: dict[str, int] = defaultdict(int)
            for mutant in sorted(chosen, key=lambda one: not one.where):  # imports anew come last
                key = f"{name}:{mutant.key}"
                result = self.done.get(key)
                if result is None or (self.wanted.again and result == "survived"):
                    result = self._try(name, mutant, items, calls)
                    self._keep(key, name, mutant, result)
                counts[result] += 1
            print(
                f"{name}: {len(mutants)} mutants, tried {len(chosen)}: {dict(counts)}", flush=True
            )
        return True

    def _keep(self, key: str, name: str, mutant: Mutant, result: str) -> None:
        KEPT.parent.mkdir(exist_ok=True)
        row = {"key": key, "result": result, "line": mutant.line, "what": mutant.what}
        with KEPT.open("a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
        print(f"{result:9} {name}.py:{mutant.line} {mutant.where} {mutant.what}", flush=True)

    def _baseline(self, items: list[pytest.Item]) -> dict[str, list[pytest.Item]]:
        """Run all tests once, unchanged; return which call each function, quickest first."""
        kind = "-".join(self.wanted.tests) or ("all" if self.wanted.all else "quick")
        file = KEPT.parent / f"baseline-{kind}.pickle"
        KEPT.parent.mkdir(exist_ok=True)
        if not file.exists() or self.wanted.afresh:
            if os.fork() == 0:
                code = self._measure(items, file)
                os._exit(code)
            if os.wait()[1] != 0:
                raise SystemExit("the tests fail without any mutant; mend them first")
        took, called = pickle.loads(file.read_bytes())  # written above, by this program
        by: dict[str, list[pytest.Item]] = defaultdict(list)
        for item in sorted(items, key=lambda one: took.get(one.nodeid, 9.0)):
            for name in called.get(item.nodeid, ()):
                by[name].append(item)
        return by

    def _measure(self, items: list[pytest.Item], file: Path) -> int:
        took: dict[str, float] = {}
        called: dict[str, set[str]] = {}
        core = str(CORE)
        seen: set[CodeType] = set()

        def note(frame: FrameType, event: str, _: object) -> None:
            if event == "call":
                seen.add(frame.f_code)

        for index, item in enumerate(items):
            seen.clear()
            began_s = time.process_time()
            sys.setprofile(note)
            bad = run_item(items, index)
            sys.setprofile(None)
            if bad:
                print("fails:", item.nodeid)
                return 1
            took[item.nodeid] = time.process_time() - began_s
            called[item.nodeid] = {
                f"{Path(c.co_filename).stem}:{c.co_qualname.split('.<locals>')[0]}"
                for c in seen
                if c.co_filename.startswith(core)
            }
        file.write_bytes(pickle.dumps((took, called)))
        return 0

    def _try(
        self,
        name: str,
        mutant: Mutant,
        items: list[pytest.Item],
        calls: dict[str, list[pytest.Item]],
    ) -> str:
        child = os.fork()
        if child == 0:
            limit_s = self.wanted.seconds
            resource.setrlimit(resource.RLIMIT_CPU, (limit_s, limit_s + 5))
            quiet = os.open(os.devnull, os.O_WRONLY)
            os.dup2(quiet, 1)
            os.dup2(quiet, 2)
            tests = calls.get(f"{name}:{mutant.where}", [])
            os._exit(in_child(name, mutant, tests, marks(self.wanted)))
        status = os.waitpid(child, 0)[1]
        if os.WIFSIGNALED(status):
            return "timeout" if os.WTERMSIG(status) == signal.SIGXCPU else "killed"
        return {0: "survived", 3: "uncalled"}.get(os.WEXITSTATUS(status), "killed")


def run_item(items: list[pytest.Item], index: int) -> bool:
    """Run one test; tell whether it failed."""
    following = items[index + 1] if index + 1 < len(items) else None
    session = items[index].session
    before = session.testsfailed
    items[index].config.hook.pytest_runtest_protocol(item=items[index], nextitem=following)
    return session.testsfailed > before


def marks(wanted: argparse.Namespace) -> list[str]:
    """Return pytest's choice of tests."""
    return ["-m", "not slow" if wanted.all or wanted.tests else "core_quick"]


def in_child(name: str, mutant: Mutant, items: list[pytest.Item], chosen: list[str]) -> int:
    """Replace the code and run the tests; 0: none noticed, 1: one did, 3: none calls it."""
    module = sys.modules[f"bridge.core.{name}"]
    function = function_at(module, mutant.where) if mutant.where else None
    file = CORE / f"{name}.py"
    code = compile(changed(file.read_text("utf-8"), mutant), str(file), "exec")
    if function is None:
        return imported_anew(f"bridge.core.{name}", code, chosen)
    function.__code__ = code_at(code, mutant.where)
    if not items:
        return 3
    return int(any(run_item(items, index) for index in range(len(items))))


def imported_anew(module: str, code: CodeType, chosen: list[str]) -> int:
    """Import core and tests again with one module changed, and run the tests."""
    for loaded in [one for one in sys.modules if one.startswith(("bridge.", "tests", "lockstep"))]:
        del sys.modules[loaded]

    class Changed:
        def find_spec(self, wanted: str, *_: object) -> object:
            return importlib.util.spec_from_loader(wanted, self) if wanted == module else None  # type: ignore[arg-type]  # a loader by its methods

        def create_module(self, _: object) -> None:
            return None

        def exec_module(self, made: ModuleType) -> None:
            made.__file__ = str(CORE / f"{module.rpartition('.')[2]}.py")
            exec(code, made.__dict__)  # the mutant, compiled here

    sys.meta_path.insert(0, Changed())  # type: ignore[arg-type]  # a finder by its method
    return int(pytest.main([*PYTEST, *chosen, *TESTS]) != 0)


TESTS = [str(ROOT / "tests" / "bridge" / "core")]


def main() -> int:
    """Try the mutants of the files that are named."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="modules of bridge/core; none: all")
    parser.add_argument("--sample", type=int, default=0, help="at most so many mutants a file")
    parser.add_argument("--again", action="store_true", help="try survivors once more")
    parser.add_argument("--all", action="store_true", help="all tests without hypothesis")
    parser.add_argument("--tests", nargs="*", default=[], help="only these files of tests")
    parser.add_argument("--seconds", type=int, default=LIMIT_S, help="of processor time a mutant")
    parser.add_argument("--afresh", action="store_true", help="measure the tests anew")
    wanted = parser.parse_args()
    rest = sorted(p.stem for p in CORE.glob("*.py") if p.stem not in UNTESTED | set(FIRST))
    wanted.names = wanted.names or [*FIRST, *rest]
    os.chdir(ROOT)
    chosen = [f"{TESTS[0]}/{name}.py" for name in wanted.tests]
    arguments = [*PYTEST, "-s", *marks(wanted), *(chosen or TESTS)]
    return int(pytest.main(arguments, plugins=[Loop(wanted)]))


if __name__ == "__main__":
    sys.exit(main())
