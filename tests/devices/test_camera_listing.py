"""Cameras are listed by the name that stays, and what is no camera is not."""

from __future__ import annotations

from pathlib import Path

from devices.camera_listing import list_cameras


def node(folder: Path, number: int, name: str, index: int = 0) -> None:
    made = folder / "sys" / f"video{number}"
    made.mkdir(parents=True)
    (made / "name").write_text(f"{name}\n")
    (made / "index").write_text(f"{index}\n")
    (folder / f"video{number}").touch()


def link(folder: Path, kind: str, name: str, to: str) -> Path:
    (folder / kind).mkdir(exist_ok=True)
    made = folder / kind / name
    made.symlink_to(f"../../{to}")
    return made


def test_a_camera_of_two_nodes_is_one_and_keeps_its_name(tmp_path: Path) -> None:
    node(tmp_path, 0, "HD Pro Webcam C920")
    node(tmp_path, 1, "HD Pro Webcam C920", index=1)
    node(tmp_path, 10, "bcm2835-codec-decode")
    node(tmp_path, 2, "USB Camera: USB Camera")
    kept = link(tmp_path, "by-id", "usb-046d_C920_1F2E-video-index0", "video0")
    link(tmp_path, "by-path", "platform-usb-1:1-video-index0", "video0")
    other = link(tmp_path, "by-path", "platform-usb-1:2-video-index0", "video2")
    found = list_cameras(tmp_path / "sys", tmp_path / "by-id", tmp_path / "by-path", tmp_path)
    assert [(one.path.name, one.lasting, one.name) for one in found] == [
        ("video0", kept, "HD Pro Webcam C920"),
        ("video2", other, "USB Camera: USB Camera"),
    ]
    assert all(one.is_permitted for one in found)


def test_without_video4linux_there_are_none(tmp_path: Path) -> None:
    assert list_cameras(tmp_path / "none", tmp_path, tmp_path, tmp_path) == []
