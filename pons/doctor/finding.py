"""Own a check's finding: a verdict, the facts, and how to mend it, in both languages."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class HealthVerdict(StrEnum):
    """Grade a finding."""

    OK = "ok"
    WARN = "warn"
    """Something works less well, or not at all without harm to the rest."""
    FAIL = "fail"
    """The robot will not start, or will not move."""


@dataclass(frozen=True, slots=True)
class BilingualWords:
    """Say it in English and Chinese."""

    en: str
    zh: str


@dataclass(frozen=True, slots=True)
class HealthFinding:
    """Hold one check's finding."""

    name: str
    """Stable, in snake_case."""
    verdict: HealthVerdict
    found: BilingualWords
    fix: BilingualWords | None = None
    """What to do; always there unless the verdict is ok."""


def ok(name: str, en: str, zh: str) -> HealthFinding:
    """Return a finding that all is well."""
    return HealthFinding(name, HealthVerdict.OK, BilingualWords(en, zh))


def warn(name: str, found: BilingualWords, fix: BilingualWords) -> HealthFinding:
    """Return a finding that something lacks."""
    return HealthFinding(name, HealthVerdict.WARN, found, fix)


def fail(name: str, found: BilingualWords, fix: BilingualWords) -> HealthFinding:
    """Return a finding that nothing works without."""
    return HealthFinding(name, HealthVerdict.FAIL, found, fix)
