"""Hand recordings of the black box to others: ``pons record export FILE... --to FOLDER``."""

from __future__ import annotations

import json
import shutil
import sys
from typing import TYPE_CHECKING

from pons.terminal import pick

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from bridge.recording.recording_reader import Raw

EXIT_DONE, EXIT_UNUSABLE = 0, 2
THERE = (
    "bag_exists: {} is there and stays; name another folder with --to",
    "bag_exists：{} 已存在，不会覆盖；请用 --to 指定其他文件夹",
)
EMPTY = (
    "recording_empty: nothing in these files has a word in ROS 2",
    "recording_empty：这些文件中没有可以用 ROS 2 表示的内容",
)


def export(files: list[Path], to: Path | None, *, as_json: bool) -> int:
    """Write recordings as one rosbag2; 2 where they can't be read or the bag not be written."""
    from bridge.recording.recording_reader import BadRecording
    from pons.record.rosbag import write_rosbag

    folder = to if to is not None else files[0].with_suffix(".bag")
    try:
        counts = write_rosbag(folder, _messages(files))
    except FileExistsError:
        print(pick(*THERE).format(folder), file=sys.stderr)
        return EXIT_UNUSABLE
    except (BadRecording, OSError) as wrong:
        shutil.rmtree(folder, ignore_errors=True)  # half a bag looks like a whole one
        print(wrong, file=sys.stderr)
        return EXIT_UNUSABLE
    if not counts:
        shutil.rmtree(folder, ignore_errors=True)
        print(pick(*EMPTY), file=sys.stderr)
        return EXIT_UNUSABLE
    if as_json:
        print(json.dumps({"bag": str(folder), "messages": counts}, ensure_ascii=False))
        return EXIT_DONE
    print(folder)
    for topic, count in counts.items():
        print(f"  {count:>8} {topic}")
    return EXIT_DONE


def _messages(files: list[Path]) -> Iterator[Raw]:
    from bridge.recording.recording_reader import McapReader

    for file in sorted(files):  # the names of a run are in the order of time
        with McapReader(file) as box:
            yield from box.messages()
