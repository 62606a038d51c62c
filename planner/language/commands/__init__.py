"""Read a person's orders to the planner itself, before any brain: pause, go on, remember this.

Pure, both languages, whole sentences only. The one door of this package.
"""

from planner.language.commands.command import (
    AppendCommand,
    BatteryCommand,
    CancelCommand,
    Doing,
    Faster,
    Forget,
    ForgetFacts,
    HereCommand,
    Intent,
    LeaningCommand,
    LeaveOutCommand,
    OtherPlaceCommand,
    OutcomeCommand,
    PauseCommand,
    Remember,
    RepeatCommand,
    Replace,
    ResumeCommand,
    Slower,
    TeachFact,
    WhereCommand,
)
from planner.language.commands.fact_corrections import name_subject, read_fact_correction
from planner.language.commands.facts import read_statement
from planner.language.commands.first_place import read_first_place
from planner.language.commands.left_out import (
    read_absent_place,
    read_denied_place,
    read_left_out,
)
from planner.language.commands.parser import intent_of

__all__ = [
    "AppendCommand",
    "BatteryCommand",
    "CancelCommand",
    "Doing",
    "Faster",
    "Forget",
    "ForgetFacts",
    "HereCommand",
    "Intent",
    "LeaningCommand",
    "LeaveOutCommand",
    "OtherPlaceCommand",
    "OutcomeCommand",
    "PauseCommand",
    "Remember",
    "RepeatCommand",
    "Replace",
    "ResumeCommand",
    "Slower",
    "TeachFact",
    "WhereCommand",
    "intent_of",
    "name_subject",
    "read_absent_place",
    "read_denied_place",
    "read_fact_correction",
    "read_first_place",
    "read_left_out",
    "read_statement",
]
