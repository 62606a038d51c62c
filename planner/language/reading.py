"""List what a sentence may be read as, by ``planner.language.readers``. Data only."""

from __future__ import annotations

from dataclasses import dataclass

from planner.language.commands import Intent
from planner.language.schedule import OrderCommand
from planner.plan import ChangedOrder, Plan


@dataclass(frozen=True, slots=True)
class HaltReading:
    """Hold words that stop the robot before anything else."""

    rest: str = ""
    """What is said behind the stop, in the same breath."""
    is_doubtful: bool = False
    """Another meaning is thought about once the robot stands, and waits for a yes."""


@dataclass(frozen=True, slots=True)
class AnswerReading:
    """Hold a plain yes or no, and the goals that it may answer; one alone is beyond doubt."""

    goals: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ChangeReading:
    """Hold how a sentence leans on the orders before it: the role that its plan takes."""

    changed: ChangedOrder
    """What it makes of the newest order."""
    ends: bool = False
    """It ends what runs."""
    first: bool = False
    """It is done right after what runs, or in its place."""
    replaces: bool = False
    """It ends what runs once it is understood."""
    corrects: bool = False
    """It puts something else in the place of what was ordered or asked."""
    keeps_round: bool = False
    """What runs goes on, without one of its places or with one first."""


@dataclass(frozen=True, slots=True)
class OrdersReading:
    """Hold a standing order, or what is said about those that are kept."""

    command: OrderCommand


@dataclass(frozen=True, slots=True)
class CommandReading:
    """Hold a word to the planner itself: a command, or a fact that it is to remember."""

    intent: Intent


@dataclass(frozen=True, slots=True)
class PlanReading:
    """Hold a plan, an answer, a refusal, or a question that may offer one order."""

    plan: Plan


Reading = HaltReading | AnswerReading | ChangeReading | OrdersReading | CommandReading | PlanReading
