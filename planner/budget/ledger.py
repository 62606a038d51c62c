"""Keep what was spent on disk: a file a day, a line for each change, appended before a call goes.

Files are only ever appended to, so that a crash at any instant loses nothing that was counted, and
another program of the same home (an exam, a replay) may spend from the same budget. Knows no limit.
"""

from __future__ import annotations

import logging
import os
import re
import time
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from datetime import date, timedelta
from pathlib import Path

from planner.budget.daily_file import MAX_ID, Page
from planner.budget.totals import Spent
from wire import Misconfigured

log = logging.getLogger(__name__)

FOLDER = "spent"
LOOK_BACK_DAYS = 8
"""How old a goal's first spending may be to be remembered by a new process."""
KEPT_DAYS = 92
MAX_GOALS = 20_000
SYNC_EVERY_S = 1.0
_NAME = re.compile(r"(\d{4}-\d\d-\d\d)\.jsonl")


class Ledger:
    """Be one home's ledger. For one thread."""

    def __init__(self, home: Path) -> None:
        """Find the days that are there; nothing is made before something is spent.

        Raises:
            Misconfigured: ``budget_unreadable``.
        """
        self._folder = home / FOLDER
        self._goals: dict[str, Spent] = {}
        self._current: Page | None = None
        self._syncing: Future[None] | None = None
        self._syncer = ThreadPoolExecutor(1, "spent")
        self._synced_s = float("-inf")
        try:
            self._pages = {day: Page(self._path(day)) for day in self._found()}
        except OSError as error:
            raise self._unreadable(error) from None

    @property
    def newest(self) -> date | None:
        """Return the newest day of which something is kept."""
        return max(self._pages, default=None)

    def remember(self, today: date) -> None:
        """Read what the goals of the last days have spent, and throw very old days away.

        Raises:
            Misconfigured: ``budget_unreadable``.
        """
        try:
            for day in sorted(self._pages):
                if day < today - timedelta(days=KEPT_DAYS):
                    _throw_away(self._pages.pop(day).path)
                elif day >= today - timedelta(days=LOOK_BACK_DAYS):
                    self.of_day(day)
        except OSError as error:
            raise self._unreadable(error) from None

    def of_day(self, day: date) -> Spent:
        """Return what was spent on a day, by whichever program. Raises OSError."""
        page = self._page(day)
        for goal, change in page.fresh():
            self._goals[goal] = self._goals.get(goal, Spent()) + change
        while len(self._goals) > MAX_GOALS:
            del self._goals[next(iter(self._goals))]
        return page.spent

    def of_goal(self, goal: str) -> Spent:
        """Return what a goal has spent, as of the last look at a day."""
        return self._goals.get(goal[:MAX_ID], Spent())

    def append(self, day: date, goal: str, change: Spent, *, sync: bool) -> None:
        """Keep a change; on return it outlives this process.

        Args:
            day: whose page.
            goal: whose spending.
            change: what to add.
            sync: have it outlive a power cut soon as well, without waiting for that.

        Raises:
            OSError: it can't be kept.
        """
        page = self._page(day)
        page.append(goal, change)
        if sync:
            self._sync_soon(page)
        self.of_day(day)

    def _sync_soon(self, page: Page) -> None:
        """Have a page synced beside the call; at most once a second, as cards wear out."""
        now_s = time.monotonic()
        busy = self._syncing is not None and not self._syncing.done()
        if not busy and now_s - self._synced_s >= SYNC_EVERY_S:
            self._synced_s = now_s
            self._syncing = self._syncer.submit(_sync, page.file)

    def set_aside(self, after: date) -> None:
        """Let days that have not come yet count no more. Raises OSError."""
        for day in [day for day in self._pages if day > after]:
            page = self._pages.pop(day)
            self._leave(page)
            if page.path.exists():
                page.path.rename(page.path.with_suffix(".not-yet"))

    def close(self) -> None:
        """End the thread and give the files back."""
        self._syncer.shutdown()
        for page in self._pages.values():
            page.close()

    def _page(self, day: date) -> Page:
        """Return a day's page; of all the others no file stays open."""
        page = self._pages.get(day)
        if page is None:
            page = self._pages[day] = Page(self._path(day))
        if self._current is not None and self._current is not page:
            self._leave(self._current)
        self._current = page
        return page

    def _leave(self, page: Page) -> None:
        if self._syncing is not None:
            self._syncing.result()
        page.close()

    def _found(self) -> set[date]:
        if not self._folder.exists():
            return set()
        names = (_NAME.fullmatch(path.name) for path in self._folder.iterdir())
        return {day for name in names if name and (day := _date(name[1])) is not None}

    def _path(self, day: date) -> Path:
        return self._folder / f"{day.isoformat()}.jsonl"

    def _unreadable(self, error: OSError) -> Misconfigured:
        return Misconfigured("budget_unreadable", f"{self._folder}: {error.strerror}")


def _sync(file: int) -> None:
    try:
        os.fdatasync(file)
    except OSError as error:
        log.warning("what was spent is not safe from a power cut: %s", error.strerror)


def _throw_away(page: Path) -> None:
    """Remove a page; where the disk refuses that at present, a later start does it."""
    with suppress(OSError):
        page.unlink(missing_ok=True)


def _date(text: str) -> date | None:
    try:
        return date.fromisoformat(text)
    except ValueError:
        return None
