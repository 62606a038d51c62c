"""Give the API the robot it asks for: the link's newest word, ages, requests, steering by hand."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING, Any

from planner.bridge_client import BridgeSilent, Link
from wire import (
    Answer,
    FenceRequest,
    HintVerdict,
    LocalizerStatus,
    MarksRequest,
    Mode,
    OpKind,
    OpRequest,
    PoseHint,
    RobotDescription,
    Status,
    TrialOrder,
    TrialState,
    Velocity,
)
from wire.trial_dialogue import mark_of

if TYPE_CHECKING:
    from planner.bridge_client import Aged

log = logging.getLogger(__name__)

TRIAL_S = 1.0
"""Set-up speaks ten times a second."""
ORDERED_S, ORDERED_GAP_S = 2.0, 0.05
MOST_HANDS = 16
"""Whose names are known; the bridge itself remembers eight hands."""
LOCALIZER_S = 2.0
"""It speaks five times a second; what is older says nothing of now."""


class LinkedRobot:
    """Answer the routes from one link. Never blocks."""

    def __init__(
        self, link: Link, description: RobotDescription, max_speed_mps: float | None = None
    ) -> None:
        self._link = link
        self.description = description
        own_mps = description.limits.max_speed_mps
        self.max_speed_mps = own_mps if max_speed_mps is None else max_speed_mps
        """The owner's limit, where it is below robot.toml's: no hand is relayed faster."""
        self._steered: tuple[str, int] = ("", 0)
        self._names: dict[str, str] = {}

    @property
    def status(self) -> Status | None:
        """Return the newest status, however old; its age stands in ``ages_s``."""
        return self._link.status.value if self._link.status else None

    def obstacles(self) -> tuple[tuple[float, float], ...]:
        """Return the lidar's points now in ``map`` [m]."""
        return self._link.obstacles()

    @property
    def localizer(self) -> LocalizerStatus | None:
        """Return what the localizer says that it does; None where none spoke lately."""
        heard = self._link.localizer
        return heard.value if heard is not None and heard.age_s <= LOCALIZER_S else None

    @property
    def takes_hints(self) -> bool:
        """Tell whether a localizer ever spoke: one that is silent now may still be told a place."""
        return self._link.localizer is not None

    @property
    def localized_map(self) -> str | None:
        """Return the map_id that localization says it localizes on; None where none spoke lately.

        It is another than the site's where somebody changed the map's files under way.
        """
        heard = self._link.localization
        return heard.value.map_id if heard is not None and heard.age_s <= LOCALIZER_S else None

    @property
    def trial(self) -> TrialState | None:
        """Return how the trial of a robot in set-up stands; None where a bridge drives."""
        heard = self._link.trial
        return heard.value if heard is not None and heard.age_s <= TRIAL_S else None

    async def order_trial(self, order: TrialOrder) -> bool:
        """Bring set-up an order; a begin is said until it is taken up. Tell whether it was."""
        self._link.order_trial(order)
        if order.act != "begin":
            return True
        for _ in range(round(ORDERED_S / ORDERED_GAP_S)):
            await asyncio.sleep(ORDERED_GAP_S)
            trial = self.trial
            if trial is not None and trial.by == mark_of(order.id):
                return True
            self._link.order_trial(order)
        return False

    async def hint(self, hint: PoseHint) -> HintVerdict | None:
        """Return the localizer's verdict on a person's word, or None where it stayed silent."""
        return await self._link.hint(hint)

    def ages_s(self) -> dict[str, float | None]:
        """Return how long ago each source was last heard, on our own clock."""
        return {
            "status": _age(self._link.status),
            "localization": _age(self._link.localization),
            "odometry": _age(self._link.odometry),
            "scan": _age(self._link.scan),
        }

    async def ask(self, kind: OpKind, request: OpRequest) -> Answer | None:
        """Return the bridge's verdict, or None where it stayed silent."""
        try:
            return await self._link.operate(kind, request)
        except BridgeSilent as silence:
            log.warning("%s: %s", kind, silence)
            return None

    async def offer_fence(self, request: FenceRequest) -> Answer | None:
        """Return the bridge's verdict on an operator's fence, or None where it stayed silent."""
        try:
            return await self._link.offer_fence(request)
        except BridgeSilent as silence:
            log.warning("fence: %s", silence)
            return None

    async def offer_marks(self, request: MarksRequest) -> Answer | None:
        """Return the bridge's verdict on an operator's marks, or None where it stayed silent."""
        try:
            return await self._link.offer_marks(request)
        except BridgeSilent as silence:
            log.warning("marks: %s", silence)
            return None

    @property
    def driver(self) -> dict[str, str] | None:
        """Return whose hand steers now, as the bridge says, with the name that came with it."""
        status = self.status
        if status is None or status.mode is not Mode.TELEOP or status.held is None:
            return None
        source = status.held.id
        return {"id": source, "name": self._names.get(source, "")}

    def steer(
        self, source: str, v_mps: float, w_radps: float, *, dead_man: bool, name: str = ""
    ) -> None:
        """Relay a velocity by hand under the newest epoch; without a status nothing is said.

        Args:
            source: the hand, by which the bridge tells one from another.
            v_mps: forward.
            w_radps: to the left.
            dead_man: the stick is held.
            name: who holds it, for people.
        """
        status = self.status
        if status is None:
            return
        self._names.pop(source, None)
        self._names[source] = name
        while len(self._names) > MOST_HANDS:
            del self._names[next(iter(self._names))]
        epoch, seq = self._steered
        seq = seq + 1 if epoch == status.epoch else 0
        self._steered = (status.epoch, seq)
        self._link.teleop(
            Velocity(
                source_id=source,
                epoch=status.epoch,
                seq=seq,
                seen=status.seq,
                v_mps=max(-self.max_speed_mps, min(v_mps, self.max_speed_mps)),
                w_radps=w_radps,
                dead_man=dead_man,
            )
        )


def _age(aged: Aged[Any] | None) -> float | None:
    return None if aged is None else aged.age_s
