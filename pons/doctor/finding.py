"""Own what a check finds: a verdict, what was found, and how to mend it, in both languages."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Verdict(StrEnum):
    """Grade a finding."""

    OK = "ok"
    WARN = "warn"
    """Something works less well, or not at all without harm to the rest."""
    FAIL = "fail"
    """The robot will not start, or will not move."""


@dataclass(frozen=True, slots=True)
class Words:
    """Say it in English and Chinese."""

    en: str
    zh: str


@dataclass(frozen=True, slots=True)
class Finding:
    """Hold what one check found."""

    name: str
    """Stable, in snake_case."""
    verdict: Verdict
    found: Words
    fix: Words | None = None
    """What to do; always there unless the verdict is ok."""


def ok(name: str, en: str, zh: str) -> Finding:
    """Return a finding that all is well."""
    return Finding(name, Verdict.OK, Words(en, zh))


def warn(name: str, found: Words, fix: Words) -> Finding:
    """Return a finding that something lacks."""
    return Finding(name, Verdict.WARN, found, fix)


def fail(name: str, found: Words, fix: Words) -> Finding:
    """Return a finding that nothing works without."""
    return Finding(name, Verdict.FAIL, found, fix)
