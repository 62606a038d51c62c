"""Track seen things, and forget those no longer in place. Pure: told looks and the time.

Laws: nothing is remembered from one weak look alone; one thing is told once, however many boxes lie
on it, and no two large things stand in each other; what should have been seen and was not loses
confidence until it is forgotten, and what was out of sight keeps it; what walks is never joined
over a long gap. The order in which one look names its things makes no difference. All times are the
planner's own.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from math import exp
from typing import TYPE_CHECKING

from planner.language.object_classes import kind_of
from planner.perception.data_association import (
    PlacedDetection,
    associate,
    bulky,
    fuse,
    one_place,
    single,
)
from planner.perception.snapshot import Thing
from wire.geometry import MAX_COORDINATE_M

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

MOST_THINGS = 500
MOST_PLACED = 64
"""Of one look: more than any detector finds in a room."""
STRONG = 0.6
"""A score that counts by itself, where the picture shows the whole thing."""
SIGHTINGS, LOOKS = 2, 3
"""What is weaker counts when seen so often within so many looks."""
UNSURE_S = 3.0
"""What was not confirmed and is not seen again for so long never was."""
MOST_COLORS = 4
GAIN = 0.6
"""One sighting takes so much of the doubt, times its score."""
MOST_SURE = 0.99
FADING_S = 2.0
"""Looked at and not seen for so long, a thing keeps 1/e of its confidence."""
LONGEST_LOOK_S = 0.5
"""One look stands for no more time than this."""
FORGOTTEN = 0.15
WALKED_AWAY_S = 60.0


@dataclass(frozen=True, slots=True)
class ThingTrack:
    """Hold one thing with its tracking record."""

    thing: Thing
    looks: int = 1
    """Since the first, those in which it was seen or should have been."""
    sure: bool = False
    votes: tuple[tuple[str, float], ...] = ()
    """Colours it was seen in, each with the sum of the scores."""


@dataclass(frozen=True)
class ObjectMemory:
    """Hold all that is remembered."""

    kept: tuple[ThingTrack, ...] = ()
    numbers: Mapping[str, int] | None = None
    """The last number given to a thing of each label."""
    looked_s: float | None = None
    """When the last look was."""

    @property
    def things(self) -> tuple[Thing, ...]:
        """Return the things that are sure enough to be told."""
        return tuple(kept.thing for kept in self.kept if kept.sure)


def remember(
    before: ObjectMemory,
    placed: Iterable[PlacedDetection],
    expected: Callable[[Thing], bool],
    now_s: float,
) -> tuple[ObjectMemory, dict[int, str]]:
    """Take one look; return the memory then, and the thing's id of each placed index.

    Args:
        before: what was remembered.
        placed: what the look found, as far as it could be put on the map.
        expected: whether a thing would be in this picture if it still stood there.
        now_s: when the picture was taken.
    """
    found = single([p for p in placed if _sound(p)])[:MOST_PLACED]
    pairs, extra = associate([kept.thing for kept in before.kept], found, now_s)
    by_id = {kept.thing.id: kept for kept in before.kept}
    look_s = 0.0 if before.looked_s is None else now_s - before.looked_s
    look_s = min(max(0.0, look_s), LONGEST_LOOK_S)
    after = {
        id_: _update(kept, pairs[id_], now_s) if id_ in pairs else _unseen(kept, expected, look_s)
        for id_, kept in by_id.items()
    }
    numbers = dict(before.numbers or {})
    named = {p.index: id_ for id_, p in pairs.items()}
    for p in found:
        if p.index not in named and p.index not in extra:
            numbers[p.label] = numbers.get(p.label, 0) + 1
            named[p.index] = id_ = f"{p.label}_{numbers[p.label]}"
            after[id_] = _first(id_, p, now_s)
    left = [kept for kept in after.values() if not _is_over(kept, now_s)]
    kept_now = _keep_surest(_drop_rivals(left, frozenset(named.values())))
    named |= extra
    told = {kept.thing.id for kept in kept_now if kept.sure}
    here = {index: id_ for index, id_ in named.items() if id_ in told}
    return ObjectMemory(kept_now, numbers, now_s), here


def aged(before: ObjectMemory, now_s: float) -> ObjectMemory:
    """Forget the objects that time alone takes: people who walked away, unconfirmed things."""
    left = tuple(kept for kept in before.kept if not _is_over(kept, now_s))
    return before if len(left) == len(before.kept) else replace(before, kept=left)


def forget(before: ObjectMemory, thing_id: str | None) -> ObjectMemory:
    """Forget one thing, or all of them; their numbers are not given again."""
    left = tuple(kept for kept in before.kept if thing_id not in (None, kept.thing.id))
    return replace(before, kept=left)


def recall(things: Iterable[Thing], now_s: float) -> ObjectMemory:
    """Begin with an earlier process's objects."""
    kept = tuple(
        ThingTrack(thing, LOOKS, sure=True, votes=((thing.color, 1.0),) if thing.color else ())
        for thing in things
    )
    numbers: Counter[str] = Counter()
    for one in kept:
        label, _, number = one.thing.id.rpartition("_")
        numbers[label] = max(numbers[label], int(number) if number.isdecimal() else 0)
    return aged(ObjectMemory(_keep_surest(kept), dict(numbers)), now_s)


def _sound(p: PlacedDetection) -> bool:
    spot = p.spot
    far = MAX_COORDINATE_M
    somewhere = all(-far <= v <= far for v in (spot.x_m, spot.y_m, spot.z_m))
    return somewhere and 0.0 < p.score <= 1.0 and 0.0 < spot.sigma_m <= far


def _first(id_: str, p: PlacedDetection, now_s: float) -> ThingTrack:
    thing = Thing(
        id=id_, label=p.label, color=p.color, x_m=p.spot.x_m, y_m=p.spot.y_m, z_m=p.spot.z_m,
        sigma_m=p.spot.sigma_m, confidence=GAIN * p.score, seen_s=now_s, first_s=now_s, sightings=1,
        room=p.room,
    )  # fmt: skip
    votes = ((p.color, p.score),) if p.color is not None else ()
    return ThingTrack(thing, sure=_is_enough(p), votes=votes)


def _update(kept: ThingTrack, p: PlacedDetection, now_s: float) -> ThingTrack:
    thing = kept.thing
    looks, sightings = kept.looks + 1, thing.sightings + 1
    x_m, y_m, z_m, sigma_m = fuse(thing, p.spot, now_s)
    votes = _vote(kept.votes, p)
    thing = replace(
        thing, x_m=x_m, y_m=y_m, z_m=z_m, sigma_m=sigma_m, seen_s=max(thing.seen_s, now_s),
        sightings=sightings, color=max(votes, key=lambda vote: vote[1])[0] if votes else None,
        confidence=min(MOST_SURE, 1.0 - (1.0 - thing.confidence) * (1.0 - GAIN * p.score)),
        room=p.room,
    )  # fmt: skip
    enough = sightings >= SIGHTINGS and looks <= LOOKS
    return ThingTrack(thing, looks, kept.sure or enough or _is_enough(p), votes)


def _is_enough(p: PlacedDetection) -> bool:
    """Return whether one sighting is enough: cut off at the edge, many things look alike."""
    return p.whole and p.score >= STRONG


def _unseen(kept: ThingTrack, expected: Callable[[Thing], bool], look_s: float) -> ThingTrack:
    if not expected(kept.thing):
        return kept
    confidence = kept.thing.confidence * exp(-look_s / FADING_S)
    return replace(kept, looks=kept.looks + 1, thing=replace(kept.thing, confidence=confidence))


def _vote(
    votes: tuple[tuple[str, float], ...], p: PlacedDetection
) -> tuple[tuple[str, float], ...]:
    if p.color is None:
        return votes
    count = dict(votes)
    count[p.color] = count.get(p.color, 0.0) + p.score
    return tuple(sorted(count.items(), key=lambda vote: (-vote[1], vote[0]))[:MOST_COLORS])


def _is_over(kept: ThingTrack, now_s: float) -> bool:
    """Say whether a thing is to be forgotten."""
    thing = kept.thing
    unseen_s = now_s - thing.seen_s
    if kind_of(thing.label).mobile and unseen_s > WALKED_AWAY_S:
        return True
    if kept.sure:
        return not thing.confidence >= FORGOTTEN
    return unseen_s > UNSURE_S or kept.looks >= LOOKS


def _drop_rivals(kept: list[ThingTrack], seen: frozenset[str]) -> list[ThingTrack]:
    """Leave out the less sure of two bulky things that would stand in each other.

    One of them was just seen: what was not has not moved.
    """
    sure = [k.thing for k in kept if k.sure and bulky(k.thing.label)]
    new = [thing for thing in sure if thing.id in seen]
    rivals = [(a, b) for a in new for b in sure if one_place(a, b)]
    lost = {min(pair, key=lambda thing: (thing.confidence, thing.id)).id for pair in rivals}
    return [k for k in kept if k.thing.id not in lost] if lost else kept


def _keep_surest(kept: Iterable[ThingTrack]) -> tuple[ThingTrack, ...]:
    """Keep the surest, in the order in which they came."""
    every = tuple(kept)
    if len(every) <= MOST_THINGS:
        return every
    best = sorted(
        every, key=lambda k: (k.sure, k.thing.confidence, k.thing.seen_s, k.thing.id), reverse=True
    )
    chosen = {k.thing.id for k in best[:MOST_THINGS]}
    return tuple(k for k in every if k.thing.id in chosen)
