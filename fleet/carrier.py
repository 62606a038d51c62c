"""Be the one service of a database that carries its missions, or stand by until the other falls.

On Postgres several services run side by side. Each reads, accepts orders and sends stops; one holds
the advisory lock, and it alone watches robots, chooses and offers. When its session ends, the next
takes the lock, and the engine takes up the workflows of before. That two carry for a moment does
nothing twice: a mission's id is its key at the robot. An SQLite file has one service, its carrier.
"""

from __future__ import annotations

import asyncio
import logging
import os
import sys
from typing import TYPE_CHECKING, Protocol

import sqlalchemy as sa
from sqlalchemy.exc import SQLAlchemyError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fleet.store import FleetStore

log = logging.getLogger(__name__)

ADVISORY_LOCK = 0x504F4E53
LOOK_S = 1.0
"""So often a stand-by tries to take the lock, and the carrier looks whether it still has it."""
PAGE = 200
FROZEN_S = 10
"""A carrier's session that was silent for so long is ended: it froze, or its machine is gone."""


class CarrierLock:
    """Hold the right to carry the missions of one database."""

    def __init__(self, engine: sa.Engine) -> None:
        self._engine = engine
        self.is_shared = engine.dialect.name != "sqlite"
        """Others may have the same database."""
        self._session: sa.Connection | None = None
        self._is_held = False

    def take(self) -> bool:
        """Take it where it is free, or see that it is still held; False: another has it.

        Raises:
            SQLAlchemyError: the database does not answer.
        """
        if not self.is_shared:
            return True  # its folder's lock says so
        try:
            if self._session is None:
                self._session, self._is_held = self._open(), False
            if self._is_held:
                self._session.execute(sa.select(1))  # a session that lives has its lock
            else:
                asked = sa.select(sa.func.pg_try_advisory_lock(ADVISORY_LOCK))
                self._is_held = bool(self._session.execute(asked).scalar())
        except SQLAlchemyError:
            self.close()
            raise
        return self._is_held

    def _open(self) -> sa.Connection:
        session = self._engine.connect().execution_options(isolation_level="AUTOCOMMIT")
        session.execute(sa.text(f"SET idle_session_timeout = '{FROZEN_S}s'"))
        return session

    def close(self) -> None:
        """Give it back; a session that is broken has lost it already."""
        if self._session is not None:
            self._session.invalidate()
            self._session.close()
            self._session = None


class CarryingDesk(Protocol):
    """Be what carries: robots, choice, workflows."""

    store: FleetStore
    is_carrier: bool

    def carry(self, url: str) -> None: ...

    def wake(self, missions: Iterable[str]) -> None: ...


async def keep_lock(desk: CarryingDesk, url: str, lock: CarrierLock) -> None:
    """Carry as soon as the lock is free, for ever; begin anew once another has taken it."""
    cursor: int | None = None
    while True:
        try:
            is_mine = await asyncio.to_thread(lock.take)
            if desk.is_carrier and not is_mine:
                begin_anew()
            if is_mine and not desk.is_carrier:
                _begin_to_carry(desk, url)
            if is_mine and lock.is_shared:
                cursor = await _wake_changed(desk, cursor)
        except SQLAlchemyError as error:
            log.warning("store_unavailable: %s", error)
        await asyncio.sleep(LOOK_S)


def _begin_to_carry(desk: CarryingDesk, url: str) -> None:
    log.warning("this service carries the missions now")
    try:
        desk.carry(url)
    except SQLAlchemyError as error:  # a half begun engine can't be begun again
        log.warning("store_unavailable: %s", error)
        begin_anew()


async def _wake_changed(desk: CarryingDesk, cursor: int | None) -> int:
    """Wake the missions that another service wrote: an order, an answer, a cancel."""
    if cursor is None:
        cursor = await asyncio.to_thread(desk.store.newest_change)
    changed, newest = await asyncio.to_thread(desk.store.changed_since, cursor, PAGE)
    if changed:
        desk.wake([mission.id for mission in changed])
    return newest


def begin_anew() -> None:
    """Become this same command again, as a stand-by: the lock was lost while Postgres was away."""
    log.warning("another service carries the missions: this one begins anew and stands by")
    os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])
