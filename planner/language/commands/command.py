"""List a person's commands to the planner itself, and hold the text that they stand in."""

from __future__ import annotations

from dataclasses import dataclass

from planner.language.folding import fold_width
from planner.language.schedule.command import OrderCommand


@dataclass(frozen=True, slots=True)
class Remember:
    """Remember where the robot stands by this name, as it was written."""

    name: str


@dataclass(frozen=True, slots=True)
class Forget:
    """Forget a taught place."""

    name: str


@dataclass(frozen=True, slots=True)
class KeepSkill:
    """Keep the steps of the order before under this name, as a skill."""

    name: str


@dataclass(frozen=True, slots=True)
class TeachFact:
    """Remember what a person says, word for word."""

    words: str
    here: bool = False
    """It speaks of the room that the robot is in: "this is Anna's room"."""
    instead_of: str = ""
    """The thing of which what was told before is no longer so; empty: nothing is."""


@dataclass(frozen=True, slots=True)
class ForgetFacts:
    """Forget what is remembered: about some words, or all of a kind."""

    about: str = ""
    """Empty: everything of these kinds."""
    told: bool = True
    """What people said is meant."""
    seen: bool = True
    """What was seen is meant."""


@dataclass(frozen=True, slots=True)
class HereCommand:
    """Tell the robot in which room or at which place it is."""

    name: str


@dataclass(frozen=True, slots=True)
class PauseCommand:
    """Stand, and keep the current goal's place."""


@dataclass(frozen=True, slots=True)
class ResumeCommand:
    """Go on with the goal that was paused last."""


@dataclass(frozen=True, slots=True)
class CancelCommand:
    """End the current goal."""


@dataclass(frozen=True, slots=True)
class Replace:
    """Do the rest of the sentence in place of the current goal."""

    rest: str
    now: bool
    """The person took the current goal back ("forget that, …"): it ends before anything is thought
    about. Otherwise ("… instead") it ends once the rest is understood."""


@dataclass(frozen=True, slots=True)
class WhereCommand:
    """Ask for the robot's position."""


@dataclass(frozen=True, slots=True)
class Doing:
    """Ask for the robot's present activity."""


@dataclass(frozen=True, slots=True)
class BatteryCommand:
    """Ask for the charge of the robot's battery."""


@dataclass(frozen=True, slots=True)
class OutcomeCommand:
    """Ask how the goal before ended: "did you find it?", "how many were there?"."""


@dataclass(frozen=True, slots=True)
class Slower:
    """Halve the speed cap of the running goal."""


@dataclass(frozen=True, slots=True)
class Faster:
    """Double the speed cap again, up to the goal's first one."""


Intent = (
    Remember
    | Forget
    | KeepSkill
    | TeachFact
    | ForgetFacts
    | HereCommand
    | PauseCommand
    | ResumeCommand
    | CancelCommand
    | Replace
    | WhereCommand
    | Doing
    | BatteryCommand
    | OutcomeCommand
    | Slower
    | Faster
    | OrderCommand
)


ENDS = " .!,;:。~…"
QUOTES = "\"'「」『』“”‘’《》"
_MARKS = str.maketrans({"’": "'", "‘": "'", "，": ",", "；": ";", "：": ":", "、": ","})


def write_plainly(text: str) -> str:
    """Return a sentence in one width, with single spaces and plain marks."""
    return " ".join(fold_width(text).translate(_MARKS).split())


@dataclass(frozen=True, slots=True)
class FoldedText:
    """Hold a sentence twice: to match, and as it was written; character for character alike."""

    folded: str
    written: str

    def part(self, start: int, end: int) -> FoldedText:
        return FoldedText(self.folded[start:end], self.written[start:end])

    def strip(self, characters: str) -> FoldedText:
        start = len(self.folded) - len(self.folded.lstrip(characters))
        return self.part(start, max(start, len(self.folded.rstrip(characters))))
