"""Put the eyes together: camera, detector, poses and memory, and the model asked about pictures."""

from __future__ import annotations

import logging
import time
from typing import TYPE_CHECKING

from planner.brain import FallbackBrain
from planner.brain.image_question_fallback import FallbackLooker
from planner.brain.image_questions import DetectedObject, NotSent
from planner.brain.prompt_tokens import PICTURE_TOKENS
from planner.budget.totals import cost
from planner.language.catalogue import list_names, say
from planner.language.object_names import name_object
from planner.perception import VisionFailure, VisionWorker
from planner.perception.failure import REFUSALS
from planner.perception.frame_source import WireCamera
from planner.perception.frame_update import Scenery
from planner.perception.perception_loop import PerceptionParts, Sightseer
from planner.perception.pose_buffer import Poses
from planner.plan import Bilingual
from planner.skills.perception import PictureCost, PictureLimits
from planner.skills.search_bounds import MOST_PICTURES

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from planner.brain import Brain
    from planner.brain.endpoint import EndpointBrain
    from planner.bridge_client import Link
    from planner.budget import Purse
    from planner.mission.perception_requests import Spent
    from planner.perception.object_store import ThingStore
    from planner.settings import Settings, VisionSettings
    from planner.site import Site
    from wire import RobotDescription
    from wire.session import Session

log = logging.getLogger(__name__)

SEEK_TOKENS = PICTURE_TOKENS + 600
"""Sent with one question of a search: the picture, the prompt and what the detector found."""
REPLY_TOKENS = 60
REFUSED_WITHIN_S = 20.0
"""Later the robot may be at work: it then goes on without eyes, and says why."""


class Opening:
    """Own the detector's process: open it beside everything else, and say if it is refused."""

    def __init__(
        self,
        settings: VisionSettings,
        robot: RobotDescription,
        *,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.worker, self._clock = VisionWorker(settings), clock
        self.refused: VisionFailure | None = None
        """Why the owner's detector can't be used, found at the start: a person must act."""
        self._owners = settings.model is not None
        self._wanted = robot.camera.kind != "none"

    async def open(self) -> None:
        """Start the process, if there is a camera; a process that dies later is started anew."""
        if not self._wanted:
            return
        began_s = self._clock()
        try:
            await self.worker.start()
        except VisionFailure as failure:
            early = self._clock() - began_s <= REFUSED_WITHIN_S
            if self._owners and early and failure.code in REFUSALS:
                self.refused = failure
            else:
                log.error("the robot goes on without eyes: %s", failure)


def eyes_of(
    worker: VisionWorker,
    settings: VisionSettings,
    link: Link,
    session: Session,
    robot: RobotDescription,
    site: Site,
    store: ThingStore,
) -> Sightseer:
    """Return the eyes, which the link tells from now on how the robot moves."""
    poses = Poses(site.map_id)
    link.tell(poses)
    return Sightseer(
        PerceptionParts(
            scenery=Scenery(site, robot.camera),
            camera=WireCamera(session),
            detector=worker,
            has_model=worker.has_model,
            poses=poses,
            store=store,
            rate_hz=settings.rate_hz,
        )
    )


def looker_of(
    model: EndpointBrain | None, brain: Brain, worker: VisionWorker
) -> FallbackLooker | None:
    """Return the asker of the owner's model about pictures; None without a model.

    Where no picture may be sent to it, each goal that would have sent one is told why.
    """
    if model is None:
        return None

    async def shrink(jpeg: bytes, long_side: int) -> bytes:
        try:
            return await worker.crop(jpeg, long_side)
        except VisionFailure as failure:
            raise NotSent(str(failure), why="bad_picture") from None

    async def lay_out(pictures: Sequence[tuple[bytes, str]], long_side: int) -> bytes:
        try:
            return await worker.sheet(pictures, long_side)
        except VisionFailure as failure:
            raise NotSent(str(failure), why="bad_picture") from None

    looker = model.looker(shrink, lay_out)
    if looker.refuses is not None:
        log.info("no picture goes to %s: %s", model.address.host, looker.refuses)
    breaker = brain.breaker if isinstance(brain, FallbackBrain) else None
    return FallbackLooker(looker, _by_detector, breaker)


def picture_limits(settings: Settings) -> PictureLimits:
    """Return the bound of one search by the vision model, and what a picture of it costs.

    No more pictures than the goal's calls allow beside the one that planned it; where the owner has
    set no number, the site's rooms bound them besides. Each is priced at a picture, its prompt and
    a short reply, rather too high.
    """
    goal, price, chosen = (
        settings.budget.goal,
        settings.budget.price,
        settings.vision.search_pictures,
    )
    most = min(MOST_PICTURES if chosen is None else chosen, max(0, goal.calls - 1))
    most = min(most, goal.prompt_tokens // SEEK_TOKENS)
    money = cost(price, SEEK_TOKENS, REPLY_TOKENS)
    each = PictureCost(SEEK_TOKENS + REPLY_TOKENS, money)
    currency = price.currency if price is not None else None
    return PictureLimits(most, each, currency, by_site=chosen is None)


def spent_by(purse: Purse) -> Spent:
    """Return how the purse is asked what a goal's calls have cost by now."""

    def ask_purse(goal: str) -> PictureCost:
        mine = purse.usage(goal).goal
        if mine is None:
            return PictureCost()
        return PictureCost(mine.prompt_tokens + mine.reply_tokens, mine.money)

    return ask_purse


def _by_detector(_: str, seen: Sequence[DetectedObject]) -> tuple[Bilingual, bool | None]:
    """Tell the detector's findings; they may or may not answer the question."""
    names = [name_object(one.label, one.color) for one in seen]
    known = list_names(names) if names else say("look.nothing_known")
    return say("look.i_see", names=known), None
