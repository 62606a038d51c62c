"""Write planner/language/script_table.py from OpenCC's table of characters.

Run once, by hand, when the table is to follow a newer OpenCC:

    pip download --no-deps --no-binary :all: opencc-python-reimplemented==0.1.7
    tar xzf opencc-python-reimplemented-0.1.7.tar.gz
    python scripts/script_table.py .../opencc/dictionary/TSCharacters.txt

Each line of the input is a traditional character, a tab, and its simplified forms by frequency.
"""

from __future__ import annotations

import sys
from pathlib import Path

OUT = Path(__file__).resolve().parents[1] / "planner" / "language" / "script_table.py"
PER_LINE = 44
# What OpenCC leaves to its tables of phrases, or counts as no matter of script, and what people
# write in orders all the same: forms of one word that a reader of either script takes for one.
SPELLINGS = {"著": "着", "妳": "你", "牠": "它", "乾": "干", "剎": "刹", "煞": "刹", "週": "周",
             "衹": "只", "祇": "只", "佢": "他"}  # fmt: skip
HEADER = '''"""Map each traditional Chinese character to its simplified form. Generated.

Written by scripts/script_table.py from TSCharacters.txt of OpenCC (Carbo Kuo and others,
Apache-2.0), as opencc-python-reimplemented 0.1.7 carries it, with the spellings that the script
names. Characters outside the basic plane are left out. {count} pairs, in the same order.
"""

from __future__ import annotations
'''


def read_pairs(text: str) -> dict[str, str]:
    """Return traditional to simplified, the most frequent form of each."""
    pairs: dict[str, str] = {}
    for line in text.splitlines():
        traditional, _, forms = line.partition("\t")
        simplified = forms.split()[0] if forms.split() else ""
        if len(traditional) == len(simplified) == 1 and max(traditional, simplified) <= "\uffff":
            pairs[traditional] = simplified
    pairs.update(SPELLINGS)
    return {key: value for key, value in sorted(pairs.items()) if key != value}


def render(name: str, characters: str) -> str:
    """Return one string constant, wrapped."""
    rows = [characters[i : i + PER_LINE] for i in range(0, len(characters), PER_LINE)]
    return f"{name} = (\n" + "".join(f'    "{row}"\n' for row in rows) + ")\n"


def main(source: Path) -> None:
    """Write the table anew."""
    pairs = read_pairs(source.read_text(encoding="utf-8"))
    body = (
        render("TRADITIONAL", "".join(pairs)) + "\n" + render("SIMPLIFIED", "".join(pairs.values()))
    )
    OUT.write_text(f"{HEADER.format(count=len(pairs))}\n{body}", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
