"""Show how a goal goes on a terminal: a line for each change, and one that counts down.

Told what the planner answers; asks nobody.
"""

from __future__ import annotations

import sys
from typing import Any

from pons.terminal import pick
from pons.terminal_text import FINAL_STATES, step_line

_LEFT = (("left_m", "m", 1), ("left_s", "s", 0))


class ShownProgress:
    """Hold what was printed of one goal, so that nothing is said twice."""

    def __init__(self, *, silent: bool = False) -> None:
        self._lines: set[str] = set()
        self._silent = silent
        self._counts = not silent and sys.stdout.isatty()
        self._counting = False

    def has(self, line: str) -> bool:
        """Return whether a line was printed."""
        return line in self._lines

    def show(self, goal: dict[str, Any]) -> None:
        """Print what has changed; on a terminal also how far it still is, in one line that stays.

        A running goal is told by its steps: its own state would say the same again.
        """
        steps = (goal.get("plan") or {}).get("steps") or []
        lines = [step_line(number, step) for number, step in enumerate(steps, 1)]
        reason = f" ({goal['reason']})" if goal.get("reason") else ""
        state = str(goal["state"])
        if not (state == "running" and steps) and (
            reason or state not in FINAL_STATES or not steps
        ):
            lines.append(f"  {state}{reason}")
        self.print_new(lines)
        if self._counts:
            self._count_down(steps)

    def print_new(self, lines: list[str]) -> None:
        """Print the lines that were not printed before."""
        for line in lines:
            if line not in self._lines:
                self._lines.add(line)
                self.clear()
                if not self._silent:
                    print(line, flush=True)

    def clear(self) -> None:
        """Take the line that counts down away."""
        if self._counting:
            self._counting = False
            print("\r\x1b[K", end="", flush=True)

    def _count_down(self, steps: list[dict[str, Any]]) -> None:
        running = next((step for step in steps if step.get("state") == "running"), {})
        left = [
            f"{running[name]:.{digits}f} {unit}"
            for name, unit, digits in _LEFT
            if running.get(name) is not None
        ]
        if left:
            self._counting = True
            told = pick(f"{', '.join(left)} to go", f"还剩 {'，'.join(left)}")
            print(f"\r\x1b[K     {told}", end="", flush=True)
