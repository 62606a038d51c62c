"""Find the system's Chromium, and start it behind a robot, as a browser on another machine is."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from shlex import quote

CHROMIUM = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome")
BEHIND = """#!/bin/sh
if [ "$(ps -o sid= -p $$ | tr -d ' ')" = $$ ]; then
  {{ echo 10 > /proc/self/autogroup; }} 2> /dev/null
fi
exec nice -n 10 {} "$@"
"""
"""Where Linux weighs sessions, a process's own nice counts within its session only (ADR 0026)."""


def chromium() -> str | None:
    """Return the system's Chromium, if there is one."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, CHROMIUM)), None)


def behind(folder: Path, chromium: str) -> Path:
    """Write a command that starts Chromium behind the robot: a person's is on another machine."""
    command = folder / "chromium"
    command.write_text(BEHIND.format(quote(chromium)), "utf-8")
    command.chmod(0o700)
    return command
