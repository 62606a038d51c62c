"""Draw a run from its number: user, moods, mission, and the stop of a person. Pure."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from enum import StrEnum
from random import Random
from typing import Any

from tools.bench.confirmation import CLI, HTTP
from tools.bench.users import CAMERA, LOCALIZATION, MEMBER, PLANNER, SIM, STRANGER


class Mood(StrEnum):
    """Name what a hostile client wants."""

    TAKE_OVER = "owner of its own, through walls"
    IMPERSONATE = "the planner's name, through walls"
    STICK = "a stick at full speed"
    EXTERNAL = "an external brain at full speed"
    PROOFS = "arm, reset, resume, another fence"
    SENSES = "forged scans, wheels, gyro and poses"
    CREEP = "a pose that creeps away"
    LEAP = "a pose that leaps"
    WHEELS = "the wheels themselves"
    ANSWERS = "the bridge's word that all is stopped"
    SIMULATOR = "another place, faults"
    BUTTON = "a stop button that is released"
    NUISANCE = "stops, protective stops, disarms"
    GARBAGE = "bytes that are no messages"


OFTEN = (
    Mood.TAKE_OVER, Mood.IMPERSONATE, Mood.STICK, Mood.EXTERNAL, Mood.PROOFS, Mood.SENSES,
    Mood.WHEELS, Mood.ANSWERS, Mood.SIMULATOR, Mood.BUTTON, Mood.GARBAGE,
)  # fmt: skip
SELDOM = {Mood.NUISANCE: 0.05}
"""It stops the robot, as it may: nothing else would be tried then."""
POSES = (Mood.CREEP, Mood.CREEP, Mood.LEAP)
"""Kept from most turns of who is believed about the pose, or the robot would never drive."""
ORDER = (PLANNER, LOCALIZATION, CAMERA, MEMBER, STRANGER, PLANNER)
"""Whose turn it is."""
OF_THE_DRIVE = 10_000
"""From this number on it is the simulator's user, which is the drive itself, counted apart."""
RATES_HZ = (20.0, 50.0, 200.0)
MISSIONS = (
    "go to the kitchen", "go to the living room", "go to the bedroom", "go to the bathroom",
    "go to the study", "go to the entrance",
)  # fmt: skip
BEFORE = 0.15
"""So many attacks begin with the mission; most of those keep it from driving at all."""
WATCH_S = 2.0
"""So long after a stop nobody but the hostile client acts: what moves then moves unasked."""


@dataclass(frozen=True, slots=True)
class HostileRun:
    """Hold one run whole; moments count from when the robot drives [s]."""

    number: int
    user: str
    moods: tuple[Mood, ...]
    rate_hz: float
    begins_s: float
    """When the attack begins; negative: before the robot drives."""
    mission: str
    way: str
    """How the person says stop: HTTP or CLI."""
    stop_s: float

    def record(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        return asdict(self)


def draw(number: int) -> HostileRun:
    """Return the run of a number: the same one every time."""
    chance = Random(f"hostile user {number}")
    user = SIM if number >= OF_THE_DRIVE else ORDER[number % len(ORDER)]
    believed = user in (LOCALIZATION, SIM)
    moods = set(chance.sample(OFTEN if believed else OFTEN + POSES, chance.choice((1, 2, 4))))
    moods |= {mood for mood, share in SELDOM.items() if chance.random() < share}
    if believed and chance.random() < 0.8:
        moods.add(chance.choice(POSES))
    stop_s = round(chance.uniform(1.0, 5.0), 3)
    early = chance.random() < BEFORE
    begins_s = -0.2 if early else chance.uniform(0.0, stop_s - 0.5)
    return HostileRun(
        number=number,
        user=user,
        moods=tuple(sorted(moods)),
        rate_hz=chance.choice(RATES_HZ),
        begins_s=round(begins_s, 3),
        mission=chance.choice(MISSIONS),
        way=chance.choice((HTTP, CLI)),
        stop_s=stop_s,
    )
