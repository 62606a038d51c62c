"""Measure a stop heard while the recording still runs: from the end of the word to the hold.

The robot drives in the real processes; a stop spoken by espeak-ng goes to the planner as a
microphone's samples would, in real time, and the button is held for seconds after it. The time is
from the moment at which the word's last loud sample has been sent to the first status that is held.
How often other speech is taken for a stop is counted by the same engine without a robot.
"""

from __future__ import annotations

import array
import itertools
import json
import shutil
import time
from typing import TYPE_CHECKING, Any

from websockets.sync.client import connect

from planner.voice import Sound, read_wav
from pons.http import call
from tools.bench.context import MeasurementFailure, until
from tools.bench.measure.foreign_voice import FOREIGN, names
from tools.bench.measure.voice import CHATTER, ORDERS, VOICES, speak
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import BenchRobot
from wire import Mode

if TYPE_CHECKING:
    from planner.voice.sphinx import Sphinx
    from tools.bench.context import BenchLab

NAME = "spoken_stop"
TITLE = "end of a spoken stop -> held, before the recording ends; other speech taken for a stop"
LONG_ONLY = False
GOAL_TIME = "p50 <= 500"
STOPS = ("stop", "please stop")
"""That end with the word: the time counts from its end."""
TRIALS = 24
SLICES = 4
FRAME_S = 0.04
BEFORE_S, AFTER_S = 0.3, 2.5
LOUD = 0.05
"""Of the loudest sample: where a word ends."""
DRIVES_MPS = 0.15
NEAR = (
    *("start the music", "the store is closed", "step aside please", "stay with me"),
    *("put it on top of the {a}", "is it hot today", "what is that spot on the floor"),
)


def measure(lab: BenchLab) -> list[ReportRow]:
    """Stop a driving robot by voice, then talk of other things."""
    if shutil.which("espeak-ng") is None:
        return [ReportRow("spoken stop", "", "", value="none", note="no espeak-ng", valid=False)]
    rows: list[ReportRow] = []
    for data in lab.slices("time", 1, lambda _: _time(lab)):
        note = f"{data['missed']} of {data['tried']} not heard before the end; home, real time"
        rows.append(row_of("end of the word -> held", "ms", GOAL_TIME, data["ms"], note))
    parts = list(lab.slices("other", SLICES, lambda index: _talk(lab, index)))
    if parts:
        total = {name: sum(part[name] for part in parts) for name in ("n", "taken", "looks")}
        note = f"of {total['n']} other sentences, looked at {total['looks']} times"
        rows.append(
            ReportRow("taken for a stop early", "", "", value=str(total["taken"]), note=note)
        )
    return rows


def _time(lab: BenchLab) -> dict[str, Any]:
    took_ms: list[float] = []
    tried = 0
    with lab.folder() as home, BenchRobot(home, "home") as robot:
        robot.make_ready()
        for number in range(TRIALS):
            lab.say(f"stop {number + 1}/{TRIALS}")
            text, voice = STOPS[number % len(STOPS)], VOICES[number % len(VOICES)]
            sound = read_wav(speak(text, voice, 150))
            _drive(robot, number)
            tried += 1
            held_ms = _stop(robot, sound)
            if held_ms is not None:
                took_ms.append(held_ms)
            call(robot.settings, "POST", "/v1/stop", {})
            until(lambda: _is_held(robot), 5.0, "held")
    return {"ms": took_ms, "tried": tried, "missed": tried - len(took_ms)}


def _drive(robot: BenchRobot, number: int) -> None:
    """Give a goal and wait until it drives.

    Raises:
        MeasurementFailure: it does not within 20 s.
    """
    robot.operate("resume")
    robot.say(("go to the kitchen", "go to the living room")[number % 2])
    try:
        until(lambda: _drives(robot), 5.0, "driving")
    except MeasurementFailure:  # it may have stood there already
        robot.say(("go to the living room", "go to the kitchen")[number % 2])
        until(lambda: _drives(robot), 20.0, "driving")


def _stop(robot: BenchRobot, sound: Sound) -> float | None:
    """Say it to the robot; return the time from the word's end to the hold [ms], None if missed."""
    before = bytes(2 * int(BEFORE_S * sound.rate_hz))
    pcm = before + sound.pcm + bytes(2 * int(AFTER_S * sound.rate_hz))
    ends_s = (len(before) / 2 + _last_loud(sound)) / sound.rate_hz
    step = int(FRAME_S * sound.rate_hz) * 2
    settings = robot.settings
    with connect(f"ws://{settings.host}:{settings.port}/v1/voice/live") as socket:
        socket.send(json.dumps({"rate_hz": sound.rate_hz}))
        began_s = time.monotonic()
        for start in range(0, len(pcm), step):
            spoken_s = began_s + (start + step) / 2 / sound.rate_hz
            while time.monotonic() < spoken_s:  # a microphone gives no sample before its time
                if _is_held(robot):
                    return (time.monotonic() - began_s - ends_s) * 1e3
                time.sleep(0.002)
            socket.send(pcm[start : start + step])
    return None


def _last_loud(sound: Sound) -> int:
    samples = array.array("h")
    samples.frombytes(sound.pcm)
    least = LOUD * max(map(abs, samples))
    return max(index for index, each in enumerate(samples) if abs(each) >= least)


def _talk(lab: BenchLab, index: int) -> dict[str, Any]:
    from planner.voice.sphinx import Sphinx

    ears = Sphinx(names())
    places = itertools.cycle(names())
    said = [
        (form.format(a=next(places), b=next(places)), voice)
        for form in (*CHATTER, *NEAR, *(each for each in ORDERS if each != "stop"))
        for voice in VOICES[:3]
    ]
    said += [(text, voice) for voice, texts in FOREIGN.items() for text in texts]
    said = said[index::SLICES]
    taken = looks = 0
    for number, (text, voice) in enumerate(said):
        lab.say(f"other sentence {number + 1}/{len(said)}")
        heard, looked = _listen(ears, read_wav(speak(text, voice, 150)))
        taken, looks = taken + heard, looks + looked
    return {"n": len(said), "taken": taken, "looks": looks}


def _listen(ears: Sphinx, sound: Sound) -> tuple[bool, int]:
    """Return whether a stop is heard in a recording that grows, and how often it was looked at."""
    from planner.voice.stop_spotter import StopSpotter

    looked = 0

    def spot(pcm: bytes) -> Any:
        nonlocal looked
        looked += 1
        return ears.spot_stop(pcm, sound.rate_hz, sound.channels)

    spotter = StopSpotter(sound.rate_hz, sound.channels, spot)
    pcm = sound.pcm + bytes(sound.rate_hz)
    step = int(0.1 * sound.rate_hz) * 2
    for start in range(0, len(pcm), step):
        heard = spotter.take(pcm[start : start + step])
        if heard is not None and heard.understood:
            return True, looked
    return False, looked


def _drives(robot: BenchRobot) -> bool:
    status = robot.status
    moves = status is not None and abs(status.measured.v_mps) > DRIVES_MPS
    return moves and status is not None and status.mode is Mode.ACTIVE


def _is_held(robot: BenchRobot) -> bool:
    status = robot.status
    return status is not None and status.held is not None
