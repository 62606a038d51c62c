"""Write a rosbag2: a folder with one MCAP file and the metadata.yaml that ROS 2 asks for.

Layout: https://mcap.dev/spec/registry (profile ros2) and rosbag2's metadata, version 5, which every
ROS 2 since Galactic reads.
"""

from __future__ import annotations

import json
from collections import Counter
from typing import TYPE_CHECKING

from mcap.writer import CompressionType, Writer

from pons.record.ros2_messages import definition, encode, ros_name
from pons.record.ros2_topics import TYPES, Ros2Words

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from bridge.recording.recording_reader import Raw

CHUNK_BYTES = 1 << 20


def write_rosbag(folder: Path, messages: Iterable[Raw]) -> dict[str, int]:
    """Write a bag and return how many messages each topic has.

    Raises:
        FileExistsError: the folder is there.
        OSError: it can't be written.
        BadRecording: of the messages' reader.
    """
    folder.mkdir()
    counts: Counter[str] = Counter()
    first_ns, last_ns = 0, 0
    name = f"{folder.name}_0.mcap"
    with (folder / name).open("xb") as file:
        writer = Writer(file, CHUNK_BYTES, compression=CompressionType.ZSTD)
        writer.start(profile="ros2", library="pons")
        channels: dict[str, int] = {}
        words = Ros2Words()
        for raw in messages:
            for topic, fields in words.of(raw):
                kind = TYPES[topic]
                if topic not in channels:
                    text = definition(kind).encode()
                    schema = writer.register_schema(ros_name(kind), "ros2msg", text)
                    channels[topic] = writer.register_channel(topic, "cdr", schema)
                data = encode(kind, fields)
                writer.add_message(channels[topic], raw.at_ns, data, raw.at_ns, counts[topic])
                counts[topic] += 1
                first_ns, last_ns = first_ns or raw.at_ns, max(last_ns, raw.at_ns)
        writer.finish()  # type: ignore[no-untyped-call]  # mcap leaves it untyped
    metadata = _metadata(name, counts, first_ns, last_ns)
    (folder / "metadata.yaml").write_text(metadata, encoding="utf-8")
    return dict(counts)


def _metadata(file: str, counts: Counter[str], first_ns: int, last_ns: int) -> str:
    """Return metadata.yaml; JSON is YAML, and needs no library here."""
    span = {
        "starting_time": {"nanoseconds_since_epoch": first_ns},
        "duration": {"nanoseconds": last_ns - first_ns},
        "message_count": counts.total(),
    }
    topics = [
        {
            "topic_metadata": {
                "name": topic,
                "type": ros_name(TYPES[topic]),
                "serialization_format": "cdr",
                "offered_qos_profiles": "",
            },
            "message_count": count,
        }
        for topic, count in counts.items()
    ]
    told = {
        "version": 5,
        "storage_identifier": "mcap",
        **span,
        "topics_with_message_count": topics,
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [file],
        "files": [{"path": file, **span}],
    }
    return json.dumps({"rosbag2_bagfile_information": told}, indent=1) + "\n"
