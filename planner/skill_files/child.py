"""Run one skill of the owner's behind a wall: without files, sockets, processes, much memory.

Started by path (``python -I -S child.py``) with the standard library alone. A request of one JSON
object comes on standard input, the answer leaves by a pipe, and between them stands a filter of
system calls (seccomp) that lets a program compute and nothing else: what opens, connects, forks,
kills or executes is answered "not permitted". The filter can't be taken off again, and a machine on
which it can't be set up runs no function at all.
"""

from __future__ import annotations

import ast
import contextlib
import ctypes
import json
import os
import platform
import resource
import struct
import sys
import time
from types import TracebackType
from typing import Any, NoReturn

ALLOWED_MODULES = frozenset(
    {"__future__", "bisect", "collections", "dataclasses", "datetime", "enum", "fractions"}
    | {"functools", "heapq", "itertools", "json", "math", "operator", "pons", "random", "re"}
    | {"statistics", "string", "textwrap", "time", "typing", "unicodedata"}
)
"""They are loaded before the wall stands; no other can be, for nothing can be opened behind it."""
KINDS = {
    "Place": "place",
    "Thing": "thing",
    "Person": "person",
    "Words": "words",
    "Duration": "duration",
    "float": "number",
    "int": "number",
    "str": "words",
}
WORLD = "World"
MOST_REPLY_BYTES = 60_000
MEMORY_BYTES, CPU_S = 256 << 20, 2
_PR_SET_PDEATHSIG, _PR_SET_NO_NEW_PRIVS, _PR_SET_SECCOMP = 1, 38, 22  # prctl(2)
_LOAD, _IF_EQUAL, _RETURN = 0x20, 0x15, 0x06  # seccomp(2), struct sock_filter
_ALLOW, _KILL, _NOT_PERMITTED = 0x7FFF0000, 0x80000000, 0x00050000 | 1
_CALLS = {
    "x86_64": (
        0xC000003E,
        # read write close fstat lseek mmap mprotect munmap brk rt_sigaction rt_sigprocmask
        # rt_sigreturn mremap madvise nanosleep getpid exit gettimeofday sigaltstack gettid futex
        # restart_syscall clock_gettime clock_getres clock_nanosleep exit_group getrandom rseq
        "0 1 3 5 8 9 10 11 12 13 14 15 25 28 35 39 60 96 131 186 202 219 228 229 230 231 318 334",
    ),
    "aarch64": (
        0xC00000B7,
        (
            "63 64 57 80 62 222 226 215 214 134 135 139 "
            "216 233 101 172 93 169 132 178 98 128 113 114 115 94 278 293"
        ),
    ),
}
"""Of each machine its audit number and the calls that compute, wait and end, in one order."""


class SkillError(Exception):
    """Tell what is wrong in the file, and in which of its lines."""

    def __init__(self, code: str, line: int = 1, **facts: object) -> None:
        super().__init__(code)
        self.code, self.line, self.facts = code, line, facts


def read_function(source: str) -> dict[str, Any]:
    """Return what a file's one function takes and how it is called in words; runs nothing of it.

    Raises:
        SkillError: it is no such file.
    """
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as wrong:
        line = getattr(wrong, "lineno", None) or 1
        raise SkillError("skill_not_python", line, what=getattr(wrong, "msg", str(wrong))) from None
    functions = [
        each
        for each in tree.body
        if isinstance(each, ast.FunctionDef | ast.AsyncFunctionDef) and each.name[:1] != "_"
    ]
    if len(functions) != 1 or not isinstance(functions[0], ast.FunctionDef):
        line = functions[-1].lineno if functions else 1
        raise SkillError("skill_functions", line, count=len(functions))
    function = functions[0]
    opens = function.body[0]
    doc = (
        opens.value.value
        if isinstance(opens, ast.Expr) and isinstance(opens.value, ast.Constant)
        else ""
    )
    told = doc.splitlines() if isinstance(doc, str) else []
    words: dict[str, list[str]] = {"en": [], "zh": []}
    for line in told:
        tongue, mark, sentence = line.strip().partition(":")
        if mark and tongue in words and sentence.strip():
            words[tongue].append(sentence.strip())
    return {
        "function": function.name,
        "line": function.lineno,
        "about": told[0].strip() if told else "",
        "en": words["en"],
        "zh": words["zh"],
        "parameters": list(_parameters(function)),
    }


def _parameters(function: ast.FunctionDef) -> Any:
    given = function.args
    if given.vararg or given.kwarg or given.kwonlyargs or given.posonlyargs or not function.returns:
        raise SkillError("skill_parameters", function.lineno)
    defaults = [None] * (len(given.args) - len(given.defaults)) + list(given.defaults)
    for parameter, default in zip(given.args, defaults, strict=True):
        named = parameter.annotation
        name = getattr(named, "id", getattr(named, "attr", getattr(named, "value", None)))
        if name == WORLD:
            yield {"name": parameter.arg, "kind": "world"}
        elif name not in KINDS:
            raise SkillError("skill_untyped", parameter.lineno, name=parameter.arg)
        else:
            made: dict[str, Any] = {"name": parameter.arg, "kind": KINDS[str(name)]}
            if default is not None:
                made["default"] = _constant(default)
            yield made


def _constant(default: ast.expr) -> str:
    value = default.value if isinstance(default, ast.Constant) else None
    if not isinstance(value, str | int | float) or isinstance(value, bool):
        raise SkillError("skill_default", default.lineno)
    return str(value)


def run_function(source: str, function: str, given: list[Any], root: str) -> dict[str, Any]:
    """Return what a function returns: words, facts or steps. Raises what it raises."""
    wanted = _modules(source)
    sys.path.append(root)
    for module in sorted(wanted & ALLOWED_MODULES):
        __import__("pons.skill" if module == "pons" else module)
    from pons.skill import World

    time.localtime()  # reads the machine's time zone, which can't be opened later
    raise_wall()
    space: dict[str, Any] = {"__name__": "skill"}
    exec(compile(source, "skill", "exec"), space)  # behind the wall, as it says above
    told = [World(**each) if isinstance(each, dict) else each for each in given]
    return _result(space[function](*told))


def _modules(source: str) -> set[str]:
    found: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, ast.Import | ast.ImportFrom):
            continue
        if isinstance(node, ast.Import):
            names = [each.name for each in node.names]
        else:
            names = [node.module or ""]
        for name in (each.partition(".")[0] for each in names):
            found.add(name)
            if name not in ALLOWED_MODULES:
                known = ", ".join(sorted(ALLOWED_MODULES - {"__future__"}))
                raise SkillError("skill_module", node.lineno, name=name[:60], known=known)
    return found


def _result(value: object) -> dict[str, Any]:
    if isinstance(value, str):
        return {"words": value}
    plain = (str, int, float, bool)
    if isinstance(value, dict) and "kind" not in value:
        if all(isinstance(k, str) and isinstance(v, plain) for k, v in value.items()):
            return {"facts": value}
    elif isinstance(value, list | tuple) and all(isinstance(each, dict) for each in value):
        return {"steps": list(value)}
    raise SkillError("skill_result", 1, what=type(value).__name__)


def bound_resources() -> None:
    """Bound memory, processor time, files and core dumps of this process; it can't raise them."""
    for which, most in (
        (resource.RLIMIT_AS, MEMORY_BYTES),
        (resource.RLIMIT_CPU, CPU_S),
        (resource.RLIMIT_FSIZE, 0),
        (resource.RLIMIT_CORE, 0),
    ):
        # At the hard limit of a processor's time the kernel kills without a word of why.
        hard = most + 1 if which == resource.RLIMIT_CPU else most
        resource.setrlimit(which, (most, hard))


def raise_wall() -> None:
    """Let this process compute and end, and nothing else. Raises SkillError: it can't be done."""
    libc = ctypes.CDLL(None, use_errno=True)
    libc.prctl(_PR_SET_PDEATHSIG, 9, 0, 0, 0)
    if platform.machine() not in _CALLS or sys.maxsize < 2**32:
        raise SkillError("skill_no_wall", what=platform.machine())
    audit, calls = _CALLS[platform.machine()]
    rows = [(_LOAD, 0, 0, 4), (_IF_EQUAL, 1, 0, audit), (_RETURN, 0, 0, _KILL), (_LOAD, 0, 0, 0)]
    for call in map(int, calls.split()):
        rows += [(_IF_EQUAL, 0, 1, call), (_RETURN, 0, 0, _ALLOW)]
    rows.append((_RETURN, 0, 0, _NOT_PERMITTED))
    code = ctypes.create_string_buffer(b"".join(struct.pack("HBBI", *row) for row in rows))
    program = ctypes.create_string_buffer(struct.pack("HP", len(rows), ctypes.addressof(code)))
    if libc.prctl(_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) or libc.prctl(
        _PR_SET_SECCOMP, 2, program, 0, 0
    ):
        raise SkillError("skill_no_wall", what=os.strerror(ctypes.get_errno()))


def _line_of(trace: TracebackType | None) -> int:
    """Return the last line of the skill's own file in a traceback."""
    line = 1
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == "skill":
            line = trace.tb_lineno
        trace = trace.tb_next
    return line


def main() -> NoReturn:
    """Read the request, answer it and end at once: nothing of the file's is run on the way out."""
    reply_to = int(sys.argv[1])
    try:
        asked = json.load(sys.stdin)
        bound_resources()
        if asked["function"] is None:
            raise_wall()
            answer = read_function(asked["source"])
        else:
            answer = run_function(asked["source"], asked["function"], asked["given"], sys.argv[2])
        told = json.dumps(answer, allow_nan=False)
    except SkillError as wrong:
        told = json.dumps({"code": wrong.code, "line": wrong.line, "facts": wrong.facts})
    except MemoryError as wrong:
        told = json.dumps({"code": "skill_memory", "line": _line_of(wrong.__traceback__)})
    except BaseException as wrong:  # noqa: BLE001  # whatever an owner's program raises
        what = f"{type(wrong).__name__}: {wrong}"[:200]
        told = json.dumps(
            {"code": "skill_raised", "line": _line_of(wrong.__traceback__), "facts": {"what": what}}
        )
    with contextlib.suppress(OSError):
        os.write(reply_to, told.encode("utf-8", "replace")[: MOST_REPLY_BYTES + 1])
    os._exit(0)


if __name__ == "__main__":
    main()
