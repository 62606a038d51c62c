"""Know the places of a site, its own and the taught ones; teach and forget. Trusts no brain.

Only a person's sentence, the page and the API lead here; nothing that a model writes does. What was
taught on another map is kept and listed, and never driven to.
"""

from __future__ import annotations

import asyncio
import hashlib
import re
from collections.abc import Callable, Coroutine
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from itertools import chain, count
from pathlib import Path
from typing import Any, TypeVar

from maps.room_proposals import RoomProposal, read_proposals
from planner.plan import Skill, Vocabulary
from planner.site.marks import SiteMarks
from planner.site.places import Names, Place, drawn_alike, owner_of, squash
from planner.site.polygon import area_m2
from planner.site.site import Site
from planner.site.site_view import SiteView, calling, facts_of, vocabulary_of
from planner.site.taught_place_check import (
    PlaceSurvey,
    check_not_order,
    check_spot,
    plain_name,
)
from planner.site.taught_place_errors import PlaceRefusal
from planner.site.taught_places import MAX_HERE, MAX_KEPT, TaughtPlace, TaughtPlaces
from wire import MarksFile
from wire.geometry import Pose2

T = TypeVar("T")
_NO_ID = re.compile(r"[^a-z0-9]+")


@dataclass(frozen=True, slots=True)
class KeptPlace:
    """Show a taught place, and why it can't be driven to, where it can't."""

    place: TaughtPlace
    why_not: str | None


@dataclass(frozen=True, slots=True)
class Lesson:
    """Ask for a place to be kept: its names, its pose, the person who asks."""

    en: str | None = None
    zh: str | None = None
    pose: Pose2 | None = None
    """In ``map``; None: where the robot stands."""
    by: str = "api"
    place_id: str | None = None
    room: str | None = None
    """The id of a proposed room, which is to be known by this name; it says the pose then."""


def _read_clock() -> datetime:
    return datetime.now(UTC)


class KnownPlaces:
    """Be what the planner knows of places. Reads the file once, when it is made."""

    def __init__(
        self,
        site: Site,
        store: TaughtPlaces | None = None,
        *,
        radius_m: float = 0.3,
        clock: Callable[[], datetime] = _read_clock,
        marks: Path | None = None,
    ) -> None:
        """Take up what was taught. Raises SiteError where the file is not ours."""
        self.drawn = SiteMarks(site, marks)
        self.site = self.drawn.site
        """With the fence less what people drew on the map."""
        self._store, self.radius_m = store, radius_m
        self.survey: PlaceSurvey | None = None
        self._clock = clock
        self._lock = asyncio.Lock()
        self._proposed = read_proposals(site.folder)
        self.version = 0
        """Rises with every change."""
        self._listeners: list[Callable[[], None]] = []
        self._skills: tuple[Skill, ...] = ()
        self._kept: tuple[TaughtPlace, ...] = store.load() if store is not None else ()
        self._judge()

    @property
    def taught_places(self) -> tuple[KeptPlace, ...]:
        """Return all that was taught, on whichever map, in the order of teaching."""
        return self._shown

    @property
    def places(self) -> tuple[Place, ...]:
        """Return every place that can be driven to."""
        return self._places

    @property
    def vocabulary(self) -> Vocabulary:
        """Return the names that a plan may use now."""
        return self._facts.names

    @property
    def facts(self) -> SiteView:
        """Return the places as the reducer knows them."""
        return self._facts

    @property
    def proposed_rooms(self) -> tuple[RoomProposal, ...]:
        """Return the rooms that were cut out of the map, named or not."""
        return self._proposed

    def room_at(self, x_m: float, y_m: float) -> Place | None:
        """Return the room around a point of ``map``, a taught one too; the smallest of several."""
        around = [p for p in self._places if p.kind == "room" and p.contains(x_m, y_m)]
        return min(around, key=lambda room: area_m2(room.polygon or ()), default=None)

    def use(self, survey: PlaceSurvey) -> None:
        """Take the source of the robot's pose, which also finds ways to a point."""
        self.survey = survey

    async def keep_marks(self, marks: MarksFile) -> None:
        """Keep what people drew on the map. Raises OSError; nothing changed then."""
        self.site = await self.drawn.keep(marks)
        self._judge()

    def keep_skills(self, skills: tuple[Skill, ...]) -> None:
        """Have sentences call these skills from now on, and no others."""
        self._skills = skills
        self._tell()

    def listen(self, told: Callable[[], None]) -> None:
        """Have something called after each change."""
        self._listeners.append(told)

    async def teach(self, lesson: Lesson) -> tuple[TaughtPlace, bool]:
        """Keep a place and return it, and whether it is new; a name taught before is moved here.

        Raises:
            PlaceRefusal: with the code of why not; nothing changed.
        """
        return await _whole(self._teach(lesson))

    async def forget(self, name: str, *, other_maps: bool = False) -> TaughtPlace:
        """Forget a taught place of this map, by its id or a name.

        Raises:
            PlaceRefusal: ``unknown_taught_place``, ``place_of_site``, ``disk_full`` or
                ``places_unwritable``; nothing changed.
        """
        return await _whole(self._forget(name, other_maps=other_maps))

    async def _teach(self, lesson: Lesson) -> tuple[TaughtPlace, bool]:
        async with self._lock:
            names = _names(lesson)
            before = self._find_taught(lesson, names)
            self._check_names(lesson, names, before)
            room = self._find_proposed(lesson)
            if room is not None:
                lesson = replace(lesson, pose=room.pose)
            pose = await self._spot(lesson)
            if before is None:
                self._check_room()
            place = TaughtPlace(
                id=before.id if before is not None else self._new_id(lesson, names),
                name=names,
                pose=pose,
                map_id=self.site.map_id,
                by=lesson.by,
                taught=self._clock(),
                polygon=None if room is None else room.polygon,
            )
            others = tuple(kept for kept in self._kept if kept is not before)
            await self._change((*others, place))
            return place, before is None

    def _find_proposed(self, lesson: Lesson) -> RoomProposal | None:
        """Return the proposed room that a lesson names, if it names one; one has one name."""
        if lesson.room is None:
            return None
        room = next((room for room in self._proposed if room.id == lesson.room), None)
        if room is None:
            known = ", ".join(room.id for room in self._proposed) or "none"
            raise PlaceRefusal("unknown_room", f"got {lesson.room[:40]!r}; proposed: {known}")
        return room

    async def _forget(self, name: str, *, other_maps: bool) -> TaughtPlace:
        async with self._lock:
            here = [kept for kept in self._kept if self._is_here(kept)]
            known = [*here, *(k for k in self._kept if other_maps and k not in here)]
            found = next((kept for kept in known if _answers(kept, name)), None)
            if found is None:
                raise self._unknown(name, here)
            await self._change(tuple(kept for kept in self._kept if kept is not found))
            return found

    def _unknown(self, name: str, here: list[TaughtPlace]) -> PlaceRefusal:
        got = f"got {name[:40]!r}"
        if owner_of(name, self.site.places) is not None:
            return PlaceRefusal("place_of_site", got)
        names = ", ".join(kept.name.en for kept in here) or "none"
        return PlaceRefusal("unknown_taught_place", f"{got}; taught on this map: {names}")

    def _is_here(self, place: TaughtPlace) -> bool:
        return place.map_id == self.site.map_id

    def _judge(self) -> None:
        """Work out anew the places that may be driven to, and those a plan may name."""
        good: list[Place] = []
        shown: list[KeptPlace] = []
        for kept in self._kept:
            why_not = self._why_not(kept, (*self.site.places, *good))
            shown.append(KeptPlace(kept, why_not))
            if why_not is None:
                good.append(kept.as_place())
        self._shown, self._places = tuple(shown), (*self.site.places, *good)
        self._facts = facts_of(self.site, tuple(good), self.radius_m)
        if self._skills:
            from planner.language.templates.skills import with_skills

            named = with_skills(self._facts.names, self._skills).skill_templates
            self._facts = replace(self._facts, skills=self._skills, skill_templates=named)
        from planner.language.readers import learn_names  # routes know these places, and no words

        learn_names(self._facts.names)

    def _why_not(self, kept: TaughtPlace, known: tuple[Place, ...]) -> str | None:
        """Say why a kept place can't be used: the site's files may have changed since."""
        if not self._is_here(kept):
            return "other_map"
        if any(owner_of(name, known) is not None for name in kept.as_place().spoken_names):
            return "place_name_taken"
        try:
            check_spot(self.site, kept.pose, 0.0)
        except PlaceRefusal as refused:
            return refused.code
        return None

    def _find_taught(self, lesson: Lesson, names: Names) -> TaughtPlace | None:
        """Return the taught place that this lesson is about, if it is one of before."""
        here = [kept for kept in self._kept if self._is_here(kept)]
        if lesson.place_id is not None:
            return next((kept for kept in here if kept.id == lesson.place_id), None)
        said = {squash(names.en), squash(names.zh)}
        return next((k for k in here if said & {squash(k.name.en), squash(k.name.zh)}), None)

    def _check_names(self, lesson: Lesson, names: Names, before: TaughtPlace | None) -> None:
        others = tuple(p for p in self._places if before is None or p.id != before.id)
        taught = tuple(p for p in others if p not in self.site.places)
        vocabulary = calling(vocabulary_of(self.site, taught), self._facts.names)
        asked = {names.en, names.zh}
        if lesson.place_id is not None:
            if self.site.place(lesson.place_id) is not None:
                raise PlaceRefusal("place_of_site", f"got {lesson.place_id!r}")
            asked.add(plain_name(lesson.place_id.replace("_", " ")))  # an id can be said as well
        for name in sorted(asked):
            owner = owner_of(name, others)
            if owner is not None:
                raise PlaceRefusal("place_name_taken", f"{name!r} names {owner.id!r}")
            alike = drawn_alike(name, others)
            if alike is not None:
                raise PlaceRefusal("place_name_taken", f"{name!r} looks like {alike.id!r}")
            check_not_order(name, vocabulary)

    def _check_room(self) -> None:
        here = sum(map(self._is_here, self._kept))
        if not (here < MAX_HERE and len(self._kept) < MAX_KEPT):
            detail = f"{here} on this map, at most {MAX_HERE}; {len(self._kept)} in all"
            raise PlaceRefusal("places_full", f"{detail}, at most {MAX_KEPT}; forget some first")

    async def _spot(self, lesson: Lesson) -> Pose2:
        """Return where the place is to be: known, on this map, free and within reach."""
        if self.survey is None:
            raise PlaceRefusal("pose_unknown")
        here = self.survey.robot_pose(self.site.map_id, must_stand=lesson.pose is None)
        if lesson.pose is None:
            check_spot(self.site, here, 0.0)
            return here
        check_spot(self.site, lesson.pose, self.radius_m)
        await self.survey.check_way(here, lesson.pose)
        return lesson.pose

    def _new_id(self, lesson: Lesson, names: Names) -> str:
        """Return the id: the one asked for, else of the name, and so the same another day."""
        if lesson.place_id is not None:
            return lesson.place_id
        slug = _NO_ID.sub("_", names.en.casefold()).strip("_")
        taken = {place.id for place in self.site.places}
        taken |= {kept.id for kept in self._kept if self._is_here(kept)}
        if slug[:1].isalpha() and names.en.isascii() and slug not in taken:
            return slug
        coded = f"taught_{hashlib.sha256(squash(names.zh).encode()).hexdigest()[:8]}"
        numbered = (f"{coded}_{number}" for number in count(2))
        return next(free for free in chain((coded,), numbered) if free not in taken)

    async def _change(self, places: tuple[TaughtPlace, ...]) -> None:
        if self._store is None:
            raise PlaceRefusal("places_unwritable", "this planner keeps no places")
        await asyncio.to_thread(self._store.save, places)
        self._kept = places
        self.version += 1
        self._tell()

    def _tell(self) -> None:
        self._judge()
        for told in self._listeners:
            told()


async def _whole(work: Coroutine[Any, Any, T]) -> T:
    """See a change through although whoever asked for it may leave: disk and memory stay one."""
    return await asyncio.shield(asyncio.ensure_future(work))


def _names(lesson: Lesson) -> Names:
    """Return both names; the one that was not given is the other's."""
    given = [plain_name(name) for name in (lesson.en, lesson.zh) if name is not None]
    if not given:
        raise PlaceRefusal("place_name_malformed", "no name was given")
    return Names(
        en=given[0] if lesson.en is not None else given[-1],
        zh=given[-1] if lesson.zh is not None else given[0],
    )


def _answers(kept: TaughtPlace, name: str) -> bool:
    return name == kept.id or squash(name) in {squash(kept.name.en), squash(kept.name.zh)}
