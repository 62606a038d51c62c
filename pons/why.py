"""Explain the robot's last stop in one screen: ``pons why``. Reads recordings; asks no process.

Which row or order it was, the evidence, what came of it, and what a person can do now.
"""

from __future__ import annotations

import json
import sys
import time
from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Any

from bridge.core.faults.code_messages import GATES
from bridge.stop_report import BadRecording, last_stop
from pons.code_messages import sentence
from pons.terminal import pick
from wire import RELAYED, UNREADABLE, Mode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.stop_report import StopReport
    from pons.settings import LaunchSettings

EXIT_TOLD, EXIT_NO_STOP, EXIT_BAD = 0, 1, 2
_SHOWN = 8

_TO_DO = {
    Mode.FAULT: (
        "mend what the evidence names; then pons reset, pons arm, pons resume",
        "先排除证据所示的问题，然后依次运行 pons reset、pons arm、pons resume",
    ),
    Mode.ESTOPPED: (
        "let go of the button; then pons reset, pons arm, pons resume",
        "松开停止按钮，然后依次运行 pons reset、pons arm、pons resume",
    ),
    Mode.DISARMED: ("pons arm, then pons resume", "运行 pons arm，然后 pons resume"),
}
_RESUME = ("pons resume", "运行 pons resume")
_WENT_ON = ("nothing: it went on by itself", "无需操作：机器人已自行继续")
_GOES_ON = (
    "nothing: it goes on by itself once the evidence is gone",
    "无需操作：问题消失后机器人会自行继续",
)
_CLEAR_THE_WAY = (
    "as said above; it goes on by itself once its way is free",
    "按上述说明处理；道路畅通后机器人会自行继续",
)
_GROWING = ("it is still being written", "记录仍在进行")
_CUT = (
    "its writer was killed or the power failed; read up to its last whole second",
    "记录进程被终止或断电；已读到最后一个完整片段",
)


def run(settings: LaunchSettings, *, as_json: bool = False) -> int:
    """Explain; 0 told, 1 no recording shows a stop, 2 a recording can't be read."""
    folder = settings.home / "recordings"
    try:
        stop = last_stop(folder)
    except BadRecording as wrong:
        print(wrong, file=sys.stderr)
        return EXIT_BAD
    if stop is None:
        print(f"no_stop: no recording in {folder} shows a robot that was ready and stopped")
        return EXIT_NO_STOP
    if as_json:
        print(json.dumps(_content(stop), ensure_ascii=False, indent=1))
        return EXIT_TOLD
    for name, text in _lines(stop):
        print(f"{name:<9} {text}")
    return EXIT_TOLD


def _content(stop: StopReport) -> dict[str, Any]:
    """Return the report as JSON holds it, with the sentences of both languages."""
    fields = asdict(replace(stop, rows=(), held=None))
    fields["held"] = None if stop.held is None else stop.held.model_dump(mode="json")
    fields["path"] = str(stop.path)
    fields["rows"] = [
        {"row": stage.name, "action": stage.action.value, "evidence": evidence}
        for stage, evidence in stop.rows
    ]
    keys = ("after_s", "code", "detail")
    fields["events"] = [dict(zip(keys, event, strict=True)) for event in stop.events]
    pairs = {"why": sentence(stop.cause), "to_do": _to_do(stop)}
    told = {
        name: dict(zip(("en", "zh"), pair, strict=True)) for name, pair in pairs.items() if pair
    }
    return {**fields, **told}


def _lines(stop: StopReport) -> Iterator[tuple[str, str]]:
    when = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(stop.at_unix_s))
    yield "when", f"{when}, {stop.ago_s:.1f} s before the record ends"
    yield "stop", f"{stop.before.value} -> {stop.after.value}, by {stop.cause}"
    yield from _words("why", stop.cause)
    if stop.ordered_by is not None:
        yield "who", pick(*_name_sources(stop.ordered_by))
    for stage, evidence in stop.rows:
        yield "evidence", f"{stage.name} ({stage.action.value}): {evidence}"
    yield "motion", _motion(stop)
    if stop.fault is not None and stop.fault != stop.cause:
        yield from _words("fault", stop.fault)
    held = f", held: {stop.held.reason.value} {stop.held.id}" if stop.held is not None else ""
    yield "then", f"{stop.ended.value}{held}"
    yield "to do", pick(*_to_do(stop))
    for passed_s, code, detail in stop.events[:_SHOWN]:
        yield f"+{passed_s:.2f} s", f"{code} {detail}"
    if len(stop.events) > _SHOWN:
        yield "", f"and {len(stop.events) - _SHOWN} more"
    yield "record", str(stop.path)
    if not stop.whole:
        yield "", pick(*(_GROWING if stop.growing else _CUT))


def _name_sources(sources: str) -> tuple[str, str]:
    """Name those who gave the order. What came by the planner is its word, and called so."""
    english, chinese = [], []
    for source in sources.split(", "):
        name = source.removeprefix(RELAYED)
        if source == UNREADABLE:
            english.append("somebody whose message can't be read")
            chinese.append("无法读取其消息的一方")
        elif name != source:
            english.append(f"{name}, as the planner says, which passed it on")
            chinese.append(f"{name}（由规划器转达）")
        else:
            english.append(name)
            chinese.append(name)
    return "; ".join(english), "；".join(chinese)


def _words(name: str, code: str) -> Iterator[tuple[str, str]]:
    """Yield the sentence of a row, an order, a gate or a fault."""
    words = sentence(code)
    if words is not None:
        yield name, pick(*words)


def _motion(stop: StopReport) -> str:
    if stop.stood_s is None:
        return f"{stop.speed_mps:.2f} m/s when it began; the record ends before it stood"
    stood = f"stood {stop.stood_s:.2f} s and {stop.way_m:.2f} m later"
    return f"{stop.speed_mps:.2f} m/s when it began; {stood}"


def _to_do(stop: StopReport) -> tuple[str, str]:
    if stop.ended in _TO_DO:
        return _TO_DO[stop.ended]
    if stop.held is not None:
        return _RESUME
    if stop.ended in {Mode.ACTIVE, Mode.TELEOP}:
        return _WENT_ON
    return _CLEAR_THE_WAY if stop.cause in GATES else _GOES_ON
