"""Print the bridge's words for the page, web/src/i18n/rows.json and codes.json, from its tables.

``python -m scripts.page_words`` writes them, with ``--check`` it tells by its exit status whether
they are true. The page cannot import the tables, and a sentence kept twice would come apart.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from bridge.core.faults.code_messages import SENTENCES, WANTS
from bridge.core.faults.fault_messages import WORDS
from pons.robot.trial_words import STEPS
from scripts.generated_text import write_or_check

if TYPE_CHECKING:
    from collections.abc import Mapping

FOLDER = Path(__file__).resolve().parents[1] / "web" / "src" / "i18n"
ROWS, CODES = FOLDER / "rows.json", FOLDER / "codes.json"


def rows_json() -> str:
    """Return each row's sentence."""
    return _text(_both_languages(WORDS))


def codes_json() -> str:
    """Return what is said of each code that is no row, and of each step of a trial."""
    tables = {"sentences": SENTENCES, "wants": WANTS, "trial": STEPS}
    return _text({name: _both_languages(table) for name, table in tables.items()})


def _both_languages(table: Mapping[str, tuple[str, str]]) -> dict[str, dict[str, str]]:
    return {code: {"en": en, "zh": zh} for code, (en, zh) in table.items()}


def _text(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, indent=2) + "\n"


def main(arguments: list[str]) -> int:
    """Write or check both; 1 where one is stale."""
    return write_or_check(
        {ROWS: rows_json(), CODES: codes_json()}, arguments, "`python -m scripts.page_words`"
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
