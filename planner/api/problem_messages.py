"""Own the sentences on parts that can't be used or armed, by the problem's code.

``detail`` beside it names what came and what was expected, for whoever wrote the client.
"""

from __future__ import annotations

from planner.language.catalogue import say

_LENGTH = say("problem.length")
_BROKEN = say("problem.broken")
_KIND = say("problem.kind")
_EARS = say("problem.ears")
_AGAIN = say("problem.again")
SAYINGS = {
    "audio_empty": say("problem.audio_empty"),
    "audio_too_short": say("problem.audio_too_short"),
    "audio_too_long": _LENGTH,
    "not_wav": _KIND,
    "wav_unsupported": _KIND,
    "wav_truncated": _BROKEN,
    "wav_malformed": _BROKEN,
    "recogniser_unavailable": _EARS,
    "voice_busy": _AGAIN,
    "no_camera": say("problem.no_camera"),
    "no_detector": say("problem.no_detector"),
    "detector_down": say("problem.detector_down"),
    "camera_silent": say("problem.camera_silent"),
    "camera_frozen": say("problem.camera_frozen"),
    "camera_unusable": say("problem.camera_unusable"),
    "unknown_object": say("problem.unknown_object"),
    "disk_full": say("problem.disk_full"),
    "recorder_down": say("problem.recorder_down"),
    "voice_timed_out": _AGAIN,
    "foreign_host": say("problem.foreign_host"),
    "foreign_origin": say("problem.foreign_origin"),
    "proxy_without_token": say("problem.proxy_without_token"),
    "goal_too_long": say("problem.goal_too_long"),
    "too_many_goals": say("problem.too_many_goals"),
    "too_many_sockets": say("problem.too_many_sockets"),
    "headers_too_large": say("problem.headers_too_large"),
    "request_timeout": say("problem.request_timeout"),
    "body_too_large": say("problem.body_too_large"),
    "unsupported_media_type": say("problem.unsupported_media_type"),
}  # fmt: skip


def saying_of(code: str) -> dict[str, dict[str, str]]:
    """Return the sentence for a person as ``message``, where the code has one."""
    return {"message": SAYINGS[code].model_dump()} if code in SAYINGS else {}
