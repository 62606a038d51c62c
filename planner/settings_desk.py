"""Show the owner's settings to the page, and change them: judged, written whole, noted by whom.

settings.toml stays the one place where settings are. What is saved here was judged as a start would
judge it, so that the next start refuses nothing that a page has saved. All of it blocks on the
disk.
"""

from __future__ import annotations

import hashlib
import logging
import threading
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, SecretStr

from planner.orders.zone import find_zone
from planner.outbound import Address
from planner.outbound.reach import trouble_reaching
from planner.plan import QuietHours
from planner.settings import FILE, Settings, judge_tables, with_published_price
from planner.settings.file_edit import Value, edit_text, replace_settings
from planner.settings.loader import parse_settings, read_file
from planner.settings.model_address import need_local_or_allowed
from planner.settings.page_fields import MAX_TEXT, PAGE_FIELDS, FieldKind, PageField
from planner.voice.sherpa_model import open_model
from planner.voice.speech_engines import open_speech
from planner.voice.transcription import open_caller
from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from planner.state_database import StateDatabase

log = logging.getLogger(__name__)

MOST_NOTED = 200
"""Changes that are remembered; the page shows the newest few."""
SHOWN_CHANGES = 5
OUT_OF_RANGE, UNKNOWN, CHANGED = "settings_out_of_range", "settings_unknown", "settings_changed"
MALFORMED, ELSEWHERE = "settings_malformed", "settings_elsewhere"


class SettingsRefusal(Exception):
    """A change can't be made, and nothing was; ``code`` is stable."""

    def __init__(self, code: str, detail: str, **said: str) -> None:
        """Keep what the sentence for a person needs."""
        super().__init__(f"{code}: {detail}")
        self.code, self.detail, self.said = code, detail, said


class SettingsDesk:
    """Hold the settings of one home: those in force and those on the disk."""

    def __init__(
        self,
        home: Path,
        environment: Mapping[str, str],
        in_force: Settings,
        database: StateDatabase,
        *,
        robot_mps: float = 2.0,
        adopt: Callable[[Settings], None] = lambda _: None,
        clock: Callable[[], datetime] = lambda: datetime.now(UTC),
    ) -> None:
        """Take the settings that this planner was started with.

        Args:
            home: where settings.toml is.
            environment: what stands before the file.
            in_force: as this planner was started.
            database: where changes are noted.
            robot_mps: the robot's own speed limit; a lower one alone can be set.
            adopt: brings into force at once what can be.
            clock: tells when a change was made.
        """
        self._home, self._environment, self._database = home, environment, database
        self._in_force, self._adopt, self._clock = in_force, adopt, clock
        self.robot_mps = robot_mps
        self._lock = threading.Lock()

    def view(self) -> dict[str, Any]:
        """Return every setting with its value, where it comes from, and whether it is in force.

        Raises:
            ConfigError: settings.toml was changed by hand and can't be read now.
        """
        raw = read_file(self._home / FILE)
        tables = parse_settings(raw, self._home / FILE)
        saved = judge_tables(tables, self._home, self._environment)
        return {
            "revision": _revision(raw),
            "fields": [self._show(field, tables, saved) for field in PAGE_FIELDS.values()],
            "changes": self._list_changes(),
        }

    def change(self, revision: str, changes: Mapping[str, Value], by: str) -> dict[str, Any]:
        """Save changes, all or none, and return the view after it.

        Args:
            revision: of the view that the person saw.
            changes: a value by each name; None takes one away.
            by: who asks, for the record.

        Raises:
            SettingsRefusal: with a code of its own, nothing was changed.
            ConfigError: a start would refuse the settings as they would be; nothing was changed.
            OSError: the disk refuses.
        """
        fields = {self._field(name, value): value for name, value in changes.items()}
        with self._lock:
            path = self._home / FILE
            raw = read_file(path)
            if _revision(raw) != revision:
                raise SettingsRefusal(CHANGED, "settings.toml was changed since it was shown")
            parse_settings(raw, path)  # tomlkit would quote a line that may hold a key
            try:
                text = edit_text(raw.decode("utf-8-sig"), fields)
            except (ValueError, TypeError) as error:
                raise SettingsRefusal(MALFORMED, f"{FILE} is written otherwise: {error}") from None
            after = text.encode()
            tables = parse_settings(after, path)
            saved = judge_tables(tables, self._home, self._environment)
            refuse_unstartable(saved, self._environment)
            names = sorted(changes)
            with self._database.change() as connection:
                connection.execute(
                    "INSERT INTO settings_changes (at, by, names) VALUES (?, ?, ?)",
                    (self._clock().isoformat("T", "seconds"), by, " ".join(names)),
                )
                connection.execute(
                    "DELETE FROM settings_changes WHERE position <= "
                    "(SELECT max(position) FROM settings_changes) - ?",
                    (MOST_NOTED,),
                )
                replace_settings(path, raw, after)
            log.info("settings changed by %s: %s", by, ", ".join(names))
            self._bring_into_force(saved, has_price="price" in tables.get("budget", {}))
        return self.view()

    def model_to_test(self, url: str | None) -> tuple[str, Address]:
        """Return the name and the address of the model that is saved, or of one that is typed.

        Raises:
            SettingsRefusal: ``model_unset``: there is none.
            ConfigError: ``model_url``: nothing may be asked there; or the file can't be read.
        """
        if url:
            return "", Address.parse(url)
        raw = read_file(self._home / FILE)
        tables = parse_settings(raw, self._home / FILE)
        model = judge_tables(tables, self._home, self._environment).model
        if model is None:
            raise SettingsRefusal("model_unset", "no model is set")
        return model.name, Address.parse(model.url)

    def _bring_into_force(self, saved: Settings, *, has_price: bool) -> None:
        if not has_price:  # the saved model's, while the one of before is asked until a start
            bare = saved.budget.model_copy(update={"price": None})
            saved = with_published_price(
                saved.model_copy(update={"budget": bare}), self._in_force.model
            )
        self._adopt(saved)
        self._in_force = self._in_force.model_copy(update={"budget": saved.budget})

    def _field(self, name: str, value: Value) -> PageField:
        """Return the setting of a name, if a value fits it.

        Raises:
            SettingsRefusal: ``settings_unknown`` or ``settings_out_of_range``.
        """
        field = PAGE_FIELDS.get(name)
        if field is None:
            detail = f"{name[:80]!r} is no setting of the page; known: {', '.join(PAGE_FIELDS)}"
            raise SettingsRefusal(UNKNOWN, detail, name=name[:80])
        if value is None:
            return field
        if self._environment.get(field.variable, ""):
            detail = f"{field.variable} is set and stands before the file"
            raise SettingsRefusal(ELSEWHERE, detail, name=name, variable=field.variable)
        if not _fits(field, value, self._upper_bound(field)):
            expected = self._describe_fit(field)
            detail = f"{name}: expected {expected}"
            raise SettingsRefusal(OUT_OF_RANGE, detail, name=name, expected=expected)
        return field

    def _upper_bound(self, field: PageField) -> float:
        own = field.name == "limits.max_speed_mps"
        return min(field.most, self.robot_mps) if own else field.most

    def _describe_fit(self, field: PageField) -> str:
        match field.kind:
            case FieldKind.YES:
                return "true / false"
            case FieldKind.NUMBER:
                return f"{field.least:g} … {self._upper_bound(field):g}"
            case FieldKind.CHOICE:
                return " / ".join(field.choices)
            case _:
                return f"1 … {MAX_TEXT}"

    def _show(self, field: PageField, tables: Mapping[str, Any], saved: Settings) -> dict[str, Any]:
        in_file = _from_tables(tables, field)
        value, in_force = _value(saved, field), _value(self._in_force, field)
        is_secret = field.kind is FieldKind.SECRET
        source = "file" if in_file else "default"
        if self._environment.get(field.variable, ""):
            source = "environment"
        return {
            "name": field.name,
            "group": field.group,
            "kind": field.kind,
            "value": None if is_secret else _plain(value),
            "is_set": value is not None if is_secret else in_file,
            "source": source,
            "choices": list(field.choices),
            "least": field.least if field.kind is FieldKind.NUMBER else None,
            "most": self._upper_bound(field) if field.kind is FieldKind.NUMBER else None,
            "in_force": "at_once" if field.at_once else "next_start",
            "is_pending": value != in_force,
        }

    def _list_changes(self) -> list[dict[str, Any]]:
        query = "SELECT at, by, names FROM settings_changes ORDER BY position DESC LIMIT ?"
        try:
            rows = self._database.read(query, (SHOWN_CHANGES,))
        except (OSError, ConfigError):
            rows = []  # the database of an older planner, or of none
        return [{"at": at, "by": by, "names": names.split()} for at, by, names in rows]


def refuse_unstartable(settings: Settings, environment: Mapping[str, str]) -> None:
    """Refuse what a planner judges only as it starts.

    Raises:
        ConfigError: with the code that the start would give.
    """
    if settings.model is not None:
        need_local_or_allowed(settings.model)
    open_caller(settings.voice)
    open_model(settings.voice)
    open_speech(settings.speech)
    find_zone(settings.orders.timezone, environment)
    if settings.orders.notify is not None:
        Address.parse(settings.orders.notify.url, "", "orders.notify")


def reach(name: str, address: Address) -> dict[str, Any]:
    """Connect to a model's server and tell how it went; nothing is sent, so nothing is spent."""
    trouble = trouble_reaching(address)
    where = f"{address.host}:{address.port}"
    return {"name": name, "where": where, "is_reached": trouble is None, "trouble": trouble}


def _revision(raw: bytes) -> str:
    return hashlib.sha256(raw).hexdigest()[:16]


def _from_tables(tables: Mapping[str, Any], field: PageField) -> bool:
    found: Any = tables
    for name in field.path:
        if not isinstance(found, dict) or name not in found:
            return False
        found = found[name]
    return True


def _value(settings: Settings, field: PageField) -> Any:
    """Return a setting's value, a default too; None where its table is not there."""
    found: Any = settings
    for name in field.path:
        if not isinstance(found, BaseModel):
            return None
        found = getattr(found, name)
    return found


def _plain(value: Any) -> Value:
    match value:
        case None | bool() | int() | float():
            return value
        case QuietHours():
            return value.text.replace("–", "-")
        case SecretStr():
            return None
        case _:
            return str(value)


def _fits(field: PageField, value: Value, most: float) -> bool:
    match field.kind:
        case FieldKind.YES:
            return isinstance(value, bool)
        case FieldKind.NUMBER:
            is_number = isinstance(value, int if field.is_whole else (int, float))
            return is_number and not isinstance(value, bool) and field.least <= value <= most  # type: ignore[operator]
        case FieldKind.CHOICE:
            return value in field.choices
        case _:
            return (
                isinstance(value, str)
                and 0 < len(value.strip()) <= MAX_TEXT
                and value.isprintable()
            )
