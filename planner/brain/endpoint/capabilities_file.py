"""Remember what servers take in a file of the home folder; what can't be read is found out anew."""

from __future__ import annotations

import hashlib
import json
import logging
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from planner.brain.endpoint.server_capabilities import Dialect
from planner.settings import ModelSettings

log = logging.getLogger(__name__)

FILE = "model_dialects.json"
MAX_BYTES = 256 * 1024
MAX_KEPT = 50
_SHAPE = TypeAdapter(Dialect)


class Dialects:
    """Hold the dialect of one URL and model."""

    def __init__(self, home: Path, settings: ModelSettings, url: str) -> None:
        self._path = home / FILE
        self._key = hashlib.sha256(f"{url}\n{settings.name}".encode()).hexdigest()[:24]
        first = Dialect.first(settings)
        known = _read(self._all().get(self._key))
        self.kept = known is not None
        """The server is known to have taken this."""
        self._now = first if known is None else known
        if first.fixed:
            self._now = replace(self._now, mode=first.mode, fixed=True)

    @property
    def now(self) -> Dialect:
        """Return how to ask."""
        return self._now

    def keep(self, dialect: Dialect) -> None:
        """Remember what the server took. A disk that refuses costs a call at the next start."""
        if dialect == self._now and self.kept:
            return
        self._now, self.kept = dialect, True
        kept = {k: v for k, v in self._all().items() if k != self._key}
        kept = dict([*kept.items()][-(MAX_KEPT - 1) :])
        kept[self._key] = asdict(replace(dialect, fixed=False))
        fresh = self._path.with_suffix(".new")
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            fresh.write_text(json.dumps(kept, indent=1) + "\n", "utf-8")
            fresh.replace(self._path)
        except OSError as error:
            log.warning("%s could not be written: %s", self._path, error.strerror)

    def _all(self) -> dict[str, Any]:
        try:
            with self._path.open("rb") as file:
                found = json.loads(file.read(MAX_BYTES))
        except (OSError, ValueError, RecursionError):
            return {}
        return found if isinstance(found, dict) else {}


def _read(known: object) -> Dialect | None:
    try:
        return replace(_SHAPE.validate_python(known), fixed=False)
    except ValidationError:
        return None
