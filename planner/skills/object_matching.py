"""Match a sight with a skill's object: the things that fit, and which are sure. Pure."""

from __future__ import annotations

from functools import lru_cache
from math import atan2, hypot
from typing import TYPE_CHECKING, Any

from planner.language.folding import fold
from planner.language.object_classes import kind_of
from planner.language.object_names import first_named, resolve, singles_out
from planner.language.person_names import is_given_name
from planner.language.questions import split_relation
from planner.plan import Found, Language
from planner.skills.perception import WantedObject
from planner.skills.spatial_relations import stands
from wire import Pose2, wrap

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.perception.snapshot import Sight, Thing
    from planner.skills.actions import Scene

SURE = 0.6
"""Confidence from which a thing is told of."""
SIGHTINGS = 2
"""One picture may err; two that agree seldom do."""
APART_S = 0.5
"""Between the first picture and the newest, where the robot is to set off: what one jolt, one flash
or one exposure shows is over by then, and who drives stands elsewhere."""
WORTH = 0.3
"""Confidence from which a remembered thing is worth a second look."""
SOMEBODY = frozenset(
    {"me", "us", "you", "him", "her", "them", "he", "she", "they", "我", "我们", "你", "您"}
    | {"他", "她", "他们", "她们"}
)
"""People by pronoun: who is meant, no eye can tell."""


def wanted_of(scene: Scene[Any]) -> WantedObject | None:
    """Return the object that the step's words mean to these eyes, or None."""
    return read_object(scene.step.object or "", scene.language, scene.eyes.classes)


def read_object(words: str, language: Language, classes: tuple[str, ...]) -> WantedObject | None:
    """Return the object that words mean to eyes of these classes (none: not known yet), or None."""
    somebody = fold(words.strip()) in SOMEBODY
    related = _read_related(words, language, classes)
    found = resolve("person" if somebody else words, language, classes) if not related else None
    return related or (WantedObject(*found) if found is not None else None)


def anybody_for(words: str, classes: tuple[str, ...]) -> WantedObject | None:
    """Return a person for the name of one: nobody is recognised, and anybody may be spoken to.

    For a search alone: who is followed or driven up to must be the one who is meant.
    """
    return WantedObject("person") if "person" in classes and is_given_name(words) else None


@lru_cache(maxsize=64)
def names_any(
    words: str, language: Language, classes: tuple[str, ...], some: tuple[str, ...]
) -> bool:
    """Tell whether words mean one of some classes, or a thing by such a neighbour."""
    wanted = read_object(words, language, classes)
    if wanted is None:
        return False
    return wanted.label in some or (wanted.by is not None and wanted.by.label in some)


def _read_related(words: str, language: Language, classes: tuple[str, ...]) -> WantedObject | None:
    """Return the object meant by a neighbour that these eyes know, too; None without one."""
    parts = split_relation(words)
    if parts is None or any(singles_out(parts[at], classes) for at in (0, 2)):
        return None
    what, by = (resolve(parts[at], language, classes) for at in (0, 2))
    return (
        WantedObject(*what, parts[1], WantedObject(*by))
        if what is not None and by is not None
        else None
    )


def picks_out(words: str, kind: str, language: Language, classes: tuple[str, ...]) -> bool:
    """Return whether words mean one among several by a mark that this kind of step can't judge.

    Where a thing stands by another can be judged of things, not of somebody who walks.
    """
    related = kind != "follow" and _read_related(words, language, classes) is not None
    return singles_out(words, classes) and not related


def one_of(scene: Scene[Any]) -> WantedObject | None:
    """Return the object that words mean where the robot goes up to it; None: any won't do."""
    step, classes = scene.step, scene.eyes.classes
    picked = picks_out(step.object or "", step.kind, scene.language, classes)
    return None if picked else wanted_of(scene)


def find_mentioned(text: str, classes: tuple[str, ...]) -> WantedObject | None:
    """Return the first thing that a whole sentence names, the longest name that fits."""
    found = first_named(text, classes)
    return WantedObject(*found) if found is not None else None


def fits(thing: Thing, wanted: WantedObject | None) -> bool:
    """Tell whether a thing is of the kind and colour that is wanted; None wants all."""
    if wanted is None:
        return True
    return thing.label == wanted.label and wanted.color in (None, thing.color)


def is_placed(thing: Thing, wanted: WantedObject | None, things: Iterable[Thing]) -> bool:
    """Tell whether a thing stands by such a neighbour as is wanted; True where none is."""
    if wanted is None or wanted.by is None or wanted.relation is None:
        return True
    by, relation = wanted.by, wanted.relation
    return any(sure(t) and fits(t, by) and stands(thing, relation, t) for t in things)


def may_fit(thing: Thing, wanted: WantedObject) -> bool:
    """Tell whether a second look may show that a thing fits: its colour is not known yet."""
    return thing.label == wanted.label and (wanted.color is None or thing.color is None)


def sure(thing: Thing) -> bool:
    """Tell whether a thing is there beyond doubt."""
    return thing.confidence >= SURE and twice(thing)


def twice(thing: Thing) -> bool:
    """Tell whether two pictures at least showed a thing: one alone proves nothing."""
    return thing.sightings >= SIGHTINGS


def lasting(thing: Thing) -> bool:
    """Tell whether pictures some time apart showed a thing: those of one moment err alike."""
    return twice(thing) and thing.seen_s - thing.first_s >= APART_S


def fresh(sight: Sight, wanted: WantedObject | None, since_s: float) -> tuple[Thing, ...]:
    """Return the things that fit and were seen since then, sure or not."""
    seen = (t for t in sight.things if t.seen_s >= since_s and fits(t, wanted))
    return tuple(t for t in seen if is_placed(t, wanted, sight.things))


def list_confirmed(sight: Sight, wanted: WantedObject | None, since_s: float) -> tuple[Thing, ...]:
    """Return the things that fit, are sure, and were seen since then."""
    return tuple(t for t in fresh(sight, wanted, since_s) if sure(t))


def seen_now(scene: Scene[Any], wanted: WantedObject | None) -> tuple[Thing, ...]:
    """Return the things that fit and were shown by the gaze that has just ended, sure or not."""
    return fresh(scene.sight, wanted, scene.gazed_s) if scene.gazed_s is not None else ()


def away_m(pose: Pose2, at: tuple[float, float]) -> float:
    """Return how far a point is from the robot [m]."""
    return hypot(at[0] - pose.x_m, at[1] - pose.y_m)


def apart_m(thing: Thing, at: tuple[float, float, float]) -> float:
    """Return how far a thing is from a point on the floor [m]."""
    return hypot(thing.x_m - at[0], thing.y_m - at[1])


def bearing(pose: Pose2, at: tuple[float, float]) -> float:
    """Return the heading in ``map`` at which the robot faces a point [rad]."""
    return atan2(at[1] - pose.y_m, at[0] - pose.x_m)


def turn_to(pose: Pose2, at: tuple[float, float]) -> float:
    """Return by how much the robot must turn to face a point [rad]."""
    return wrap(bearing(pose, at) - pose.yaw_rad)


def spot_of(thing: Thing) -> tuple[float, float, float]:
    """Return where a thing's middle is: x, y, height [m]."""
    return thing.x_m, thing.y_m, thing.z_m


def found(thing: Thing, pose: Pose2 | None, now_s: float) -> Found:
    """Return the record of a thing that was found."""
    return Found(
        label=thing.label,
        color=thing.color,
        x_m=round(thing.x_m, 3),
        y_m=round(thing.y_m, 3),
        sigma_m=round(thing.sigma_m, 3),
        room=thing.room,
        distance_m=round(away_m(pose, (thing.x_m, thing.y_m)), 2) if pose is not None else None,
        age_s=round(max(0.0, now_s - thing.seen_s), 1),
    )


def drop_doubles(things: Iterable[Thing]) -> tuple[Thing, ...]:
    """Return things that stand apart: of two of one kind on one spot the better known one."""
    kept: list[Thing] = []
    for thing in sorted(things, key=lambda t: -t.sightings):
        near_m = max(0.15, kind_of(thing.label).reach_m)
        if all(
            other.label != thing.label
            or other.color != thing.color
            or hypot(other.x_m - thing.x_m, other.y_m - thing.y_m) > near_m
            for other in kept
        ):
            kept.append(thing)
    return tuple(kept)
