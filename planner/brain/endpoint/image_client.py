"""Ask a model about a picture: consent, size, prompt, call, judge, one repair turn, one deadline.

A picture leaves this machine only after the owner's second yes, never larger than 1024 pixels or
500 kB, and only inside a goal. What comes back is words, a yes or no, or a pixel: nothing else in a
reply is trusted.
"""

from __future__ import annotations

import logging
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from planner.brain.endpoint.dialect import MAX_JPEG_BYTES, data_url
from planner.brain.endpoint.line import Line
from planner.brain.endpoint.plan_reply import Unusable, clean, says_nothing
from planner.brain.endpoint.reply_object import NoObject, one_object
from planner.brain.errors import BadPlan
from planner.brain.image_prompts import (
    LOOK_SCHEMA,
    POINT_SCHEMA,
    SEEK_SCHEMA,
    LookPrompts,
    label_of,
)
from planner.brain.image_questions import (
    FULL,
    LONG_SIDE_PX,
    MAX_SAID,
    MOST_COUNTED,
    DirectionView,
    ImageDescription,
    ImagePoint,
    ImageQuestion,
    ImageSighting,
    NotSent,
    NotThere,
    PosedPicture,
)
from planner.brain.jpeg_metadata import jpeg_size, without_notes
from planner.brain.model_replies import ReplyCollector, ReplyTurn
from planner.brain.prompt_template import Template, repair
from planner.brain.response_format import LOOK_FORM, POINT_FORM, SEEK_FORM, ReplyForm
from planner.brain.schema import Message
from planner.brain.usage_meter import THINKING_ABOUT
from planner.plan import Bilingual, BrainTag

_LOOK = frozenset({"picture", "seen", "en", "zh"})
_POINT = frozenset({"picture", "there", "x", "y"})
PARTS = ("left", "middle", "right")
_SEEK = frozenset({"picture", "there", "sure", *PARTS})
MOST_SURE = 100


@dataclass(frozen=True, slots=True)
class ReplyWords:
    """Hold the answer to a question."""

    text: Bilingual
    seen: bool | None


@dataclass(frozen=True, slots=True)
class ReplyPoint:
    """Hold a point, each of 0 to 1000."""

    x: int
    y: int


@dataclass(frozen=True, slots=True)
class ReplySighting:
    """Hold whether a kind of thing is there, how many a third of the picture, and how surely."""

    there: bool
    left: int
    middle: int
    right: int
    sure: int


@dataclass(frozen=True, slots=True)
class Absent:
    """Mark that the requested thing is not in the picture."""


@dataclass(frozen=True, slots=True)
class NoPicture:
    """Say that no picture reached the model: the server dropped it without a word."""


def judge_look(text: str) -> ReplyWords | NoPicture | Unusable:
    """Return the answer that a reply is, or why it is none."""
    reply = _reply(text, _LOOK)
    if not isinstance(reply, dict):
        return reply
    en, zh = reply.get("en") or reply.get("zh"), reply.get("zh") or reply.get("en")
    if not isinstance(en, str) or not isinstance(zh, str):
        return Unusable(("the reply needs the texts en and zh",))
    said = Bilingual(en=_short_words(en), zh=_short_words(zh))
    if says_nothing(said.en) or says_nothing(said.zh):
        return Unusable(("the reply needs words of your own in en and zh",))
    seen = reply.get("seen")
    if seen is not None and not isinstance(seen, bool):
        return Unusable(("seen must be true or false, or left out",))
    return ReplyWords(said, seen)


def judge_point(text: str) -> ReplyPoint | Absent | NoPicture | Unusable:
    """Return the point that a reply is, or why it is none."""
    reply = _reply(text, _POINT)
    if not isinstance(reply, dict):
        return reply
    there = reply.get("there")
    if not isinstance(there, bool):
        return Unusable(("there must be true or false",))
    if not there:
        return Absent()
    x, y = _whole(reply.get("x")), _whole(reply.get("y"))
    if x is None or y is None:
        return Unusable((f"x and y must be whole numbers from 0 to {FULL}",))
    return ReplyPoint(x, y)


def judge_seek(text: str) -> ReplySighting | NoPicture | Unusable:
    """Return the sighting that a reply is, or why it is none. No word of it is kept."""
    reply = _reply(text, _SEEK)
    if not isinstance(reply, dict):
        return reply
    there, sure = reply.get("there"), _whole(reply.get("sure"), MOST_SURE)
    if not isinstance(there, bool):
        return Unusable(("there must be true or false",))
    if sure is None:
        return Unusable((f"sure must be a whole number from 0 to {MOST_SURE}",))
    counts = [_whole(reply.get(part, 0), MOST_COUNTED) for part in PARTS]
    if None in counts:
        parts = ", ".join(PARTS)
        return Unusable((f"{parts} must be whole numbers from 0 to {MOST_COUNTED}",))
    left, middle, right = (count or 0 for count in counts)
    if there is not (left + middle + right > 0):
        why = "where there is true, one of left, middle and right is above 0, else none"
        return Unusable((why,))
    return ReplySighting(there, left, middle, right, sure)


def _reply(text: str, keys: frozenset[str]) -> dict[str, Any] | NoPicture | Unusable:
    try:
        reply = one_object(text)
    except NoObject as why:
        return Unusable((str(why),))
    except RecursionError:  # two deep objects were compared
        return Unusable(("the reply's JSON is too deep",))
    extra = sorted(clean(str(key))[:40] for key in reply.keys() - keys)
    if extra:
        return Unusable((f"the reply takes {', '.join(sorted(keys))}, not {', '.join(extra[:6])}",))
    if reply.get("picture") is False:
        return NoPicture()
    return reply


def _whole(value: object, most: int = FULL) -> int | None:
    right = isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= most
    return value if right and isinstance(value, int) else None


def _short_words(text: str) -> str:
    plain = clean(text)
    return plain if len(plain) <= MAX_SAID else plain[: MAX_SAID - 1] + "…"


log = logging.getLogger(__name__)

T = TypeVar("T")
Shrink = Callable[[bytes, int], Awaitable[bytes]]
"""Returns a JPEG with no longer side than so many pixels, from a process that may decode."""
LayOut = Callable[[Sequence[tuple[bytes, str]], int], Awaitable[bytes]]
"""Returns one JPEG with these pictures, each below its label, likewise."""


class EndpointLooker:
    """Look through a model behind an OpenAI-compatible endpoint."""

    def __init__(
        self,
        line: Line,
        shrink: Shrink | None = None,
        lay_out: LayOut | None = None,
        replies: ReplyCollector | None = None,
    ) -> None:
        """Read the prompts.

        Args:
            line: shared with whoever plans by the same model.
            shrink: makes a large picture smaller; None: a large one is not sent.
            lay_out: puts several pictures on one sheet; None: no sheet is sent.
            replies: keeps what the model wrote; None: nothing is kept.

        Raises:
            ConfigError: ``prompt_missing``, ``prompt_malformed``.
        """
        self._line, self._shrink, self._lay_out = line, shrink, lay_out
        self._replies = replies or ReplyCollector(0)
        self._prompts = LookPrompts()
        prompts = (self._prompts.look, self._prompts.point, self._prompts.seek)
        self._look, self._point, self._seek = map(self._make_tag, prompts)

    def _make_tag(self, prompt: Template) -> BrainTag:
        name = clean(self._line.settings.name)
        return BrainTag(name=name, version=str(prompt.version), prompt=prompt.tag)

    @property
    def tag(self) -> BrainTag:
        """Return the model's name, and the prompt of a question."""
        return self._look

    @property
    def refuses(self) -> str | None:
        """Return why no picture is sent at all, as far as is known; None where one may be."""
        settings = self._line.settings
        if not self._line.address.local and not settings.allow_pictures_offhost:
            return "pictures_offhost"
        takes = self._line.asker.pictures if settings.pictures is None else settings.pictures
        return "no_pictures" if takes is False else None

    async def describe(self, asked: ImageQuestion) -> ImageDescription:
        """Return the model's answer; see ``planner.brain.image_questions.Looker``."""

        async def talk(end_s: float) -> ReplyWords:
            picture = await self._sheet(asked.views) if asked.views else asked.picture
            url = await self._url(picture)
            messages = self._prompts.look_messages(asked)
            return await self._twice(messages, (LOOK_FORM, LOOK_SCHEMA), url, end_s, judge_look)

        said = await self._line.turn(asked.goal, talk, "answer")
        return ImageDescription(self._redact(said.text), said.seen, self._look)

    async def point(self, asked: ImageQuestion) -> ImagePoint | NotThere:
        """Return where the model points; see ``planner.brain.image_questions.Looker``."""

        async def talk(end_s: float) -> object:
            url = await self._url(asked.picture)
            messages = self._prompts.point_messages(asked)
            return await self._twice(messages, (POINT_FORM, POINT_SCHEMA), url, end_s, judge_point)

        found = await self._line.turn(asked.goal, talk, "point")
        if isinstance(found, ReplyPoint):
            return ImagePoint(found.x, found.y, self._point)
        return NotThere(self._point)

    async def seek(self, asked: ImageQuestion) -> ImageSighting:
        """Return what the model sees of a kind; see ``planner.brain.image_questions.Looker``."""

        async def talk(end_s: float) -> ReplySighting:
            url = await self._url(asked.picture)
            messages = self._prompts.seek_messages(asked)
            return await self._twice(messages, (SEEK_FORM, SEEK_SCHEMA), url, end_s, judge_seek)

        found = await self._line.turn(asked.goal, talk, "answer")
        counts = (found.left, found.middle, found.right)
        return ImageSighting(found.there, *counts, found.sure / MOST_SURE, self._seek)

    async def _url(self, picture: PosedPicture) -> str:
        """Return the picture as it is sent.

        Raises:
            NotSent: it is not.
        """
        self._consent()
        jpeg, size = picture.jpeg, _size(picture.jpeg)
        if size != (picture.width, picture.height):
            told = f"{size} in the JPEG, {picture.width} x {picture.height} told"
            raise NotSent(f"the picture is not what it is said to be: {told}", why="bad_picture")
        if max(size) > LONG_SIDE_PX and self._shrink is not None:
            jpeg = await self._shrink(jpeg, LONG_SIDE_PX)
            size = _size(jpeg)
        if max(size) > LONG_SIDE_PX or len(jpeg) > MAX_JPEG_BYTES:
            told = f"{size[0]} x {size[1]} px, {len(jpeg)} bytes"
            most = f"{LONG_SIDE_PX} px, {MAX_JPEG_BYTES} bytes"
            raise NotSent(f"{told}; at most {most}", why="picture_too_large")
        return data_url(jpeg if self._line.address.local else without_notes(jpeg))

    def _consent(self) -> None:
        """Raise NotSent where no picture may leave at all."""
        refused = self.refuses
        if refused is not None:
            raise NotSent(f"{self._line.address.host}: {refused}", why=refused)

    async def _sheet(self, views: Sequence[DirectionView]) -> PosedPicture:
        """Return the pictures of several directions as one, each below its label.

        Raises:
            NotSent: it can't be made.
        """
        self._consent()
        if self._lay_out is None:
            raise NotSent(f"nobody can lay out {len(views)} pictures", why="bad_picture")
        named = [(view.picture.jpeg, label_of(at, view)) for at, view in enumerate(views, start=1)]
        jpeg = await self._lay_out(named, LONG_SIDE_PX)
        return PosedPicture(jpeg, *_size(jpeg), views[-1].picture.seq)

    async def _twice(
        self,
        messages: list[Message],
        wanted: tuple[ReplyForm, dict[str, Any]],
        url: str,
        end_s: float,
        judged: Callable[[str], T | NoPicture | Unusable],
    ) -> T:
        """Return the verdict on a reply, after one repair turn at most."""
        reasons: list[str] = []
        asked = messages
        for turn in (ReplyTurn.LOOK, ReplyTurn.REPAIR):
            form, schema = wanted
            reply = await self._line.asker.ask(
                asked, schema, end_s, None, form=form, picture=url, again=True
            )
            if reply.refusal is not None:
                self._keep(turn, reply.refusal, used=False)
                raise BadPlan(f"the model declined: {clean(reply.refusal)[:200]}")
            found = judged(reply.text)
            self._keep(turn, reply.text, used=not isinstance(found, NoPicture | Unusable))
            if isinstance(found, NoPicture):
                raise NotSent("the model says that no picture came with it", why="no_pictures")
            if not isinstance(found, Unusable):
                return found
            told = found.reasons if reply.trouble is None else (reply.trouble, *found.reasons)
            reasons = [self._line.client.secret.redact(each) for each in told]
            log.info("%s wrote no %s, asked again: %s", self._look.name, form.name, reasons)
            asked = [*messages, *repair(reply.text, reasons)]
        raise BadPlan(f"asked twice: {'; '.join(reasons)}"[:400])

    def _keep(self, turn: ReplyTurn, text: str, *, used: bool) -> None:
        goal = THINKING_ABOUT.get() or ""
        self._replies.keep(goal, text, model=self._look.name, turn=turn, used=used)

    def _redact(self, text: Bilingual) -> Bilingual:
        struck = self._line.client.secret.redact
        return Bilingual(en=struck(text.en), zh=struck(text.zh))


def _size(jpeg: bytes) -> tuple[int, int]:
    size = jpeg_size(jpeg)
    if size is None or min(size) < 1:
        raise NotSent(f"{len(jpeg)} bytes are no JPEG with a size", why="bad_picture")
    return size
