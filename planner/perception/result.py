"""Own the vision process's answers: one picture's detections, and its setup. Data only."""

from __future__ import annotations

from dataclasses import dataclass

from planner.perception.snapshot import Detection


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
