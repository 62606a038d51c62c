"""Send what openapi.json allows and what it forbids, and judge the answers by it (schemathesis).

Beside it, bodies that no schema would make: mutants of good JSON, sent to every route that takes
some. ``make attack`` installs the tool, an extra of its own; without it its part is skipped.
"""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
import time
from dataclasses import replace
from random import Random
from typing import TYPE_CHECKING, Any

from pons.settings import CHECKOUT
from tools.attack import target
from tools.attack.mutators import mutant
from tools.attack.outcome import AttackOutcome

if TYPE_CHECKING:
    from pathlib import Path

    from tools.attack.lab import AttackLab
    from tools.bench.robot import BenchRobot

NAME = "contract"
TITLE = "the HTTP contract: requests by openapi.json, and bodies of no schema"
CHECKS = {
    "not_a_server_error": "ServerError",
    "status_code_conformance": "UndefinedStatusCode",
    "content_type_conformance": "UndefinedContentType",
    "response_schema_conformance": "JsonSchemaError",
}
"""What schemathesis checks, and what it calls a failure of each."""
SETTINGS = """[checks]
not_a_server_error.expected-statuses = ["2xx", "3xx", "4xx", 503, 507]
"""
"""503 and 507 are said where a part is not there (no camera) or the disk is full."""
QUICK_EXAMPLES, LONG_EXAMPLES = 5, 300
QUICK_LIMIT_S, LONG_LIMIT_S = 240.0, 3_600.0
QUICK_BODIES_S, LONG_BODIES_S = 20.0, 600.0
MOST_BODY_BYTES = 8_192
GROWTH_MB = 30.0
"""Goals that were taken are kept, and so are their plans."""
UNAVAILABLE = 503
"""Said where a part is not there (no camera, no journal): an answer, and no crash."""
BODIES: tuple[dict[str, Any], ...] = (
    {"text": "go to the kitchen"}, {"text": "停下", "language": "zh", "source": "x"}, {},
    {"source": "attack"}, {"v_mps": 0.1, "w_radps": 0.0, "dead_man": True, "id": "a", "seq": 1},
    {"name": {"en": "a", "zh": "b"}, "pose": {"x_m": 1.0, "y_m": 1.0, "yaw_rad": 0.0}},
    {"fence": {"version": 1, "map_id": "0" * 16, "allowed": [[[0, 0], [1, 0], [1, 1]]]}},
    {"answer": "yes"}, {"confirm": True}, {"proof": {"nonce": "a.1", "mac": "0" * 64}},
)  # fmt: skip


def attack(lab: AttackLab) -> list[AttackOutcome]:
    """Attack one robot by schema, then by mutants."""
    with target.robot(lab) as running:
        found = _by_schema(lab, running)
        found.append(_by_mutants(lab, running))
        stopped = target.stop_confirmed(running) is not None
    return [*found, AttackOutcome("stop afterwards", 1, int(not stopped), "confirmed")]


def _by_schema(lab: AttackLab, running: BenchRobot) -> list[AttackOutcome]:
    if importlib.util.find_spec("schemathesis") is None:
        note = "schemathesis is not installed: make attack does that"
        return [AttackOutcome("by schema", 0, 0, "", note=note, skipped=True)]
    before_mb = target.planner_mb(running)
    with lab.folder() as folder:
        said, report = _schemathesis(lab, running, folder)
    after_mb = target.planner_mb(running)
    kept = lab.home / "contract.txt"
    kept.write_text(said, "utf-8")
    return judge_report(report, f"all in {kept}", before_mb, after_mb)


def judge_report(
    report: dict[str, Any] | None, where: str, before_mb: float, after_mb: float
) -> list[AttackOutcome]:
    """Return a line for each check of the tool's report; one that says it never ended without."""
    if report is None or not report.get("complete"):
        return [AttackOutcome("by schema", 0, 1, "ends", note=f"no whole report; {where}")]
    tried = int(report["test_cases"]["generated"])
    failures = {str(failure["type"]): failure for failure in report["failures"]}
    found: list[AttackOutcome] = []
    for check, kind in CHECKS.items():
        failure = failures.pop(kind, {"count": 0, "operations": []})
        wrong, operations = int(failure["count"]), failure["operations"]
        shown = ", ".join(operations[:4]) + (" …" if len(operations) > 4 else "")
        note = f"{shown}; {where}" if wrong else ""
        found.append(AttackOutcome(check, tried, wrong, "0", note=note))
    found[0] = replace(found[0], before_mb=before_mb, after_mb=after_mb, growth_mb=GROWTH_MB)
    for kind, failure in failures.items():
        found.append(AttackOutcome(kind, tried, int(failure["count"]), "0", note=where))
    return found


def _schemathesis(
    lab: AttackLab, running: BenchRobot, folder: Path
) -> tuple[str, dict[str, Any] | None]:
    """Run the tool; return what it said, and its report."""
    count = LONG_EXAMPLES if lab.long else QUICK_EXAMPLES
    limit_s = LONG_LIMIT_S if lab.long else QUICK_LIMIT_S
    report, settings = folder / "report.json", folder / "schemathesis.toml"
    settings.write_text(SETTINGS, "utf-8")
    command = [
        sys.executable, "-m", "schemathesis.cli", "--config-file", str(settings), "run",
        str(CHECKOUT / "openapi.json"), "--url", running.settings.url,
        "--checks", ",".join(CHECKS), "--max-examples", str(count), "--seed", str(lab.seed),
        "--request-timeout", "10", "--phases", "examples,coverage,fuzzing", "--mode", "all",
        "--exclude-path", "/v1/voice", "--continue-on-failure", "--generation-database", "none",
        "--no-color", "--report", "json", "--report-json-path", str(report),
    ]  # fmt: skip
    environment = {**os.environ, "HYPOTHESIS_STORAGE_DIRECTORY": str(folder)}
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder,
                              timeout=limit_s, env=environment)  # fmt: skip
    except subprocess.TimeoutExpired as late:
        return f"not ended after {limit_s:.0f} s: {late.stdout!r}", None
    told = json.loads(report.read_text("utf-8")) if report.exists() else None
    return done.stdout + done.stderr, told


def _by_mutants(lab: AttackLab, running: BenchRobot) -> AttackOutcome:
    """Send mutated bodies of JSON to every route that takes some."""
    paths = [path for path in taking_json() if path != "/v1/stop"]
    seeds, random = (
        [json.dumps(body, ensure_ascii=False).encode() for body in BODIES],
        Random(lab.seed),
    )
    end_s = time.monotonic() + (LONG_BODIES_S if lab.long else QUICK_BODIES_S)
    before_mb, tried, wrong = target.planner_mb(running), 0, []
    while time.monotonic() < end_s:
        path = paths[tried % len(paths)]
        body = mutant(seeds, random, MOST_BODY_BYTES)
        answer = target.ask(running, "POST", path, body=body, timeout_s=10.0)
        tried += 1
        if answer is None or (answer.status >= 500 and answer.status != UNAVAILABLE):
            wrong.append(f"{path} {answer.status if answer else 'no answer'} {body[:60]!r}")
    after_mb = target.planner_mb(running)
    return AttackOutcome(
        "mutated bodies",
        tried,
        len(wrong),
        "0 of 5xx",
        before_mb,
        after_mb,
        GROWTH_MB,
        "; ".join(wrong[:3]),
    )


def taking_json() -> list[str]:
    """Return the paths that take JSON by POST, a name in place of what they leave open."""
    contract = json.loads((CHECKOUT / "openapi.json").read_text("utf-8"))
    return [
        "/".join("x" if part.startswith("{") else part for part in path.split("/"))
        for path, operations in sorted(contract["paths"].items())
        if "application/json"
        in operations.get("post", {}).get("requestBody", {}).get("content", {})
    ]
