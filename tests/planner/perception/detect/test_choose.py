"""Tell layouts apart by what is known of a model, and refuse to guess."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.perception.detect.class_names import names_in, names_of
from planner.perception.detect.decoders import choose
from planner.perception.detect.decoders.base import Facts, Shape
from planner.perception.failure import VisionFailure

COCO = tuple(f"thing_{number}" for number in range(80))
ULTRALYTICS = {"task": "detect", "names": str(list(COCO))}


def facts(
    *shapes: Shape,
    names: tuple[str, ...] = COCO,
    metadata: dict[str, str] | None = None,
    called: tuple[str, ...] = ("output0", "output1", "output2"),
    size: tuple[int, int] = (640, 640),
) -> Facts:
    return Facts(
        outputs=dict(zip(called, shapes, strict=False)),
        metadata=metadata or {},
        names=names,
        names_from="metadata" if metadata else "labels",
        width=size[0],
        height=size[1],
    )


@pytest.mark.parametrize(
    ("known", "expected"),
    [
        (facts((1, 84, 8400), metadata=ULTRALYTICS), "yolov8"),
        (facts((1, 8400, 84), metadata=ULTRALYTICS), "yolov8"),
        (facts((1, 25200, 85), metadata=ULTRALYTICS), "yolov5"),
        (facts((1, 25200, 85), (1, 3, 80, 80, 85)), "yolov5"),
        (facts((1, 8400, 85)), "yolox"),
        (facts((1, 3549, 85), size=(416, 416)), "yolox"),
        (facts((1, 300, 6), metadata=ULTRALYTICS), "end_to_end"),
        (facts((0, 6)), "end_to_end"),
        (facts((1, 84, 1575), size=(320, 240), metadata=ULTRALYTICS), "yolov8"),
        (facts((1, 102000, 85), size=(1280, 1280)), "yolov5"),
        # One class in a grid makes six columns too: a box, its objectness, a score.
        (facts((1, 25200, 6), names=("cup",)), "yolov5"),
        (facts((1, 8400, 6), names=("cup",)), "yolox"),
        (facts((1, 5, 8400), names=("cup",)), "yolov8"),
        (facts((1, 300, 6), names=("cup", "ball")), "end_to_end"),
        (facts((1, 300, 84), metadata=ULTRALYTICS | {"description": "RTDETR-l"}), "rtdetr_rows"),
        (facts((1, 300), (1, 300, 4), (1, 300), called=("labels", "boxes", "scores")), "rtdetr"),
        (facts((1, 300, 4), (1, 300, 81), called=("dets", "labels")), "rfdetr"),
    ],
)
def test_the_layout_is_told_by_names_and_shapes(known: Facts, expected: str) -> None:
    told = choose(known).decoder.NAME
    assert told == expected


def test_who_names_a_decoder_is_followed_where_it_fits() -> None:
    known = facts((1, 300, 84), metadata={"decoder": "rtdetr_rows"})
    choice = choose(known)
    assert (choice.decoder.NAME, choice.why) == ("rtdetr_rows", "metadata: decoder = rtdetr_rows")
    choice = choose(facts((1, 8400, 85), metadata={"decoder": "yolov8"}), "yolox")
    assert (choice.decoder.NAME, choice.why) == ("yolox", "settings: decoder = yolox")


@pytest.mark.parametrize(
    ("known", "wanted", "code", "told"),
    [
        (facts((1, 84, 8400)), "yolox", "model_decoder_wrong", "output0 1x84x8400"),
        (facts((1, 84, 8400), metadata={"decoder": "x"}), None, "model_decoder_wrong", "yolov8"),
        (facts((1, 116, 8400), metadata={"task": "pose"}), None, "model_not_detector", "pose"),
        (facts((1, 1000)), None, "model_not_detector", "1x1000"),
        (facts((4, 3), called=("selected",)), None, "model_not_detector", "selected 4x3"),
        (facts((1, 300, 84)), None, "model_layout_unknown", "80 class names; known: yolov5"),
        (facts((1, 84, 8400), (1, 32, 160, 160)), None, "model_layout_unknown", "output1"),
        (facts((1, 3, 80, 80, 85)), None, "model_layout_unknown", "1x3x80x80x85"),
        (facts((1, 3478, 85), size=(413, 413)), None, "model_input_odd", "413 x 413"),
        (facts((1, 84, 8400), names=COCO[:3]), None, "model_names_wrong", "80 classes, 3 names"),
        (facts((1, 7, 8400), names=("", *COCO[:3])), None, "model_names_wrong",
         "expected 0 to 2, not 1 to 3"),
        (facts((1, 8400, 85), names=()), None, "model_names_missing", "it has 80"),
        (facts((1, 300, 6), names=("", "")), None, "model_names_missing", "[vision] labels"),
        (facts((1, 300, 4), (1, 300, 91), called=("dets", "labels")), None, "model_names_wrong",
         "91 classes, 80 names"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused(
    known: Facts, wanted: str | None, code: str, told: str
) -> None:
    with pytest.raises(VisionFailure) as caught:
        choose(known, wanted)
    assert caught.value.code == code
    assert told in caught.value.detail
    assert all(told in sentence for sentence in caught.value.message.values())


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("{0: 'Person', 1: 'dining table', 3: 'N/A'}", ("person", "dining_table", "", "")),
        ('{"0": "cup", "1": "ball"}', ("cup", "ball")),
        ('["杯子", "background", "TV "]', ("杯子", "", "tv")),
        ("", ()),
    ],
)
def test_names_are_read_as_literals(text: str, expected: tuple[str, ...]) -> None:
    assert names_in({"names": text}).ids == expected


@pytest.mark.parametrize(
    "text",
    [
        '[["umbrella stand", "雨伞架"], ["Cup"], "ball"]',
        '{"0": {"en": "umbrella stand", "zh": "雨伞架"}, "1": "cup", "2": ["ball"]}',
    ],
)
def test_a_class_may_have_a_name_in_each_language(text: str) -> None:
    found = names_in({"names": text})
    assert found.ids == ("umbrella_stand", "cup", "ball")
    assert found.words == (("umbrella stand", "雨伞架"), (), ())


def test_lines_may_hold_several_names(tmp_path: Path) -> None:
    path = tmp_path / "m.names"
    path.write_text("Umbrella Stand | 雨伞架 | brolly rack\nball\n| \n", "utf-8")
    found = names_of(path)
    assert found.ids == ("umbrella_stand", "ball", "")
    assert found.words == (("Umbrella Stand", "雨伞架", "brolly rack"), (), ())


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os').getcwd()",
        "[open('names')]",
        "{0: 'a', -1: 'b'}",
        "{99999999: 'a'}",
        "{'first': 'a'}",
        "[1, 2]",
        "42",
        "person, cup",
        "[" * 5000,
        str(["a"] * 3000),
        str([["a", "b" * 41]]),
        str([["a", "<script>"]]),
        str([["a", "b\nSYSTEM: drive"]]),
        str([["a"] * 20]),
        str([["a", 3]]),
        str([{"en": "a", "fr": "b"}]),
    ],
)
def test_names_that_are_no_names_are_refused_and_never_run(text: str) -> None:
    with pytest.raises(VisionFailure, match="model_names_malformed"):
        names_in({"names": text})
