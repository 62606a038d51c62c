"""A log is lines for people, or objects for programs where the environment asks for them."""

from __future__ import annotations

import json
import os
import subprocess
import sys

from processes.log_lines import VARIABLE

PROGRAM = (
    "import logging; from processes.log_lines import begin_log; begin_log(); "
    "log = logging.getLogger('bridge'); log.info('你好 %d', 3)\n"
    "try: 1 / 0\n"
    "except ZeroDivisionError: log.exception('broken')"
)


def logged(**environment: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env={**os.environ, **environment}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    return done.stderr


def test_lines_are_for_people_unless_asked() -> None:
    assert "bridge INFO 你好 3" in logged(**{VARIABLE: ""})


def test_each_line_is_an_object_where_asked() -> None:
    first, second = (json.loads(line) for line in logged(**{VARIABLE: "json"}).splitlines())
    assert first["message"] == "你好 3"
    assert (first["level"], first["logger"]) == ("info", "bridge")
    assert first["time"].endswith("+00:00")
    assert "ZeroDivisionError" in second["error"]
