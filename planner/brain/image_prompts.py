"""Render the questions about a picture: ``look.md``, ``point.md`` and ``seek.md`` of ``prompts``.

The person's words and what the detector found enter as JSON, as data only; the picture itself is
attached where the body is made.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any

from planner.brain.image_questions import (
    FULL,
    MOST_COUNTED,
    DetectedObject,
    DirectionView,
    ImageQuestion,
    PosedPicture,
)
from planner.brain.prompt_template import Template, as_json
from planner.brain.schema import Message
from pons_assets import PROMPTS

MAX_QUESTION = 500
MAX_LISTED = 20
"""Things of the detector that are told, the largest first."""
LEAST_LISTED = 4
"""Of each picture on a sheet, however many there are."""
_BLANKS = frozenset({"schema"})


def _object(required: list[str], **properties: Any) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": False,
    }


_BOOLEAN, _TEXT = {"type": "boolean"}, {"type": "string"}
_PART = {"type": "integer", "minimum": 0, "maximum": FULL}
LOOK_SCHEMA = _object(["picture", "en", "zh"], picture=_BOOLEAN, seen=_BOOLEAN, en=_TEXT, zh=_TEXT)
POINT_SCHEMA = _object(["picture", "there"], picture=_BOOLEAN, there=_BOOLEAN, x=_PART, y=_PART)


_COUNT = {"type": "integer", "minimum": 0, "maximum": MOST_COUNTED}
SEEK_SCHEMA = _object(
    ["picture", "there", "sure"],
    picture=_BOOLEAN,
    there=_BOOLEAN,
    left=_COUNT,
    middle=_COUNT,
    right=_COUNT,
    sure={"type": "integer", "minimum": 0, "maximum": 100},
)


class LookPrompts:
    """Hold one version of each prompt."""

    @cached_property
    def look(self) -> Template:
        """Return the prompt of a question."""
        return Template.load(PROMPTS / "look.md", _BLANKS)

    @cached_property
    def point(self) -> Template:
        """Return the prompt of a point."""
        return Template.load(PROMPTS / "point.md", _BLANKS)

    @cached_property
    def seek(self) -> Template:
        """Return the prompt of a search."""
        return Template.load(PROMPTS / "seek.md", _BLANKS)

    def look_messages(self, asked: ImageQuestion) -> list[Message]:
        """Return the messages of a question about a picture."""
        return _messages(self.look, LOOK_SCHEMA, "question", asked)

    def point_messages(self, asked: ImageQuestion) -> list[Message]:
        """Return the messages that ask where something is."""
        return _messages(self.point, POINT_SCHEMA, "point_at", asked)

    def seek_messages(self, asked: ImageQuestion) -> list[Message]:
        """Return the messages that ask whether something is there, and how many of it."""
        return _messages(self.seek, SEEK_SCHEMA, "look_for", asked)


def _messages(
    template: Template, schema: dict[str, Any], key: str, asked: ImageQuestion
) -> list[Message]:
    told: dict[str, Any] = {key: asked.words[:MAX_QUESTION], "language": asked.language.value}
    told |= _sheet(asked) if asked.views else _single(asked)
    return [
        {"role": "system", "content": template.fill(schema=as_json(schema))},
        {"role": "user", "content": as_json(told)},
    ]


def _single(asked: ImageQuestion) -> dict[str, Any]:
    """Describe one picture to the model: its direction where known, and its detections."""
    told: dict[str, Any] = {}
    if asked.direction is not None:
        told["direction"] = {"en": asked.direction.en, "zh": asked.direction.zh}
    return {**told, "detector": list_detections(asked.picture, asked.detections)}


def _sheet(asked: ImageQuestion) -> dict[str, Any]:
    """Describe each picture on a sheet: its number, its direction and its detections."""
    most = max(LEAST_LISTED, MAX_LISTED // len(asked.views))
    pictures = [
        {
            "number": number,
            "direction": {"en": view.direction.en, "zh": view.direction.zh},
            "detector": list_detections(view.picture, view.detections, most),
        }
        for number, view in enumerate(asked.views, start=1)
    ]
    return {"pictures": pictures}


def label_of(number: int, view: DirectionView) -> str:
    """Return the label above a picture of a sheet: ``1 ahead``."""
    return f"{number} {view.direction.en}"


def list_detections(
    picture: PosedPicture, found: Sequence[DetectedObject], most: int = MAX_LISTED
) -> list[dict[str, Any]]:
    """Return the detector's findings, the largest first, as the prompts say them."""
    ordered = sorted(found, key=_area, reverse=True)[:most]
    return [line for each in ordered if (line := _line(picture, each)) is not None]


def _area(each: DetectedObject) -> float:
    left, top, right, bottom = each.box
    return (right - left) * (bottom - top)


def _line(picture: PosedPicture, each: DetectedObject) -> dict[str, Any] | None:
    left, top, right, bottom = each.box
    x, y = (left + right) / 2.0 / picture.width, (top + bottom) / 2.0 / picture.height
    if not (0.0 <= x <= 1.0 and 0.0 <= y <= 1.0):  # NaN too
        return None
    what = " ".join(filter(None, (each.color, each.label.replace("_", " "))))
    line: dict[str, Any] = {"what": what, "x": round(FULL * x), "y": round(FULL * y)}
    if each.depth_m is not None and 0.0 < each.depth_m < 100.0:
        line["metres"] = round(each.depth_m, 1)
    return line
