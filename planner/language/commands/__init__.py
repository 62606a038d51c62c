"""Read a person's orders to the planner itself, before any brain: pause, go on, remember this.

Pure, both languages, whole sentences only. The one door of this package.
"""

from planner.language.commands.command import (
    BatteryCommand,
    CancelCommand,
    Doing,
    Faster,
    Forget,
    ForgetFacts,
    HereCommand,
    Intent,
    KeepSkill,
    OutcomeCommand,
    PauseCommand,
    Remember,
    Replace,
    ResumeCommand,
    Slower,
    TeachFact,
    WhereCommand,
)
from planner.language.commands.facts import name_subject, read_fact_correction, read_statement
from planner.language.commands.parser import intent_of

__all__ = [
    "BatteryCommand",
    "CancelCommand",
    "Doing",
    "Faster",
    "Forget",
    "ForgetFacts",
    "HereCommand",
    "Intent",
    "KeepSkill",
    "OutcomeCommand",
    "PauseCommand",
    "Remember",
    "Replace",
    "ResumeCommand",
    "Slower",
    "TeachFact",
    "WhereCommand",
    "intent_of",
    "name_subject",
    "read_fact_correction",
    "read_statement",
]
