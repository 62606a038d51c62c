"""Put what was seen into sentences, in both languages. Pure; figures come from the sight."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from planner.language.catalogue import join, list_names, message, quantity, say
from planner.language.object_classes import HOME
from planner.language.object_names import (
    list_kinds,
    name_object,
    named_several,
    singles_out,
    told_color,
)
from planner.plan import Bilingual, Code, say_same
from planner.skills.spatial_relations import name_related

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from planner.perception.snapshot import Thing
    from planner.site.site_view import SiteView
    from planner.skills.perception import WantedObject

_SHOWN = 12
NOWHERE = say("result.nowhere")
HERE = say("result.here")


def name_count(count: int, label: str, color: str | None = None) -> Bilingual:
    """Return so many of a thing: ``a red cup``, ``两把椅子``."""
    name = name_object(label, color) if count == 1 else named_several(label, color)
    return quantity(count, f"noun.{label}", name)


def name_one(label: str, color: str | None = None) -> Bilingual:
    """Return a thing's name as of one that was not spoken of before."""
    return name_count(1, label, color)


def unknown_name(name: str, classes: tuple[str, ...]) -> Bilingual:
    """Tell that these eyes don't know such a thing, and those they know: else most detectors'."""
    known = list_kinds(classes or [kind.id for kind in HOME])
    return message(Code.OBJECT_UNKNOWN, name=say_same(name), known=known)


def unknown_words(words: str, classes: tuple[str, ...], kind: str = "") -> Bilingual:
    """Tell that these eyes don't know a thing, or which one is meant, and the known ones.

    What they can tell besides depends on the kind of step: somebody who walks has no neighbour.
    """
    if not singles_out(words, classes):
        return unknown_name(words, classes)
    if kind == "follow":
        return say("result.which_person", words=words)
    return say("result.which_thing", words=words)


def room_name(facts: SiteView, room: str | None) -> Bilingual | None:
    """Return a room's name, where it is one."""
    target = facts.targets.get(room or "")
    return target.name if target is not None else None


def by_neighbour(what: Bilingual, wanted: WantedObject | None) -> Bilingual:
    """Return a thing's name with the neighbour that it was told by, where there is one."""
    if wanted is None or wanted.by is None or wanted.relation is None:
        return what
    return name_related(what, wanted.relation, name_object(wanted.by.label, wanted.by.color))


def found_at(facts: SiteView, label: str, color: str | None, room: str | None, away: float | None,
             wanted: WantedObject | None = None) -> Bilingual:  # fmt: skip
    """Say where a thing is: its room and how far it is from the robot."""
    what, where = by_neighbour(name_one(label, color), wanted), room_name(facts, room)
    figures: dict[str, Bilingual | str | float | None] = {"what": what, "room": where, "away": away}
    if away is None:
        return say("result.found_in" if where else "result.found", **figures)
    return say("result.found_in_away" if where else "result.found_away", **figures)


def looked_in(facts: SiteView, rooms: Iterable[str], shut: Iterable[str], spent: str | None,
              alike: Sequence[Thing] = (), unseen: Iterable[str] = ()) -> Bilingual:  # fmt: skip
    """Tell the rooms looked through, those out of reach, the budget that ran out, and the rest.

    Of things that are ``alike``, it is said that light may have changed their colour.
    """
    told = [
        say(f"result.{how}", rooms=list_rooms(facts, which))
        for how, which in (
            ("looked_in", tuple(rooms)),
            ("no_way_to", tuple(shut)),
            ("not_looked_in", tuple(unseen)),
        )
        if which
    ]
    if spent is not None:
        told.append(say("result.spent" if unseen or not rooms else "result.corners"))
    if alike:
        told.append(say("result.alike", others=list_things(alike)))
    return join(told) if told else NOWHERE


def list_rooms(facts: SiteView, rooms: Iterable[str]) -> Bilingual:
    """Name rooms in a row."""
    return list_names([room_name(facts, r) or say_same(r) for r in rooms], "joint.and")


def list_things(things: Iterable[Thing]) -> Bilingual:
    """List things by kind and colour with their numbers: ``two chairs and a red cup``."""
    kinds = Counter((t.label, told_color(t.label, t.color)) for t in things)
    said = [
        name_count(n, *kind) for kind, n in sorted(kinds.items(), key=lambda k: (-k[1], str(k)))
    ]
    return list_names(said[:_SHOWN], "joint.and")
