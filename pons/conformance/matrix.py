"""Write the matrix: as text for a terminal, as markdown for docs, as JSON for machines."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from pons.conformance.runner import COLUMNS

if TYPE_CHECKING:
    from pons.conformance.runner import MatrixRow
    from pons.conformance.verdict import MatrixCell

NOT_JUDGED = "NOT JUDGED"
BEGIN, END = "<!-- matrix: begin -->", "<!-- matrix: end -->"


@dataclass(frozen=True, slots=True)
class Origin:
    """Name a matrix's bridge, site, commit, date, machine and seed."""

    bridge: str
    site: str
    commit: str
    date: str
    machine: str
    seed: int

    def line(self) -> str:
        """Return it in a line."""
        return (
            f"bridge {self.bridge}, site {self.site}, commit {self.commit}, {self.date}, "
            f"seed {self.seed}; {self.machine}"
        )


def text_of(cell: MatrixCell) -> str:
    """Return a cell as text."""
    if cell.ok is not False:
        return cell.figure
    return f"{'FAIL' if cell.judged else NOT_JUDGED} {cell.figure}"


def one_line(line: MatrixRow, number: int, count: int, at_s: float) -> str:
    """Return a row as it is told while the kit runs."""
    bad = [f"{name}: {cell.figure}" for name, cell in line.cells.items() if cell.ok is False]
    verdict = _verdict(failed=line.has_failed, passed=line.has_passed)
    stood = line.cells["stands"].figure
    rest = "; ".join(bad) or (f"stood in {stood}" if stood != "-" else "")
    return f"{number:3}/{count} {at_s:4.0f} s  {verdict}  {line.brain:9} {line.fault:18} {rest}"


def table(lines: list[MatrixRow]) -> str:
    """Return the matrix aligned for a terminal."""
    head = ("brain", "fault", *COLUMNS)
    rows = [head, *((one.brain, one.fault, *_cells(one)) for one in lines)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(head))]
    rule = tuple("-" * width for width in widths)
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in (rows[0], rule, *rows[1:])
    )


def tries(lines: list[MatrixRow]) -> str:
    """Tell of each try that failed, a line each; nothing where none did."""
    return "".join(
        f"- {line.brain} {line.fault}, try {number}: {failed}\n"
        for line in lines
        for number, failed in enumerate(line.tried, 1)
    )


def markdown(lines: list[MatrixRow], origin: Origin) -> str:
    """Return the matrix for a page."""
    head = ("brain", "fault", "what it does", *COLUMNS)
    rows = [head, ("---",) * len(head)]
    rows += [(one.brain, f"`{one.fault}`", one.what, *_cells(one)) for one in lines]
    body = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    told = "".join(f"{part}\n" for part in (body, tries(lines)) if part)
    return f"{origin.line()}.\n\n{summary(lines)}\n\n{told}"


def summary(lines: list[MatrixRow]) -> str:
    """Count rows and cells."""
    cells = [cell for line in lines for cell in line.cells.values() if cell.ok is not None]
    failed = sum(cell.ok is False and cell.judged for cell in cells)
    bad = sum(line.has_failed for line in lines)
    open_rows = sum(not (line.has_failed or line.has_passed) for line in lines)
    rows = f"{len(lines)} rows, {bad} failed" + (f", {open_rows} not judged" if open_rows else "")
    verdict = _verdict(failed=bad > 0 or not lines, passed=not open_rows)
    return f"{rows}; {len(cells)} cells measured, {failed} failed: {verdict}"


def _verdict(*, failed: bool, passed: bool) -> str:
    return "FAIL" if failed else "PASS" if passed else NOT_JUDGED


def into_page(page: str, matrix: str) -> str:
    """Put a matrix between the marks of a page. Raises ValueError where it has none."""
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not (begin and end):
        raise ValueError(f"the page has no {BEGIN} … {END}")
    return f"{before}{BEGIN}\n{matrix}{END}{after}"


def record(lines: list[MatrixRow], origin: Origin) -> dict[str, Any]:
    """Return all of it as JSON can hold it."""
    return {
        "origin": asdict(origin),
        "passed": bool(lines) and all(line.has_passed for line in lines),
        "rows": [
            {**asdict(line), "passed": line.has_passed, "failed": line.has_failed} for line in lines
        ],
    }


def _cells(line: MatrixRow) -> tuple[str, ...]:
    return tuple(text_of(line.cells[name]) for name in COLUMNS)
