"""Ask about the picture: a vision model in words, or the eyes what a pixel shows. One task each.

Law: a goal's pixel counts in the picture that was the newest when its plan was asked for, or when
the model was asked, and in no other: once that is gone, the point is. What a model says is words
for people and never a step. A look in several directions is asked about with a picture of each,
kept here as it went on; where one is missing, after a restart, with the newest alone, and the
answer says so. Whatever fails comes back as a code inside the answer.

What would hold up the mission loop is prepared: how words are read, and the spots of rooms. A
detector says what it knows when it is ready, long after the start. To read words in class names of
its own takes patterns that cost tens of milliseconds, more than the event loop may be held up for
(docs/adr/0026): a thread makes them, and until they are there its classes count as not known.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Coroutine
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from planner.brain.errors import BadPlan, BrainDown
from planner.brain.image_questions import MAX_VIEWS, DirectionView, ImagePoint, ImageQuestion
from planner.brain.image_questions import PosedPicture as Shown
from planner.language.changes.reader import read_changes
from planner.language.object_names import prepare
from planner.language.sentence import parse
from planner.memory import MEDIA_TYPES, KeptPicture
from planner.mission.events import Told
from planner.mission.reducer import looks, looks_widely
from planner.perception.interfaces import PointRefusal
from planner.skills.perception import ImageAnswer, PictureCost
from planner.skills.viewpoints import near_spot, spots_in

if TYPE_CHECKING:
    from planner.brain.image_questions import Looker
    from planner.mission.effects import AskEyes, KeepPicture, SavePicture
    from planner.mission.state import MissionState
    from planner.perception.interfaces import Eyes, Picture
    from planner.perception.snapshot import Detection
    from planner.site.site_view import SiteView


log = logging.getLogger(__name__)

KEPT = 64
"""Pictures kept for goals: more than can be open."""
LOOKS = 2
"""Goals whose looks keep pictures: more than one only where one was interrupted by another."""
AS_NEW_S = 1.0
"""A picture with what was found in it is shown rather than one newer by so little without."""


Spent = Callable[[str], PictureCost]
"""Returns what the calls of a goal have cost by now."""


def nothing_spent(_: str) -> PictureCost:
    """Return the cost of calls that nobody meters."""
    return PictureCost()


KeepInAlbum = Callable[[KeptPicture, bytes], Coroutine[Any, Any, None]]
"""Keep one picture where people find it."""


class EyeDoor:
    """Stand between the missions and perception."""

    def __init__(self, eyes: Eyes | None, looker: Looker | None = None) -> None:
        """Ask these eyes, and this model about their pictures."""
        self.see(eyes, looker)
        self.spent: Spent = nothing_spent
        self._album: KeepInAlbum | None = None
        self._pictures: dict[str, Picture | asyncio.Task[Picture | None]] = {}
        """By goal; a task where the picture is still to come."""
        self._views: dict[str, dict[int, tuple[Shown, tuple[Detection, ...]]]] = {}
        """By goal, and by the number of the direction."""

    def see(self, eyes: Eyes | None, looker: Looker | None) -> None:
        """Ask these eyes from now on, and this model about their pictures."""
        self._eyes, self._looker = eyes, looker

    def note(self, goal_id: str) -> None:
        """Keep the newest picture: a plan for this goal is asked for now.

        Where nobody wanted pictures so far, the next one counts.
        """
        if self._eyes is None:
            return
        self._pictures.pop(goal_id, None)
        newest = self._eyes.picture
        self._pictures[goal_id] = newest or asyncio.ensure_future(self._eyes.fresh())
        if len(self._pictures) > KEPT:
            oldest = self._pictures.pop(next(iter(self._pictures)))
            if isinstance(oldest, asyncio.Task):
                oldest.cancel()

    def keep(self, keep: KeepPicture) -> None:
        """Keep the picture of one direction, if it is the one that is meant and still there."""
        before = self._views.pop(keep.id, {})
        views = self._views[keep.id] = before if keep.number > 0 else {}
        if len(self._views) > LOOKS:
            del self._views[next(iter(self._views))]
        picture = self._eyes.looked_picture if self._eyes is not None else None
        same = picture is not None and picture.color.header.seq == keep.seq
        if self._eyes is not None and picture is not None and same and len(views) < MAX_VIEWS:
            views[keep.number] = (
                _pose_picture(self._eyes, picture),
                _detections(self._eyes, picture),
            )

    def keep_in(self, album: KeepInAlbum) -> None:
        """Keep patrols' pictures there from now on."""
        self._album = album

    def save(self, ask: SavePicture) -> Coroutine[Any, Any, None] | None:
        """Return the work that keeps a patrol's picture, if it is the one meant and still there."""
        picture = self._eyes.looked_picture if self._eyes is not None else None
        if self._eyes is None or self._album is None or picture is None:
            return None
        data, header = picture.color.data, picture.color.header
        media_type = MEDIA_TYPES.get(bytes(data[:2]))
        if header.seq != ask.seq or media_type is None:
            return None
        # Through a door another room is seen: what it holds makes this picture no better.
        seen = _detections(self._eyes, picture) if ask.is_inward else ()
        labels = tuple(sorted(each.label for each in seen))
        kept = KeptPicture(ask.id, ask.step, ask.stop, ask.place, labels, media_type)
        return self._album(kept, bytes(data))

    async def ask(self, ask: AskEyes) -> Told:
        """Return the answer to one question."""
        return Told(ask.id, ask.ticket, await self._answer(ask))

    async def _answer(self, ask: AskEyes) -> ImageAnswer:
        eyes = self._eyes
        picture = _newest(eyes, await eyes.fresh()) if eyes is not None else None
        if eyes is None or picture is None:
            return ImageAnswer(failure="camera_silent")
        asked = ask.asked
        if asked.x is not None and asked.y is not None:
            noted = self._pictures.get(ask.id)
            meant = await asyncio.shield(noted) if isinstance(noted, asyncio.Task) else noted
            if meant is None:  # planned by a planner that is gone, or before any picture came
                return ImageAnswer(failure="point_no_pose")
            return await _point(eyes, meant, asked.x, asked.y)
        if self._looker is None:
            return ImageAnswer(failure="no_vision_model")
        before = self.spent(ask.id)
        try:
            answer = await self._model(self._looker, eyes, picture, ask)
        except (BrainDown, BadPlan) as failure:
            code = failure.why if isinstance(failure, BrainDown) else failure.code
            log.warning("goal %s: nobody looked at the picture: %s", ask.id, failure)
            answer = ImageAnswer(failure=code)
        return replace(answer, cost=_cost_between(before, self.spent(ask.id)))

    async def _model(
        self, looker: Looker, eyes: Eyes, picture: Picture, ask: AskEyes
    ) -> ImageAnswer:
        seen, act, shown = _detections(eyes, picture), ask.asked, _pose_picture(eyes, picture)
        asked = ImageQuestion(shown, act.words, ask.language, seen, ask.id)
        if act.seek:
            sighting = await looker.seek(asked)
            counts = (sighting.left, sighting.middle, sighting.right)
            return ImageAnswer(counts=counts, sure=sighting.sure)
        if act.point:
            found = await looker.point(asked)
            if not isinstance(found, ImagePoint):
                return ImageAnswer(failure="not_in_picture")
            return await _point(eyes, picture, found.x, found.y)
        views = self._looked_at(ask)
        said = await looker.describe(replace(asked, direction=act.now, views=views))
        if said.brain.fallback_from is not None:  # the detector spoke: the skill does that itself
            return ImageAnswer(failure=said.brain.fallback_reason)
        return ImageAnswer(text=said.text, seen=said.seen, shown=max(1, len(views)))

    def _looked_at(self, ask: AskEyes) -> tuple[DirectionView, ...]:
        """Return the pictures of a look's directions where there are several and all are here."""
        kept, names = self._views.pop(ask.id, {}), ask.asked.views
        if len(names) < 2 or kept.keys() != set(range(len(names))):
            return ()
        return tuple(DirectionView(kept[n][0], name, kept[n][1]) for n, name in enumerate(names))


def _cost_between(before: PictureCost, after: PictureCost) -> PictureCost | None:
    """Return what a question has cost; None where nobody meters, or nothing was spent."""
    tokens, money = after.tokens - before.tokens, after.money - before.money
    return PictureCost(max(0, tokens), max(0.0, money)) if tokens > 0 or money > 0.0 else None


def _newest(eyes: Eyes, picture: Picture | None) -> Picture | None:
    """Return the newest picture; one that was thought upon where that is about as new.

    What was found in it, and from where it was taken, then belong to what is shown.
    """
    looked = eyes.looked_picture
    if picture is None or looked is None or picture.taken_s - looked.taken_s > AS_NEW_S:
        return picture
    return looked


async def _point(eyes: Eyes, picture: Picture, x: float, y: float) -> ImageAnswer:
    """Return the point of the world that a pixel shows."""
    try:
        spot = await eyes.spot(picture, x, y)
    except PointRefusal as refused:
        return ImageAnswer(failure=refused.code)
    return ImageAnswer(at=(spot.x_m, spot.y_m, spot.z_m))


def _pose_picture(eyes: Eyes, picture: Picture) -> Shown:
    header, look = picture.color.header, eyes.sight.look
    pose = look.base_in_map if look is not None and look.seq == header.seq else None
    return Shown(picture.color.data, header.width, header.height, header.seq, pose)


def _detections(eyes: Eyes, picture: Picture) -> tuple[Detection, ...]:
    """Return the detections of this very picture, where it was thought upon."""
    look = eyes.sight.look
    same = look is not None and look.seq == picture.color.header.seq
    return look.detections if look is not None and same else ()


class Wording:
    """Make the newest classes readable, beside the loop."""

    def __init__(
        self,
        ready: tuple[str, ...],
        spawn: Callable[[Coroutine[Any, Any, None]], None],
        told: Callable[[], None],
    ) -> None:
        """Begin with classes that are readable already.

        Args:
            ready: those.
            spawn: runs something beside, and keeps hold of it.
            told: called when others have become readable.
        """
        self._ready = self._newest = ready
        self._spawn, self._told = spawn, told

    def of(self, classes: tuple[str, ...]) -> tuple[str, ...]:
        """Return these classes, or none while they are not readable yet."""
        if classes == self._ready:
            return classes
        if classes != self._newest:
            self._newest = classes
            self._spawn(self._prepare(classes))
        return ()

    async def _prepare(self, classes: tuple[str, ...]) -> None:
        await asyncio.to_thread(prepare, classes)
        self._ready = classes
        self._told()


class EyeNeeds:
    """Have the eyes look at their full rate while a step needs them, and widely where it does."""

    def __init__(self) -> None:
        """Begin with nobody who needs them."""
        self._told = (False, False)

    def tell(self, book: MissionState, eyes: Eyes | None) -> None:
        """Tell the eyes what is needed of them now, where that has changed."""
        if eyes is None:
            return
        needs = looks(book), looks_widely(book, eyes.open_classes)
        if needs != self._told:
            self._told = needs
            eyes.attend("mission", needs[0], wide=needs[1])


def warm_up(facts: SiteView, classes: tuple[str, ...] = ()) -> None:
    """Work out the spots of every room, and how to read words: in these classes, and in all.

    From where rooms are looked through follows from their outlines alone and is kept once known.
    Over a home of seven rooms it took 52 ms of a processor in one reduction, more than the event
    loop may take (docs/adr/0026); the patterns by which words are read as things took 54 ms.
    The rows of changes and the site's names took 98 ms with the first short sentence, at the door.
    Takes long: call it off the event loop.
    """
    read_changes(parse("go there").text, facts.names)
    prepare(())
    prepare(classes)
    for target in facts.targets.values():
        if target.room:
            spots_in(target)
            near_spot(target)
