"""Begin a process's log: lines for people, or with ``PONS_LOG=json`` one JSON object a line.

The environment says it, so that every process of one robot does alike. Standard library alone.
"""

from __future__ import annotations

import json
import logging
import os
from datetime import UTC, datetime

VARIABLE = "PONS_LOG"
FORMAT = "%(asctime)s %(name)s %(levelname)s %(message)s"


class JsonLines(logging.Formatter):
    """Write a record as one JSON object: time in UTC, level, logger, message, error."""

    def format(self, record: logging.LogRecord) -> str:
        """Return the line."""
        told = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat("T", "milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
        }
        if record.exc_info:
            told["error"] = self.formatException(record.exc_info)
        return json.dumps(told, ensure_ascii=False)


def begin_log() -> None:
    """Log from INFO on to standard error, in the form that the environment asks for."""
    logging.basicConfig(level=logging.INFO, format=FORMAT)
    if os.environ.get(VARIABLE) == "json":
        for handler in logging.getLogger().handlers:
            handler.setFormatter(JsonLines())
