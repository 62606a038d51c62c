"""Ask a model about one drawn picture: whether it takes pictures, and whether it sees anything.

A red disc left of the middle and a blue square right of it. The picture is the exam's own, so no
camera's picture leaves by it; a server that drops pictures without a word is found out.
"""

from __future__ import annotations

from math import hypot
from pathlib import Path
from typing import TYPE_CHECKING

from planner.brain import BadPlan, BrainDown
from planner.brain.image_questions import ImagePoint, ImageQuestion, NotSent, PosedPicture
from pons.evals.quick.exam import PictureResult

if TYPE_CHECKING:
    from planner.brain.image_questions import Looker

PICTURE = PosedPicture((Path(__file__).parent / "disc.jpg").read_bytes(), 96, 72, seq=1)
QUESTION = "What colour is the round thing?"
DISC = (302, 500)
NEAR = 120
"""The disc's radius is 146 of 1000 in width."""


async def examine_eyes(looker: Looker, goal: str) -> PictureResult:
    """Return a model's reading of the picture: two calls, and two repairs at most."""
    try:
        said = await looker.describe(ImageQuestion(PICTURE, QUESTION, goal=goal))
        named = "red" in said.text.en.lower() and "blue" not in said.text.en.lower()
        if not named:
            return PictureResult("wrong", f"asked for red: {said.text.en}"[:120])
        found = await looker.point(ImageQuestion(PICTURE, "the red disc", goal=goal))
    except NotSent as no:
        return PictureResult("none", no.why)
    except BrainDown as down:
        return PictureResult("no_answer", down.why)
    except BadPlan as rejected:
        return PictureResult("no_answer", str(rejected)[:120])
    if isinstance(found, ImagePoint) and hypot(found.x - DISC[0], found.y - DISC[1]) <= NEAR:
        return PictureResult("right")
    where = f"({found.x}, {found.y})" if isinstance(found, ImagePoint) else "nowhere"
    return PictureResult("wrong", f"asked for {DISC}, pointed at {where}")
