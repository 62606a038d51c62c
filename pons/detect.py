"""Try a detector on pictures of one's own: report its setup and why, then its detections."""

from __future__ import annotations

import json
import os
import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner.perception import VisionFailure
from planner.perception.failure import SKIPS
from planner.perception.process_client import DEFAULT_MODEL
from planner.settings import load_settings
from pons.settings import BadSetting
from wire import ConfigError

if TYPE_CHECKING:
    import argparse

    from planner.perception import Detection, DetectorInfo, LookResult
    from planner.perception.detect import OnnxDetector
    from pons.settings import LaunchSettings

REFUSED = 1
MAX_FILE_BYTES = 50_000_000


def run(settings: LaunchSettings, said: argparse.Namespace) -> int:
    """Look at each picture; 1 where the model or a picture was refused."""
    if said.out is not None and len(said.images) > 1:
        raise BadSetting("one_picture: --out takes one IMAGE")
    try:
        detector = _detector(settings, said)
    except VisionFailure as failure:
        _print_failure(failure, as_json=said.json)
        return REFUSED
    except ConfigError as wrong:
        raise BadSetting(str(wrong)) from None
    looks = {path: detector.look(_read(path)) for path in said.images}
    if said.json:
        pictures = [{"image": str(path), **asdict(look)} for path, look in looks.items()]
        print(json.dumps({"about": asdict(detector.about), "pictures": pictures}, indent=2))
    else:
        print("\n".join([*_about_lines(detector.about), *map(_look_text, looks, looks.values())]))
    if said.out is not None:
        _draw(said.images[0], looks[said.images[0]], said.out)
    return REFUSED if any(look.skipped for look in looks.values()) else 0


def _detector(settings: LaunchSettings, said: argparse.Namespace) -> OnnxDetector:
    """Return the detector that the words, else the owner's settings, else Pons itself names."""
    from planner.perception.detect import ModelOptions, OnnxDetector

    owner = load_settings(settings.home, os.environ).vision
    path = said.model or owner.model or DEFAULT_MODEL
    if path is DEFAULT_MODEL and not path.is_file():
        raise VisionFailure("no_detector", "name one with --model, or as model in [vision]")
    own = said.model is None  # labels and decoder of one model say nothing of another
    wanted = ModelOptions(
        path,
        said.labels or (owner.labels if own else None),
        said.decoder or (owner.decoder if own else None),
        owner.provider,
        owner.threads,
        owner.input_px,
    )
    return OnnxDetector(wanted, owner.min_score)


def _read(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            data = file.read(MAX_FILE_BYTES + 1)
    except OSError as error:
        raise BadSetting(f"picture_unreadable: {path}: {error.strerror}") from None
    if len(data) > MAX_FILE_BYTES:
        raise BadSetting(f"picture_unreadable: {path} is over {MAX_FILE_BYTES} bytes")
    return data


def _print_failure(failure: VisionFailure, *, as_json: bool) -> None:
    if as_json:
        print(json.dumps({"code": failure.code, "message": failure.message}, ensure_ascii=False))
        return
    print(f"{failure.code}: {failure.message['en']}\n{failure.message['zh']}", file=sys.stderr)


def _about_lines(about: DetectorInfo) -> list[str]:
    names = ", ".join(filter(None, about.classes))
    return [
        f"model: {about.model}, input {about.width}x{about.height}",
        f"decoder: {about.decoder} ({about.why})",
        f"provider: {about.provider} ({about.provider_why})",
        f"classes: {sum(map(bool, about.classes))}: {names}",
        f"least score: {about.least}",
    ]


def _look_text(path: Path, look: LookResult) -> str:
    if look.skipped is not None:
        en, zh = SKIPS[look.skipped]
        return f"{path}: skipped, {look.skipped}: {en} / {zh}"
    count = len(look.detections)
    head = f"{path}: {look.width}x{look.height}, {count} found, {look.took_s * 1e3:.0f} ms"
    return "\n".join([head, *map(_line, look.detections)])


def _line(found: Detection) -> str:
    left, top, right, bottom = found.box
    where = f"left {left:.0f} top {top:.0f} right {right:.0f} bottom {bottom:.0f}"
    return f"  {found.label} {found.score:.2f}  {where}  {found.color or ''}".rstrip()


def _draw(source: Path, look: LookResult, target: Path) -> None:
    from planner.perception.detect import draw_detections, save, unpack_color

    picture: Any = unpack_color(_read(source))
    if not isinstance(picture, str) and not save(draw_detections(picture, look.detections), target):
        raise BadSetting(f"picture_unwritable: {target}; expected a name that ends in .jpg or .png")
