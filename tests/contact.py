"""End a run in which a robot touched something by an exit status of its own.

A story that failed may be told again (scripts/stories.sh), for a machine may stall it; a contact is
no matter of time, so no script takes this status for one that may be tried again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pytest

SEEN = "CONTACT SEEN"
"""What a story's failure says; text, because only text comes back from the processes of xdist."""
STATUS = 9
"""pytest itself uses 0 to 5."""


class Contacts:
    """Listen to all reports of a run; set its exit status at the end."""

    def __init__(self) -> None:
        self._seen = False

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Hear how a test ended, here or in a process of xdist."""
        self._seen = self._seen or (report.failed and SEEN in report.longreprtext)

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Say it with the exit status."""
        if self._seen:
            session.exitstatus = STATUS
