"""The page streams what its microphone hears while the button is held, and says that it stopped.

A real browser with a microphone that is fed from a file, and the planner's own routes. The listener
is the test's: that a real recogniser hears a stop early is told in tests/planner/voice.
"""

from __future__ import annotations

import array
import os
import shutil
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from planner.voice import Recognition, Sound, read_wav
from scripts.browser import chromium
from tests.planner.api.serving import served
from tests.planner.voice.speech import speak, wav

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]
LOUD = 2_000
PATIENCE_MS = 13_000
"""A page ends a recording after 14 s."""


class HearsLoudness:
    """Hear a stop in whatever is loud."""

    async def take(self, sound: Sound) -> Recognition | None:
        samples = array.array("h")
        samples.frombytes(sound.pcm)
        loud = max(map(abs, samples), default=0) >= LOUD
        return Recognition("stop", 0.9, understood=True) if loud else None


@pytest.mark.skipif(shutil.which("espeak-ng") is None, reason="no espeak-ng to speak the stop")
def test_a_spoken_stop_is_obeyed_before_the_button_is_let_go(
    browser: Browser, tmp_path: Path
) -> None:
    spoken = read_wav(speak("stop", "en-us+f3", 150))
    pause = bytes(2 * spoken.rate_hz)
    (sound := tmp_path / "stop.wav").write_bytes(wav(pause + spoken.pcm, spoken.rate_hz))
    arguments = ["--no-sandbox"] if os.geteuid() == 0 else []
    arguments += [
        "--use-fake-device-for-media-stream",
        f"--use-file-for-fake-audio-capture={sound}",  # again and again
    ]
    speaking = browser.browser_type.launch(executable_path=chromium(), args=arguments)
    try:
        with served() as server:
            server.services.ears.listeners = [HearsLoudness()]
            page = speaking.new_context(permissions=["microphone"]).new_page()
            page.goto(f"http://127.0.0.1:{server.port}")
            page.hover("#talk")
            page.mouse.down()
            page.locator("#announcer", has_text="a stop was heard").wait_for(timeout=PATIENCE_MS)
            assert page.locator("#talk.listening").count() == 1  # the button is still held
            assert server.services.goals.stops == ["voice"]
            with page.expect_request("**/v1/voice?confirm=true"):
                page.mouse.up()  # whatever else it says waits for a yes
            page.close()
    finally:
        speaking.close()
