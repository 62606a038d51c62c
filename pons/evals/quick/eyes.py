"""Ask a model about one drawn picture: whether it takes pictures, and whether it sees anything.

A red disc left of the middle and a blue square right of it. The picture is the exam's own, so no
camera's picture leaves by it; a server that drops pictures without a word is found out.
"""

from __future__ import annotations

import base64
from math import hypot
from typing import TYPE_CHECKING

from planner.brain import BadPlan, BrainDown
from planner.brain.image_questions import ImagePoint, ImageQuestion, NotSent, PosedPicture
from pons.evals.quick.exam import PictureResult

if TYPE_CHECKING:
    from planner.brain.image_questions import Looker

PICTURE = PosedPicture(
    base64.b64decode(
        "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAA0JCgsKCA0LCgsODg0PEyAVExISEyccHhcgLikxMC4pLSwzOko+MzZG"
        "NywtQFdBRkxOUlNSMj5aYVpQYEpRUk//2wBDAQ4ODhMREyYVFSZPNS01T09PT09PT09PT09PT09PT09PT09PT09P"
        "T09PT09PT09PT09PT09PT09PT09PT09PT0//wAARCABIAGADASIAAhEBAxEB/8QAGwABAQADAQEBAAAAAAAAAAAA"
        "AAcEBQYBAgP/xAA4EAACAQMCAwILBgcAAAAAAAAAAQIDBBEFIQYSQTFRBxM1NmF0gYORsrMUFiJUktIVQmJxoeHw"
        "/8QAGgEBAAMBAQEAAAAAAAAAAAAAAAIDBAUBBv/EACwRAAICAQIDBAsAAAAAAAAAAAABAgMRBBIFEzEhMjNBFBUi"
        "UVJhYnGhweH/2gAMAwEAAhEDEQA/AKcAAAAAAAAAAAAAAAAAAAAAYMta0qLinqNp+J4WKsX0b3327OpxPFfENTUK"
        "87K1ly2dOWG08+Nafblfy93x7sc4Z534eEdjT8Kc4brHjPkWK3uaF1Bztq9KtBPDlTmpJPu2P1JDp1/c6beQurSf"
        "LOOzT7JLqmuqKjpGpUtV06nd0ly820oZTcJLtT/7saJ12qfYZtZoZaf2k8ozQCUcbedd77v6cTbpqOfPbnBzZz2r"
        "JVwQsG31Z9f4/pXz/kXQE38HPl+v6rL5oFIMOop5M9mclsJblkHk3JQk6cYynh8qk8Jv0vDx8D0FBIjAN1xLodXS"
        "LyU4RzZ1ZPxUlnEf6X6V/n440pzmmnhn2ddkbIqcX2MHf8AOX8HuE4x5PtDw87t8sc7Y/t1/3wttb1ru4hb21OVS"
        "rUeIxXUqGgaWtI0uFs5RlUbc6so5w5Puz6El7C2hPdk53FbIqrZ5s2RKONvOu9939OJVyUcbedd77v6cTucN8V/b"
        "9o+Xu7pogAdszHWeDny/X9Vl80CkE38HPl+v6rL5oFIODxDxjVV3QADEWnxWo0q9J0q9OFWnLthOKkn7GaeXCWiN"
        "xatJR5XlpVZ/i2ez39u3cbsHjin1RZC6yvuSaMLT9J0/TeZ2VrClKXbLeUsbbZe+NlsZoASS6EZSlJ5k8sHP6pwh"
        "p2qahVvbitdRqVcZUJRS2SXWL7joAWQslW8xeCDSfU5T7gaT+Yvf1w/aPuBpP5i9/XD9p1YLfS7viI8uPuNJovDF"
        "jot5O5tatxOc6bptVJRaw2n0S7jdgFU5ym8yeWSSS6AAED0AAAAAAAAAAAAAAA//2Q=="
    ),
    width=96,
    height=72,
    seq=1,
)
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
