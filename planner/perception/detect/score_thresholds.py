"""Say how high each class must score to be believed: by the owner, else by the model's own file.

A detector errs more in some classes than in others; who made it knows which. A file may say so in
its metadata: ``min_scores``, one number a class, 0 to 1. Anything else under that name is not ours.
"""

from __future__ import annotations

from collections.abc import Mapping

from planner.perception.detect.class_names import literal

MIN_SCORE = 0.4
"""What is believed of a class where nobody says anything."""
KEY = "min_scores"


def least_scores(
    metadata: Mapping[str, str], count: int, owner: float | None
) -> tuple[tuple[float, ...], str]:
    """Return the least score of each of so many classes, and in words where it is from."""
    if owner is not None:
        return (owner,) * count, f"{owner:.2f}, as set"
    told = literal(metadata.get(KEY, ""))
    if isinstance(told, (list, tuple)) and len(told) == count and all(map(_a_score, told)):
        scores = tuple(float(score) for score in told)
        return scores, f"{min(scores):.2f} to {max(scores):.2f} by class, as its file says"
    return (MIN_SCORE,) * count, f"{MIN_SCORE:.2f}"


def _a_score(value: object) -> bool:
    """Tell whether a value can be a score; not a number is none."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and 0.0 < value < 1.0
