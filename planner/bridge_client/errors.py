"""Say why a request could not be brought to the bridge, by stable code, in both languages."""

from __future__ import annotations

from planner.language.catalogue import say
from planner.plan import Bilingual


class LinkError(Exception):
    """Report that the bridge was not reached; ``message`` is for people, ``code`` is stable."""

    code = "link_error"

    def __init__(self, said: Bilingual) -> None:
        super().__init__(f"{self.code}: {said.en}")
        self.message = said.model_dump()


class BridgeSilent(LinkError):
    """No status came, or a request was not echoed in time."""

    code = "bridge_silent"

    def __init__(self, what: str, waited_s: float) -> None:
        super().__init__(say("link.bridge_silent", what=what, waited_s=waited_s))
