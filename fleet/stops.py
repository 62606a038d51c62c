"""Stop robots of a fleet: noted first, sent to all at once, and repeated until each confirms.

A stop waits for no database: where none takes it, it goes out by the wires alone and is owed.
"""

from __future__ import annotations

import asyncio
import logging
import uuid
from typing import TYPE_CHECKING, Any

from sqlalchemy.exc import SQLAlchemyError

from fleet.addressee import is_stop, read_addressee, to_names
from fleet.link import RobotAway, RobotBusy, RobotRefusal
from fleet.watch import STOP_S

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

    from fleet.store import FleetStore
    from fleet.watch import RobotWatch

log = logging.getLogger(__name__)

NOTE_S = 1.0
"""A stop waits no longer for its row."""


class Stops:
    """Ring the robots' stops, and tell who has confirmed."""

    def __init__(
        self, store: FleetStore, watches: Mapping[str, RobotWatch], running: Collection[str],
        wake: Callable[[Iterable[str]], None],
    ) -> None:  # fmt: skip
        self._store, self._watches, self._running, self._wake = store, watches, running, wake

    def robots_of(self, text: str) -> tuple[str, ...] | None:
        """Return whom a sentence stops; None: it is no bare stop."""
        addressee, order = read_addressee(text, self._watches)
        if not is_stop(order):
            return None
        named = addressee is not None and addressee.way in ("named", "each")
        return addressee.names if addressee is not None and named else tuple(sorted(self._watches))

    async def stop(self, names: Sequence[str] | None) -> dict[str, Any]:
        """Stop these robots, or all, and tell who has confirmed. It is repeated to the others.

        Raises:
            FleetError: ``unknown_robot``.
        """
        known = tuple(sorted(self._watches))
        asked = known if names is None else to_names(names, known)
        stop_id, is_all = f"s-{uuid.uuid4().hex[:20]}", set(asked) == set(known)
        try:
            noting = asyncio.to_thread(self._store.stop, stop_id, asked, forever=is_all)
            ended = await asyncio.wait_for(noting, NOTE_S)
        except (SQLAlchemyError, TimeoutError):  # a stop waits for no disk
            self._store.owe_stop(stop_id, asked, forever=is_all)  # it bars what is offered next
            heard = await self._ring_all(asked)
            self._store.owe_stop(stop_id, asked, forever=is_all, heard=heard)
            return tell_stop(stop_id, heard, [name for name in asked if name not in heard])
        heard = await self._ring_all(asked)
        try:
            await asyncio.to_thread(self._store.confirm_stops, {name: [stop_id] for name in heard})
            told = await asyncio.to_thread(self._store.stop_state, stop_id)
        except SQLAlchemyError:  # its row is there, so that it is repeated and then confirmed
            told = heard, [name for name in asked if name not in heard]
        self._wake([*ended, *self._running])
        for name in asked:
            self._watches[name].nudge()  # repeated until confirmed; then it may get orders again
        return tell_stop(stop_id, *told)

    async def state(self, stop_id: str) -> dict[str, Any]:
        """Tell who has confirmed a stop by now."""
        return tell_stop(stop_id, *await asyncio.to_thread(self._store.stop_state, stop_id))

    async def _ring_all(self, names: Sequence[str]) -> list[str]:
        """Stop robots all at once, and return who has heard in time; one that is slow may yet."""
        acts = {name: asyncio.create_task(self._ring(name)) for name in names}
        if acts:
            await asyncio.wait(acts.values(), timeout=STOP_S)
        return [name for name, act in acts.items() if act.done() and act.result()]

    async def _ring(self, name: str) -> bool:
        try:
            await self._watches[name].ring_stop()
        except (RobotAway, RobotBusy, RobotRefusal) as trouble:
            log.warning("stop of %s: %s", name, trouble)
            return False
        return True


def tell_stop(stop_id: str, confirmed: list[str], missing: list[str]) -> dict[str, Any]:
    """Say who has confirmed a stop: "7 of 8 confirmed, r4 not reached"."""
    count, names = f"{len(confirmed)} of {len(confirmed) + len(missing)}", ", ".join(missing)
    english = f"{count} confirmed" + (f", {names} not reached" if missing else "")
    chinese = f"{len(confirmed) + len(missing)} 台中 {len(confirmed)} 台已确认" + (
        f"，未联系上 {names}" if missing else ""
    )
    return {"id": stop_id, "confirmed": confirmed, "not_reached": missing,
            "message": {"en": english, "zh": chinese}}  # fmt: skip
