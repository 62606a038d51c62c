"""Start the process that reads or runs a function of the owner's, and bound what it may cost.

Each call is a process of its own (``child.py``): an empty environment, a folder with nothing in it,
no descriptor but the pipe of its answer; it is killed at its limit. Blocks: call it beside a loop.
"""

from __future__ import annotations

import json
import os
import select
import subprocess
import sys
import tempfile
from pathlib import Path
from time import monotonic
from typing import Any

from planner.skill_files.child import MOST_REPLY_BYTES
from planner.skill_files.problems import SkillProblem

CHILD = Path(__file__).with_name("child.py")
ROOT = CHILD.parents[2]
"""Where the package ``pons`` lies, whose ``skill`` a function may load."""
WALL_S = 5.0
"""By the clock; of a processor it gets two seconds."""


def read_source(file: str, source: str) -> dict[str, Any]:
    """Return what a file's function takes and how it is called. Raises SkillProblem."""
    return _ask(file, {"source": source, "function": None})


def call_function(file: str, source: str, function: str, given: list[Any]) -> dict[str, Any]:
    """Return what a function answers: ``words``, ``facts`` or ``steps``. Raises SkillProblem."""
    return _ask(file, {"source": source, "function": function, "given": given})


def _ask(file: str, asked: dict[str, Any]) -> dict[str, Any]:
    raw, ended = _exchange(json.dumps(asked).encode())
    if len(raw) > MOST_REPLY_BYTES:
        raise SkillProblem("skill_result_long", file, most=MOST_REPLY_BYTES)
    if ended is None or ended == -24:  # SIGXCPU
        raise SkillProblem("skill_slow", file, seconds=f"{WALL_S:.0f}")
    try:
        answer = json.loads(raw)
    except (ValueError, RecursionError):
        answer = None
    if not isinstance(answer, dict):
        raise SkillProblem("skill_died", file, what=f"exit status {ended}")
    if (code := answer.get("code")) is None:
        return answer
    try:
        found = SkillProblem(str(code), file, int(answer.get("line", 1)), **answer.get("facts", {}))
    except (KeyError, TypeError, ValueError):  # written by the program itself, past our own answer
        raise SkillProblem("skill_died", file, what="an answer of its own making") from None
    raise found


def _exchange(request: bytes) -> tuple[bytes, int | None]:
    """Return the bytes of the answer and the exit status; None where the time was up."""
    limit_s = monotonic() + WALL_S
    reads, writes = os.pipe()
    try:
        with tempfile.TemporaryDirectory(prefix="pons-skill-") as empty:
            child = subprocess.Popen(  # our own program, by our own interpreter
                [sys.executable, "-I", "-S", str(CHILD), str(writes), str(ROOT)],
                stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                pass_fds=(writes,), env={}, cwd=empty, start_new_session=True,
            )  # fmt: skip
            os.close(writes)
            writes = -1
            told = b""
            try:
                _send(child, request)
                told = _receive(reads, limit_s)
                return told, child.wait(max(0.0, limit_s - monotonic()))
            except subprocess.TimeoutExpired:
                return told, None
            finally:
                child.kill()
                child.wait()
    finally:
        os.close(reads)
        if writes >= 0:
            os.close(writes)


def _send(child: subprocess.Popen[bytes], request: bytes) -> None:
    """Write the request, which the child reads before it does anything else."""
    if child.stdin is not None:
        try:
            child.stdin.write(request)
            child.stdin.close()
        except BrokenPipeError:
            return


def _receive(reads: int, limit_s: float) -> bytes:
    told = b""
    while len(told) <= MOST_REPLY_BYTES and (left_s := limit_s - monotonic()) > 0.0:
        if not select.select([reads], [], [], left_s)[0]:
            break
        part = os.read(reads, 65_536)
        if not part:
            break
        told += part
    return told
