"""List the settings that the page shows and changes: names, kinds, bounds. Data only.

A name is the table's and the key's of settings.toml. What stands here can be saved by a person who
sees neither the file nor the log, so paths of files and whatever needs a look at the machine stay
with settings.toml.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from planner.settings.presets import PresetName

MAX_TEXT = 2000
"""Characters of a text; a URL has no more."""
TABLE_NEEDS = {"model": "name", "orders.notify": "url"}
"""Tables that are nothing without this key: where it is taken away, the table goes."""


class FieldKind(StrEnum):
    """Name how a setting is shown and typed."""

    TEXT = "text"
    SECRET = "secret"
    """Written and never told again: a key, or an address whose path may be one."""
    YES = "yes"
    NUMBER = "number"
    CHOICE = "choice"


@dataclass(frozen=True, slots=True)
class PageField:
    """Describe one setting."""

    group: str
    name: str
    kind: FieldKind
    choices: tuple[str, ...] = ()
    least: float = 0.0
    most: float = 1e9
    is_whole: bool = False
    at_once: bool = False
    """In force as soon as it is saved; the others from the planner's next start on."""

    @property
    def path(self) -> tuple[str, ...]:
        """Return the tables and the key that lead to it."""
        return tuple(self.name.split("."))

    @property
    def variable(self) -> str:
        """Return the environment's variable that stands before the file; empty where none does."""
        if self.name == "model.name":
            return "PONS_MODEL"
        table, *rest = self.path
        is_known = self.group == "model" or table == "vision"
        return f"PONS_{table}_{'_'.join(rest)}".upper() if is_known else ""


_T, _S, _Y, _N, _C = (
    FieldKind.TEXT,
    FieldKind.SECRET,
    FieldKind.YES,
    FieldKind.NUMBER,
    FieldKind.CHOICE,
)
PAGE_FIELDS: dict[str, PageField] = {
    field.name: field
    for field in (
        PageField("model", "model.preset", _C, choices=tuple(PresetName)),
        PageField("model", "model.name", _T),
        PageField("model", "model.url", _T),
        PageField("model", "model.key", _S),
        PageField("model", "model.allow_offhost", _Y),
        PageField("eyes", "model.pictures", _Y),
        PageField("eyes", "model.allow_pictures_offhost", _Y),
        PageField("eyes", "vision.rate_hz", _N, least=1.0, most=30.0),
        PageField("eyes", "vision.search_pictures", _N, most=200, is_whole=True),
        PageField("voice", "speech.engine", _C, choices=("none", "espeak", "server")),
        PageField("voice", "speech.quiet", _T),
        PageField("voice", "speech.url", _T),
        PageField("voice", "speech.key", _S),
        PageField("voice", "speech.allow_offhost", _Y),
        PageField("voice", "voice.url", _T),
        PageField("voice", "voice.model", _T),
        PageField("voice", "voice.key", _S),
        PageField("voice", "voice.allow_offhost", _Y),
        PageField("limits", "limits.max_speed_mps", _N, least=0.05, most=2.0),
        PageField("notices", "orders.notify.url", _S),
        PageField("notices", "orders.notify.form", _C, choices=("webhook", "ntfy")),
        PageField("notices", "orders.notify.words", _Y),
        PageField("notices", "orders.quiet", _T),
        PageField("notices", "orders.timezone", _T),
        PageField("budget", "budget.goal.money", _N, at_once=True),
        PageField("budget", "budget.day.money", _N, at_once=True),
        PageField("budget", "budget.day.calls", _N, is_whole=True, at_once=True),
        PageField("budget", "budget.price.prompt_per_million", _N, at_once=True),
        PageField("budget", "budget.price.reply_per_million", _N, at_once=True),
        PageField("budget", "budget.price.currency", _T, at_once=True),
    )
}
