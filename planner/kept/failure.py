"""Own what a failure is: a stable code, its sentence in both languages, particulars. Data only."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar


class Failure(Exception):
    """Say why there is no answer. Who keeps a process derives his own, with his table."""

    reasons: ClassVar[Mapping[str, tuple[str, str]]]
    """Every code with its sentence in English and Chinese."""

    def __init__(self, code: str, detail: str = "") -> None:
        """Keep the code, and a sentence in both languages with the particulars."""
        en, zh = self.reasons[code]
        super().__init__(f"{code}: {en}" + (f" ({detail})" if detail else ""))
        self.code = code
        self.detail = detail
        self.message = {
            "en": f"{en} ({detail})" if detail else en,
            "zh": f"{zh}（{detail}）" if detail else zh,
        }


@dataclass(frozen=True, slots=True)
class Codes:
    """Name, in its owner's codes, what may become of a kept process."""

    failure: type[Failure]
    down: str
    """It is not started, busy, or being started again."""
    died: str
    """It ended, or said what nobody understands, while it was asked."""
    timed_out: str

    def failed(self, code: object, detail: object = "") -> Failure:
        """Return the failure of a code, whoever sent it; ``down`` where it is none of ours."""
        ours = isinstance(code, str) and code in self.failure.reasons
        return self.failure(str(code) if ours else self.down, str(detail))
