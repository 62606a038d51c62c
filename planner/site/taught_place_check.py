"""Judge a name and a spot before a place is taught there. Knows the site; not who asks, no disk."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from math import ceil, hypot
from typing import Protocol

from maps.grid import FREE
from planner.language.folding import fold, fold_width, unmask
from planner.plan import Vocabulary
from planner.site.places import Place
from planner.site.site import Site
from planner.site.site_view import vocabulary_of
from planner.site.taught_place_errors import PlaceRefusal
from wire.geometry import Pose2

MAX_CHARACTERS = 40
_MARKS = frozenset(" -'’·")
_CLASSES = ("L", "N", "Mn", "Mc")
_BESIDE_ANY = frozenset(
    {"cjk", "hiragana", "katakana", "katakana-hiragana", "hangul", "bopomofo", "modifier"}
)
"""None of their letters is drawn as a Latin one, and names have both: A区."""


class PlaceSurvey(Protocol):
    """Tell where the robot is and whether it could drive to a point."""

    def robot_pose(self, map_id: str, *, must_stand: bool) -> Pose2:
        """Return the robot in ``map``.

        Raises:
            PlaceRefusal: ``pose_unknown``, ``map_mismatch`` or ``robot_moving``.
        """
        ...

    async def check_way(self, start: Pose2, goal: Pose2) -> float:
        """Return the length [m] of the way to a point of ``map`` that the robot can stand on.

        Raises:
            PlaceRefusal: ``place_unreachable``, ``place_in_obstacle``, ``place_outside_map`` or
                ``route_unavailable``.
        """
        ...


def plain_name(name: str) -> str:
    """Return a name as it is kept: one width, single spaces.

    Raises:
        PlaceRefusal: ``place_name_malformed``: empty, too long, or with what is no part of a name;
            ``place_name_mixed``: with letters of two alphabets, one of which is drawn as the other.
    """
    kept = " ".join(fold_width(name[: 4 * MAX_CHARACTERS]).split())
    short = 1 <= len(kept) <= MAX_CHARACTERS and len(name) <= 4 * MAX_CHARACTERS
    if any(unicodedata.category(char) == "Cc" for char in name):
        short = False
    if not (short and any(map(str.isalpha, kept)) and all(map(_in_a_name, kept))):
        raise PlaceRefusal("place_name_malformed", f"got {name[:MAX_CHARACTERS]!r}")
    alphabets = {_alphabet(char) for char in kept if char.isalpha()} - _BESIDE_ANY
    if len(alphabets) > 1:
        found = ", ".join(sorted(alphabets))
        raise PlaceRefusal("place_name_mixed", f"got {name[:MAX_CHARACTERS]!r}: {found}")
    return kept


def check_not_order(name: str, vocabulary: Vocabulary) -> None:
    """Refuse a name that alone would be an order or an answer: a place called stop.

    Raises:
        PlaceRefusal: ``place_name_reserved``.
    """
    if _answers(name) or _is_needed_elsewhere(name) or _is_order(name, vocabulary):
        raise PlaceRefusal("place_name_reserved", f"got {name!r}")


def reserved_names(site: Site) -> Iterator[tuple[Place, str]]:
    """Yield each name of a site's files that may not be taught, with its place.

    Aliases and what home is called are held to less: that they command and answer nothing.
    "Charging dock" reads as an order because it is where the robot goes home to.
    """
    from planner.language.reserved_names import name_is_command

    vocabulary = vocabulary_of(site)
    for place in site.places:
        entries = tuple(entry for entry in vocabulary.entries if entry.id != place.id)
        others = Vocabulary(entries=entries)
        main = () if place.id == site.home.id else (place.name.en, place.name.zh)
        for name in dict.fromkeys(place.spoken_names):
            alone = _answers(name) or name_is_command(name)
            if alone or (name in main and _is_order(name, others)):
                yield place, name


def _answers(name: str) -> bool:
    # Late, as below: only what teaches or checks a place reads its name as a sentence.
    from planner.language.yes_no import consents

    return any(consents(said) is not None for said in (name, unmask(fold(name))))


def _is_order(name: str, vocabulary: Vocabulary) -> bool:
    from planner.language.reserved_names import name_reads_as_order

    return name_reads_as_order(name, vocabulary)


def _is_needed_elsewhere(name: str) -> bool:
    from planner.language.reserved_names import name_is_needed_elsewhere

    return name_is_needed_elsewhere(name)


def _alphabet(char: str) -> str:
    """Return the alphabet of a letter, by the first word of its name in Unicode."""
    return unicodedata.name(char, "unknown").partition(" ")[0].lower()


def _in_a_name(char: str) -> bool:
    return char in _MARKS or unicodedata.category(char).startswith(_CLASSES)


def check_spot(site: Site, pose: Pose2, clearance_m: float) -> None:
    """Check that a robot may stand somewhere, with so much free floor around its centre [m].

    Raises:
        PlaceRefusal: ``place_outside_map``, ``place_in_obstacle`` or ``place_outside_fence``.
    """
    at = f"({pose.x_m:.2f}, {pose.y_m:.2f})"
    if not site.grid.contains(pose.x_m, pose.y_m):
        raise PlaceRefusal("place_outside_map", at)
    if not all(site.grid.at(x_m, y_m) == FREE for x_m, y_m in _disc(site, pose, clearance_m)):
        raise PlaceRefusal("place_in_obstacle", at)
    if not site.fence.allows(pose.x_m, pose.y_m):
        raise PlaceRefusal("place_outside_fence", at)


def _disc(site: Site, pose: Pose2, radius_m: float) -> Iterator[tuple[float, float]]:
    """Yield the centres of the cells around a point, and the point itself."""
    yield pose.x_m, pose.y_m
    size_m = site.grid.resolution_m
    reach = ceil(radius_m / size_m)
    for row in range(-reach, reach + 1):
        for column in range(-reach, reach + 1):
            if hypot(row, column) * size_m <= radius_m:
                yield pose.x_m + column * size_m, pose.y_m + row * size_m
