"""Answer questions about a picture by a tiny rule.

The mock has no eyes: it tells a picture's size from its head, takes for seen what the detector's
lists in the prompt say, and reads as "what stands written there" the picture's comment (a JPEG
segment), where a test puts the words that it has drawn.
"""

from __future__ import annotations

import base64
import binascii
import json
from dataclasses import dataclass
from typing import Any, Literal

from planner.brain.jpeg_metadata import jpeg_size, segments

COMMENT = 0xFE
_URL = "data:image/jpeg;base64,"


@dataclass(frozen=True, slots=True)
class PictureOrder:
    """Hold a question about a picture."""

    kind: Literal["look", "point", "seek"]
    words: str
    listed: tuple[dict[str, Any], ...]
    jpeg: bytes | None

    @property
    def sign_text(self) -> str:
        """Return the text written in the picture."""
        found = segments(self.jpeg or b"")
        return next(
            (body.decode("utf-8", "replace") for mark, body in found if mark == COMMENT), ""
        )


def asked_of(body: dict[str, Any]) -> PictureOrder | None:
    """Return the question about a picture that a request holds, or None where it is another."""
    for message in dicts(body.get("messages")):
        if message.get("role") != "user":
            continue
        parts = dicts(message.get("content"))
        text = next((p["text"] for p in parts if isinstance(p.get("text"), str)), None)
        order = order_of(text if text is not None else message.get("content"))
        for kind, key in (("look", "question"), ("point", "point_at"), ("seek", "look_for")):
            if isinstance(order.get(key), str):
                tiles = dicts(order.get("pictures"))
                each = (order, *tiles)
                listed = tuple(line for one in each for line in dicts(one.get("detector")))
                return PictureOrder(kind, order[key], listed, _picture(parts))  # type: ignore[arg-type]  # one of the three
    return None


def answer(asked: PictureOrder) -> str:
    """Return the reply to a question about a picture."""
    if asked.jpeg is None:
        return drop(asked)
    return dump({"look": describe, "point": _point, "seek": _seek}[asked.kind](asked))


def drop(asked: PictureOrder) -> str:
    """Return the reply of a model that no picture has reached."""
    if asked.kind == "seek":
        return dump({"picture": False, "there": False, "sure": 0})
    return dump({"picture": False, "en": "There is no picture.", "zh": "没有图像。"})


def describe(asked: PictureOrder) -> dict[str, Any]:
    """Return what is told of a picture: its size, the detector's list and its comment."""
    width, height = jpeg_size(asked.jpeg or b"") or (0, 0)
    names = [str(line.get("what", "")) for line in asked.listed]
    en, zh = f"A picture of {width} by {height}: ", f"{width}×{height} 的图像："
    en += f"{', '.join(names) or 'nothing'}."
    zh += f"{'、'.join(names) or '什么也没有'}。"
    if asked.sign_text:
        en, zh = f"{en} “{asked.sign_text}” stands there.", f"{zh}上面写着“{asked.sign_text}”。"
    seen = any(name.split()[-1] in asked.words.lower() for name in names if name.split())
    return {"picture": True, "seen": seen, "en": en, "zh": zh}


def _seek(asked: PictureOrder) -> dict[str, Any]:
    """Return a thing in the middle where the picture's comment names it; a mock has no eyes."""
    words = asked.words.lower().split()
    there = bool(words) and words[-1].rstrip("s") in asked.sign_text.lower()
    return {"picture": True, "there": there, "middle": int(there), "sure": 90}


def _point(asked: PictureOrder) -> dict[str, Any]:
    for line in asked.listed:
        name = str(line.get("what", "")).split()
        if name and name[-1] in asked.words.lower():
            return {"picture": True, "there": True, "x": line.get("x"), "y": line.get("y")}
    return {"picture": True, "there": False}


def order_of(text: object) -> dict[str, Any]:
    """Return the object that ends a message; empty where there is none."""
    try:
        found = json.loads(text[max(0, text.rfind('\n{"')) :]) if isinstance(text, str) else None
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def _picture(parts: list[dict[str, Any]]) -> bytes | None:
    for part in parts:
        image = part.get("image_url")
        url = image.get("url") if isinstance(image, dict) else None
        if isinstance(url, str) and url.startswith(_URL):
            try:
                return base64.b64decode(url.removeprefix(_URL), validate=True)
            except binascii.Error:
                return None
    return None


def dicts(value: object) -> list[dict[str, Any]]:
    """Return the objects of a list; none of what is no list."""
    return [each for each in value if isinstance(each, dict)] if isinstance(value, list) else []


def dump(value: object) -> str:
    """Write a reply."""
    return json.dumps(value, ensure_ascii=False)
