"""Own the eyes' reports: detections in a picture, things on the map, one look whole. Data only.

Pixels: x right, y down, from the picture's upper left corner. Positions: metres in ``map``. Times:
``*_s`` on this planner's monotonic clock. No numpy: missions and routes read these too. The answers
of the vision's process are here with the frames in which they cross to the planner.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from processes.worker_protocol import Frame

if TYPE_CHECKING:
    from wire import Pose2

Box = tuple[float, float, float, float]
"""Left, top, right, bottom [px]."""


@dataclass(frozen=True, slots=True)
class Detection:
    """Hold one thing that a detector found in one picture."""

    label: str
    """The class's id: lower case, words joined by ``_``."""
    score: float
    """0 to 1."""
    box: Box
    color: str | None = None
    """The id of its prevailing colour, where it has one."""
    depth_m: float | None = None
    """Along the optical axis, the median of the inner box; None where nothing was measured."""
    depth_spread_m: float = 0.0
    """Half the distance between the quartiles of what was measured there."""


@dataclass(frozen=True, slots=True)
class Thing:
    """Remember one thing on the map."""

    id: str
    """Minted here, the same for as long as it is remembered: ``cup_3``."""
    label: str
    color: str | None
    x_m: float
    y_m: float
    z_m: float
    """Height of its middle above the floor."""
    sigma_m: float
    """One standard deviation of where it stands, on the floor plane."""
    confidence: float
    """0 to 1: how sure we are that it is there at all."""
    seen_s: float
    """When it was seen last."""
    first_s: float
    sightings: int
    room: str | None = None
    """The room it lies in, where it lies in one."""


@dataclass(frozen=True, slots=True)
class LookSnapshot:
    """Report one picture that was thought upon."""

    seq: int
    """Of the picture, as the camera numbers them."""
    taken_s: float
    """When it was taken."""
    base_in_map: Pose2 | None
    """Where the robot was at that instant; None where it did not know."""
    width: int
    height: int
    detections: tuple[Detection, ...]
    here: tuple[str, ...] = ()
    """Ids of the things on the map that are in this picture, one per detection or ''."""


@dataclass(frozen=True, slots=True)
class Sight:
    """Hold perception's knowledge now: the newest look and all remembered things."""

    look: LookSnapshot | None = None
    things: tuple[Thing, ...] = ()
    blind: str | None = None
    """Why nothing is seen now (a stable code: ``no_camera``, ``no_detector``, ``camera_silent``,
    ``camera_frozen``, ``camera_unusable``, ``detector_down``, or what the detector was refused
    for); None while pictures are thought upon."""


@dataclass(frozen=True, slots=True)
class LookResult:
    """Hold the detections in one picture, or why it was skipped."""

    detections: tuple[Detection, ...]
    width: int
    height: int
    """Of the picture [px]; 0 where it could not even be told."""
    took_s: float
    """In the vision process, decoding included."""
    skipped: str | None = None
    """A code of :data:`planner.perception.failure.SKIPS`; then there are no detections."""
    depth_lost: str | None = None
    """A code of the same, where it was looked at without its depth for that."""
    wide: bool = False
    """The open-vocabulary model looked, too: what it knows and did not find is not there."""


@dataclass(frozen=True, slots=True)
class DetectorInfo:
    """Say which detector runs, how its output is read, where, and why so."""

    model: str
    """The file's name."""
    decoder: str
    why: str
    """Why this decoder."""
    provider: str
    provider_why: str
    classes: tuple[str, ...]
    """Ids, in the model's order; '' where it has a class without a name."""
    width: int
    height: int
    """Of the model's input [px]."""
    least: str
    """How high something must score to be reported, in words."""
    words: tuple[tuple[str, ...], ...] = ()
    """All that people may call each class, where the owner gave several names; else none."""
    beside: DetectorInfo | None = None
    """The open-vocabulary model that looks where a step needs it."""

    @property
    def line(self) -> str:
        """Say it all in one line for a log."""
        size = f"{self.width}x{self.height}"
        count = sum(map(bool, self.classes))
        told = (
            f"detector {self.model}: input {size}, {count} classes; decoder {self.decoder} "
            f"({self.why}); provider {self.provider} ({self.provider_why}); "
            f"least score {self.least}"
        )
        return told if self.beside is None else f"{told}; beside it {self.beside.line}"


def look_frame(result: LookResult) -> Frame:
    """Return a result as a frame."""
    return asdict(result), b""


def read_look(frame: Frame) -> LookResult:
    """Return the result that :func:`look_frame` wrote. Raises KeyError, TypeError or ValueError."""
    head, _ = frame
    skipped, depth_lost = head["skipped"], head["depth_lost"]
    return LookResult(
        detections=tuple(map(_detection, head["detections"])),
        width=int(head["width"]),
        height=int(head["height"]),
        took_s=float(head["took_s"]),
        skipped=None if skipped is None else str(skipped),
        depth_lost=None if depth_lost is None else str(depth_lost),
        wide=bool(head["wide"]),
    )


def _detection(item: dict[str, Any]) -> Detection:
    left, top, right, bottom = (float(side) for side in item["box"])
    return Detection(**{**item, "box": (left, top, right, bottom)})


def read_about(head: dict[str, Any] | None) -> DetectorInfo | None:
    """Return the running detector; None without a model. Raises KeyError or TypeError."""
    if head is None:
        return None
    told = {
        "classes": tuple(head["classes"]),
        "words": tuple(map(tuple, head["words"])),
        "beside": read_about(head["beside"]),
    }
    return DetectorInfo(**{**head, **told})
