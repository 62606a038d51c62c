"""Count the calls of tools by goal and by UTC day, so that they outlive the planner's process.

A call is counted before it is made. Blocks on the disk: never called in the event loop.
"""

from __future__ import annotations

from datetime import timedelta
from typing import TYPE_CHECKING

from planner.budget.utc_day import DayClocks, Days

if TYPE_CHECKING:
    from planner.state_database import StateDatabase

KEPT_DAYS = 40
_TABLE = """CREATE TABLE IF NOT EXISTS tool_calls (
    day TEXT NOT NULL, server TEXT NOT NULL, goal TEXT NOT NULL, calls INTEGER NOT NULL,
    PRIMARY KEY (day, server, goal)) WITHOUT ROWID"""


class CallLedger:
    """Keep the counts in the planner's database."""

    def __init__(self, database: StateDatabase, clocks: DayClocks | None = None) -> None:
        self._database = database
        self._days = Days(None, clocks or DayClocks())

    def count(self, server: str, goal: str, most_goal: int, most_day: int) -> str | None:
        """Count one call, or return the code of the bound that it would break.

        Raises:
            StateUnavailable: it can't be counted, and so is not to be made.
        """
        today = self._days.today()
        with self._database.change() as connection:
            connection.execute(_TABLE)
            query = "SELECT coalesce(sum(calls), 0) FROM tool_calls WHERE server = ? AND "
            (of_goal,) = connection.execute(f"{query} goal = ?", (server, goal)).fetchone()
            (of_day,) = connection.execute(f"{query} day = ?", (server, str(today))).fetchone()
            if not of_goal < most_goal:
                return "tool_goal_calls"
            if not of_day < most_day:
                return "tool_day_calls"
            connection.execute(
                "INSERT INTO tool_calls VALUES (?, ?, ?, 1)"
                " ON CONFLICT (day, server, goal) DO UPDATE SET calls = calls + 1",
                (str(today), server, goal),
            )
            oldest = str(today - timedelta(days=KEPT_DAYS))
            connection.execute("DELETE FROM tool_calls WHERE day < ?", (oldest,))
        return None

    def list_today(self) -> dict[str, int]:
        """Return today's calls by server."""
        if not self._database.read("SELECT 1 FROM sqlite_master WHERE name = 'tool_calls'"):
            return {}
        query = "SELECT server, sum(calls) FROM tool_calls WHERE day = ? GROUP BY server"
        return dict(self._database.read(query, (str(self._days.today()),)))
