"""Define questions about one picture: the question goes out with it, an answer comes back.

Knows no model, no network, no detector. What comes back is words, a yes or no, or a pixel: never a
step, a place or an order. Words that stood in the picture may be among the words: they may describe
and never command (``planner.brain.tainted_text``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from planner.brain.errors import BrainDown
from planner.plan import Bilingual, BrainTag, Language

if TYPE_CHECKING:
    from wire import Pose2

MAX_VIEWS = 16
"""Pictures on one sheet: with more of them too little of each would be left."""
LONG_SIDE_PX = 1024
"""A picture leaves with no longer side than this."""
FULL = 1000
"""A pixel answer counts from 0 to this: x to the right, y down, whatever the picture's size."""
MOST_COUNTED = 50
"""Things of a kind in a third of a picture."""
MAX_SAID = 300
"""Characters of an answer in one language; what is longer is cut."""


@dataclass(frozen=True, slots=True)
class PosedPicture:
    """Hold one picture, and where it was taken from."""

    jpeg: bytes
    width: int
    height: int
    seq: int
    """As the camera numbers them."""
    base_in_map: Pose2 | None = None
    """The robot when it was taken: a pixel of this picture is projected from there."""


@dataclass(frozen=True, slots=True)
class DirectionView:
    """Hold the picture of one of several directions from one spot, and its detections."""

    picture: PosedPicture
    direction: Bilingual
    detections: Sequence[DetectedObject] = ()


class DetectedObject(Protocol):
    """Be one thing that a detector found in the picture, as ``planner.perception.Detection``."""

    @property
    def label(self) -> str:
        """Return the class's id."""
        ...

    @property
    def color(self) -> str | None:
        """Return the prevailing colour's id."""
        ...

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Return left, top, right, bottom [px]."""
        ...

    @property
    def depth_m(self) -> float | None:
        """Return how far away it is."""
        ...


@dataclass(frozen=True, slots=True)
class ImageQuestion:
    """Hold a question about one picture."""

    picture: PosedPicture
    words: str
    """A question, or what is to be pointed at: the plan's own words."""
    language: Language = Language.EN
    """The person's."""
    detections: Sequence[DetectedObject] = ()
    """What the detector found in this very picture: handed over as data."""
    goal: str = ""
    """Whose budget pays."""
    direction: Bilingual | None = None
    """Which way the picture shows, from how the robot stood when it began to look."""
    views: tuple[DirectionView, ...] = ()
    """Several directions from one spot: they are shown on one sheet in place of the picture."""


@dataclass(frozen=True, slots=True)
class ImageDescription:
    """Answer a question about a picture."""

    text: Bilingual
    """For people. Tainted: it may repeat what stands written in the picture."""
    seen: bool | None
    """Whether what was asked for is there; None where that is not what was asked."""
    brain: BrainTag


@dataclass(frozen=True, slots=True)
class ImagePoint:
    """Point at the requested thing, each coordinate of 0 to 1000."""

    x: int
    y: int
    brain: BrainTag

    def pixel(self, width: int, height: int) -> tuple[float, float]:
        """Return the point in pixels of a picture of this size."""
        return self.x * width / FULL, self.y * height / FULL


@dataclass(frozen=True, slots=True)
class NotThere:
    """Mark that the requested thing is not in the picture."""

    brain: BrainTag


@dataclass(frozen=True, slots=True)
class ImageSighting:
    """Say whether a kind of thing is in the picture: figures, and no word that stood in it."""

    there: bool
    left: int
    middle: int
    right: int
    """How many have their middle in that third of the picture."""
    sure: float
    """0 to 1, as the model says."""
    brain: BrainTag


class NotSent(BrainDown):
    """No call went out, and no call is to blame: this picture, or pictures at all, may not be sent.

    ``why``: ``pictures_offhost``, ``no_pictures``, ``bad_picture``, ``picture_too_large``.
    """


class Looker(Protocol):
    """Answer about a picture. Cancelling either call must take effect at once."""

    @property
    def tag(self) -> BrainTag:
        """Return the model's name, for the goal's record."""
        ...

    async def describe(self, asked: ImageQuestion) -> ImageDescription:
        """Return the answer to a question about a picture.

        Raises:
            NotSent: the picture did not leave.
            BadPlan: neither reply is an answer.
            BrainDown: the model does not answer in time.
            OutOfBudget: a call was refused by the meter.
        """
        ...

    async def point(self, asked: ImageQuestion) -> ImagePoint | NotThere:
        """Return where in a picture something is, or that it is not there.

        Raises:
            NotSent, BadPlan, BrainDown, OutOfBudget: as ``describe`` does.
        """
        ...

    async def seek(self, asked: ImageQuestion) -> ImageSighting:
        """Return whether what the words name is in a picture, and how many of it.

        Raises:
            NotSent, BadPlan, BrainDown, OutOfBudget: as ``describe`` does.
        """
        ...
