"""Say why a request could not be brought to the bridge, by stable code, in both languages."""

from __future__ import annotations


class LinkError(Exception):
    """Report that the bridge was not reached; ``message`` is for people, ``code`` is stable."""

    code = "link_error"

    def __init__(self, en: str, zh: str) -> None:
        super().__init__(f"{self.code}: {en}")
        self.message = {"en": en, "zh": zh}


class BridgeSilent(LinkError):
    """No status came, or a request was not echoed in time."""

    code = "bridge_silent"

    def __init__(self, what: str, waited_s: float) -> None:
        super().__init__(
            f"{what}: the bridge did not answer within {waited_s:.1f} s; is it running?",
            f"{what}：安全桥在 {waited_s:.1f} 秒内没有应答，它在运行吗？",
        )
