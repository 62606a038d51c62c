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


class OperatorProofNeeded(LinkError):
    """A real drive takes this request only with the operator's own proof."""

    code = "operator_proof_needed"

    def __init__(self, kind: str, drive: str) -> None:
        super().__init__(
            f"{kind} on drive {drive!r} needs a proof made with the operator's key; "
            "only a virtual drive is signed for here",
            f"在驱动 {drive!r} 上执行 {kind} 需要操作员密钥签名；这里只能为虚拟驱动代签",
        )
