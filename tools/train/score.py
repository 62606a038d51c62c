"""Judge detections: mean average precision at an overlap of one half, and what is seen in nothing.

Pure arithmetic. What is too small or too hidden to be asked for (``asked`` false) is neither wanted
nor held against who finds it, as COCO treats crowds.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

Box = tuple[float, float, float, float]
"""Left, top, right, bottom [px]."""
ENOUGH = 0.5


@dataclass(frozen=True, slots=True)
class TrueThing:
    """Hold one thing that is in a picture."""

    label: str
    box: Box
    asked: bool = True


@dataclass(frozen=True, slots=True)
class ScoredThing:
    """Hold one thing that a detector says is in a picture."""

    label: str
    score: float
    box: Box


Picture = tuple[Sequence[TrueThing], Sequence[ScoredThing]]
Least = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class ClassScore:
    """Say how well one class is found."""

    label: str
    asked: int
    average_precision: float
    recall: float
    """At the shipped least score."""
    precision: float
    """At the shipped least score; 1 where nothing was said."""


def overlap(a: Box, b: Box) -> float:
    """Return intersection over union; 0 where a box has no area."""
    wide = min(a[2], b[2]) - max(a[0], b[0])
    high = min(a[3], b[3]) - max(a[1], b[1])
    if not (wide > 0 and high > 0):
        return 0.0
    shared = wide * high
    return shared / (_area(a) + _area(b) - shared)


def _area(box: Box) -> float:
    return (box[2] - box[0]) * (box[3] - box[1])


def scores(pictures: Sequence[Picture], least: Least) -> dict[str, ClassScore]:
    """Return the score of every class that is asked for at least once.

    Args:
        pictures: what is in each, beside what was found.
        least: the score from which each class is believed.
    """
    asked: dict[str, int] = defaultdict(int)
    told: dict[str, list[tuple[float, bool]]] = defaultdict(list)
    for true, found in pictures:
        for thing in true:
            asked[thing.label] += thing.asked
        for label, score, right in verdicts(true, found):
            told[label].append((score, right))
    return {
        label: _class_score(label, count, told[label], least[label])
        for label, count in sorted(asked.items())
        if count
    }


def verdicts(
    true: Sequence[TrueThing], found: Iterable[ScoredThing]
) -> Iterable[tuple[str, float, bool]]:
    """Yield class, score and verdict of each detection; none for what is not judged.

    The surest first, each takes the free thing of its class that it overlaps most, by one half.
    """
    free = list(true)
    for it in sorted(found, key=lambda it: -it.score):
        mine = [thing for thing in free if thing.label == it.label]
        near = [thing for thing in mine if overlap(thing.box, it.box) >= ENOUGH]
        best = max(near, key=lambda t: (t.asked, overlap(t.box, it.box)), default=None)
        if best is not None and best.asked:
            free.remove(best)
        elif best is not None or any(_lies_in(it.box, t.box) for t in mine if not t.asked):
            continue
        yield it.label, it.score, best is not None


def _lies_in(box: Box, area: Box) -> bool:
    wide = min(box[2], area[2]) - max(box[0], area[0])
    high = min(box[3], area[3]) - max(box[1], area[1])
    return wide > 0 and high > 0 and wide * high >= ENOUGH * _area(box)


def _class_score(
    label: str, asked: int, told: Sequence[tuple[float, bool]], min_score: float
) -> ClassScore:
    sure = [right for score, right in told if score >= min_score]
    return ClassScore(
        label,
        asked,
        average_precision(told, asked),
        sum(sure) / asked,
        sum(sure) / len(sure) if sure else 1.0,
    )


def average_precision(told: Sequence[tuple[float, bool]], asked: int) -> float:
    """Return the area under precision over recall, precision made to fall only.

    Source: Everingham et al., the PASCAL VOC development kit of 2010: all points, no 11 steps.
    """
    right, precisions = 0, []
    for count, (_, good) in enumerate(sorted(told, key=lambda it: -it[0]), 1):
        if good:  # only here does recall grow
            right += 1
            precisions.append(right / count)
    area, best = 0.0, 0.0
    for precision in reversed(precisions):
        best = max(best, precision)
        area += best / asked
    return area


def mean_average_precision(classes: Mapping[str, ClassScore]) -> float:
    """Return the mean over the classes that were asked for; 0 without any."""
    if not classes:
        return 0.0
    return sum(it.average_precision for it in classes.values()) / len(classes)


def false_in_empty(pictures: Iterable[Picture], least: Least) -> tuple[int, int]:
    """Return how many pictures hold nothing of ours, and how much was seen in them."""
    empty = [found for true, found in pictures if not true]
    return len(empty), sum(it.score >= least[it.label] for found in empty for it in found)
