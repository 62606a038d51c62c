"""Load the owner's settings once, at the start. Unknown or contradictory ones refuse to start.

Nothing but a model setting switches a model on: `[model]` in settings.toml, PONS_MODEL_URL or
PONS_MODEL_PRESET. Keys that other programs use (OPENAI_API_KEY and the like) are never looked at.
"""

from __future__ import annotations

import logging
import tomllib
from collections.abc import Mapping
from pathlib import Path
from stat import S_IMODE
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, SecretStr, ValidationError

from planner.plan.tool import ServerName
from planner.settings.budget import BudgetSettings, DayLimits, GoalLimits, Price, contradiction
from planner.settings.limits import LimitSettings
from planner.settings.memory import MemorySettings
from planner.settings.mission import MissionSettings
from planner.settings.model import ModelSettings
from planner.settings.model_address import same_place
from planner.settings.model_prices import find_published_price
from planner.settings.mqtt import MqttSettings
from planner.settings.orders import NotifySettings, OrderSettings
from planner.settings.presets import known_as
from planner.settings.tools import ToolServerSettings, judge_servers, server_tables
from planner.settings.vision import VisionSettings, with_environment
from planner.settings.voice import SpeechSettings, VoiceSettings
from wire import ConfigError
from wire.file_trouble import find_broken_line

log = logging.getLogger(__name__)

FILE = "settings.toml"
MAX_BYTES = 16_000
"""A parser is busy for seconds with 64 kB of one dotted key."""
MAX_KEY_BYTES = 8 * 1024
_KEYED = ("model", "voice", "speech")
KEY_SOURCES = ("key", "key_env", "key_file")
_YES = {"1": True, "true": True, "yes": True, "0": False, "false": False, "no": False}


class Settings(BaseModel):
    """Hold all that the owner has set."""

    model_config = ConfigDict(frozen=True, extra="forbid", hide_input_in_errors=True)

    model: ModelSettings | None = None
    """None: the offline brain alone."""
    budget: BudgetSettings = BudgetSettings()
    mission: MissionSettings = MissionSettings()
    memory: MemorySettings = MemorySettings()
    vision: VisionSettings = VisionSettings()
    voice: VoiceSettings = VoiceSettings()
    speech: SpeechSettings = SpeechSettings()
    orders: OrderSettings = OrderSettings()
    mqtt: MqttSettings | None = None
    """None: the robot joins no smart home."""
    limits: LimitSettings = LimitSettings()
    tools: Annotated[dict[ServerName, ToolServerSettings], Field(max_length=16)] = {}
    """Servers that a brain with a model may ask, each by the owner's name for it."""


def load_settings(home: Path, environment: Mapping[str, str]) -> Settings:
    """Read settings.toml of a home folder, then what the environment puts in its place.

    Raises:
        ConfigError: ``settings_unreadable``, ``settings_malformed``, ``model_incomplete``,
            ``model_key``, ``voice_key``, ``speech_key``, ``tools_…``, ``budget_contradictory``.
    """
    tables = _tables(home)
    for sentence in find_exposed(home):
        log.warning("settings_exposed: %s", sentence)
    return judge_tables(tables, home, environment)


def judge_tables(given: Mapping[str, Any], home: Path, environment: Mapping[str, str]) -> Settings:
    """Return the settings that the tables of a settings.toml stand for.

    Raises:
        ConfigError: as ``load_settings``.
    """
    tables = dict(given)
    model = tables.pop("model", None)
    if model is not None and not isinstance(model, dict):
        raise ConfigError("settings_malformed", f"{FILE}: [model] must be a table")
    chosen = _with_environment(
        None if model is None else _with_key("model", model, home, environment), environment
    )
    vision = with_environment(tables.pop("vision", {}), home, environment)
    spoken = {
        name: _with_key(name, table, home, environment)
        for name in ("voice", "speech")
        if isinstance(table := tables.get(name), dict)
    }
    folder = spoken.get("voice", {}).get("folder")
    if isinstance(folder, str):
        spoken["voice"]["folder"] = home / folder
    own = server_tables(tables)
    servers = {name: _with_key("tools", own[name], home, environment) for name in own}
    tools = {"tools": {**tables["tools"], **servers}} if servers else {}
    settings = _check({**tables, **spoken, **tools, "model": chosen, "vision": vision})
    _need_key(settings.model)
    judge_servers(settings.tools)
    return settings


def find_exposed(home: Path) -> list[str]:
    """List the settings that others may change, or read though they are a key; mostly none.

    Raises:
        ConfigError: ``settings_unreadable``, ``settings_malformed``.
    """
    given = _tables(home)
    keyed = (*map(given.get, _KEYED), *server_tables(given).values())
    tables = [table for table in keyed if isinstance(table, dict)]
    files = [(home / FILE, any("key" in table for table in tables))]
    apart = (table.get("key_file") for table in tables)
    files += [(home / name, True) for name in apart if isinstance(name, str) and name]
    return [text for path, keyed in files if (text := _exposure(path, keyed=keyed)) is not None]


def list_keys(settings: BaseModel) -> tuple[str, ...]:
    """Return every key that is set, so that none of them is ever shown."""
    found: list[str] = []
    for name in type(settings).model_fields:
        value = getattr(settings, name)
        if isinstance(value, SecretStr):
            found.append(value.get_secret_value())
        for part in value.values() if isinstance(value, dict) else (value,):
            found += list_keys(part) if isinstance(part, BaseModel) else ()
    return tuple(found)


def _exposure(path: Path, *, keyed: bool) -> str | None:
    try:
        mode = S_IMODE(path.stat().st_mode)
    except OSError:
        return None
    if mode & 0o022:
        return f"{path} has mode {mode:04o}: others can change it, and where a key is sent"
    if keyed and mode & 0o044:
        return f"{path} has mode {mode:04o}: others can read the key in it"
    return None


def place_of(home: Path, environment: Mapping[str, str]) -> str:
    """Return the URL that file and environment lead to, empty where to none; no key is read.

    Raises:
        ConfigError: ``settings_unreadable``, ``settings_malformed``.
    """
    model = _tables(home).get("model")
    table = {k: v for k, v in model.items() if k != "key"} if isinstance(model, dict) else {}
    preset, url = (environment.get(f"PONS_MODEL_{n}", "") for n in ("PRESET", "URL"))
    return _place(_at_another_place(table, preset, url))


def _tables(home: Path) -> dict[str, Any]:
    return parse_settings(read_file(home / FILE), home / FILE)


def read_file(path: Path) -> bytes:
    """Return what settings.toml holds, or one byte more than it may; nothing where there is none.

    Raises:
        ConfigError: ``settings_unreadable``.
    """
    if not path.exists():
        return b""
    try:
        with path.open("rb") as file:
            return file.read(MAX_BYTES + 1)
    except OSError as error:
        raise ConfigError("settings_unreadable", f"{path}: {error.strerror}") from None


def parse_settings(raw: bytes, path: Path) -> dict[str, Any]:
    """Return the tables of a settings.toml.

    Raises:
        ConfigError: ``settings_malformed``.
    """
    if len(raw) > MAX_BYTES:
        raise ConfigError("settings_malformed", f"{path} is over {MAX_BYTES} bytes")
    try:
        return tomllib.loads(raw.decode("utf-8-sig"))
    except (ValueError, RecursionError) as error:  # of a number of thousands of digits, too
        # The parser's own words may quote the line that holds a key: its number alone is told.
        place = find_broken_line(error)
        raise ConfigError("settings_malformed", f"{path} is no TOML in UTF-8{place}") from None


def _with_key(
    table: str, given: dict[str, Any], home: Path, environment: Mapping[str, str]
) -> dict[str, Any]:
    """Put the key itself in the place of where it lies."""
    code = f"{table}_key"
    sources = [name for name in KEY_SOURCES if name in given]
    if len(sources) > 1:
        raise ConfigError(code, f"{FILE}: give one of {', '.join(sources)}, not all")
    rest = {name: value for name, value in given.items() if name not in KEY_SOURCES}
    if not sources:
        return rest
    source, value = sources[0], given[sources[0]]
    if not isinstance(value, str) or not value:
        raise ConfigError(code, f"{FILE}: {source} must be a text that is not empty")
    key = {"key": lambda: value, "key_env": lambda: environment.get(value, "")}.get(
        source, lambda: _key_in(code, home / value)
    )()
    return {**rest, "key": _clean_key(code, key, f"{FILE}: {source}")}


def _key_in(code: str, path: Path) -> str:
    try:
        with path.open("rb") as file:
            return file.read(MAX_KEY_BYTES).decode("ascii", "replace")
    except OSError as error:
        raise ConfigError(code, f"key_file {path}: {error.strerror}") from None


def _clean_key(code: str, key: str, where: str) -> str:
    """Return a key that can stand in a header. Its text is never part of an error."""
    key = key.strip()
    if not key:
        raise ConfigError(code, f"{where} leads to no key")
    if not (key.isascii() and key.isprintable() and " " not in key):
        raise ConfigError(code, f"{where}: a key is one word of plain ASCII")
    return key


def _with_environment(
    model: dict[str, Any] | None, environment: Mapping[str, str]
) -> dict[str, Any] | None:
    """Let PONS_MODEL_PRESET, _URL, _KEY, both yeses and PONS_MODEL, the name, win."""
    preset, url, key = (environment.get(f"PONS_MODEL_{n}", "") for n in ("PRESET", "URL", "KEY"))
    name = environment.get("PONS_MODEL", "")
    if model is None and not (url or preset):
        if name or key:
            detail = "PONS_MODEL or PONS_MODEL_KEY is set, but no PONS_MODEL_URL and no [model]"
            raise ConfigError("model_incomplete", detail)
        return None
    chosen = _at_another_place(dict(model or {}), preset, url)
    if name:
        chosen["name"] = name
    if key:
        chosen["key"] = _clean_key("model_key", key, "PONS_MODEL_KEY")
    for yes in ("allow_offhost", "allow_pictures_offhost"):
        said = environment.get(variable := f"PONS_MODEL_{yes.upper()}", "").lower()
        if said and said not in _YES:
            raise ConfigError("settings_malformed", f"{variable} is {said!r}; expected 1 or 0")
        if said:
            chosen[yes] = _YES[said]
    return chosen


def _at_another_place(model: dict[str, Any], preset: str, url: str) -> dict[str, Any]:
    """Put the environment's server in place of the file's.

    What was given to the file's host stays behind: its key, and the yes to pictures.
    """
    moved = dict(model)
    if preset:
        moved["preset"] = preset
        moved.pop("url", None)  # it was the file's server; the preset brings its own
    if url:
        moved["url"] = url
    if same_place(_place(model), _place(moved)):
        return moved
    if "key" in moved:
        # The key belongs to the host that it was written down for.
        log.warning("the key in %s is not used: the environment names another host", FILE)
        del moved["key"]
    moved.pop("allow_pictures_offhost", None)
    return moved


def _place(model: dict[str, Any]) -> str:
    """Return the URL of a model's table: its own, else its preset's."""
    preset = known_as(model.get("preset"))
    return str(model.get("url", preset.url if preset is not None else ""))


def _check(tables: dict[str, Any]) -> Settings:
    try:
        settings = Settings.model_validate(tables)
    except ValidationError as wrong:
        problems = [
            _describe_error(error["loc"], error["type"], error["msg"]) for error in wrong.errors()
        ]
        code = "model_incomplete" if all("missing" in p for p in problems) else "settings_malformed"
        raise ConfigError(code, f"{FILE}: {'; '.join(problems)}") from None
    settings = with_published_price(settings, settings.model)
    most = settings.model.max_tokens if settings.model is not None else None
    wrong_budget = contradiction(settings.budget, most)
    if wrong_budget is not None:
        raise ConfigError("budget_contradictory", f"{FILE}: {wrong_budget}")
    return settings


def with_published_price(settings: Settings, model: ModelSettings | None) -> Settings:
    """Return settings in which a model costs what its server publishes, unless the owner says."""
    if model is None or settings.budget.price is not None:
        return settings
    price = find_published_price(model.url, model.name)
    budget = settings.budget.model_copy(update={"price": price})
    return settings.model_copy(update={"budget": budget})


def _need_key(model: ModelSettings | None) -> None:
    """Refuse a server that is known to want a key where the owner gave none."""
    known = model.known_preset if model is not None else None
    if model is None or known is None or not known.key_name or model.key is not None:
        return
    if same_place(model.url, known.url):
        raise ConfigError(
            "model_key",
            f"{model.preset} wants a key: put key_file, or key_env = {known.key_name!r}, into "
            f"[model] of {FILE}, or set PONS_MODEL_KEY",
        )


_TABLES: dict[str, type[BaseModel]] = {
    "": Settings, "model": ModelSettings, "mission": MissionSettings, "memory": MemorySettings,
    "vision": VisionSettings, "voice": VoiceSettings, "speech": SpeechSettings,
    "orders": OrderSettings, "orders.notify": NotifySettings, "mqtt": MqttSettings,
    "budget": BudgetSettings, "budget.goal": GoalLimits, "budget.day": DayLimits,
    "budget.price": Price, "limits": LimitSettings, "tools": ToolServerSettings,
}  # fmt: skip


def _table(where: tuple[int | str, ...]) -> str:
    return "tools" if where[0] == "tools" else ".".join(map(str, where[:-1]))


def _describe_error(where: tuple[int | str, ...], kind: str, text: str) -> str:
    name = ".".join(map(str, where))
    if kind == "extra_forbidden":
        known = _TABLES[table].model_fields if (table := _table(where)) in _TABLES else {}
        told = (each for field in known for each in (KEY_SOURCES if field == "key" else (field,)))
        return f"unknown key {name!r}; known: {', '.join(told)}"
    return f"{name} is missing" if kind == "missing" else f"{name}: {text}"
