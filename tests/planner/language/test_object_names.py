"""People's words become a class and a colour, or nothing; a detector's names become classes."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from planner.language import color_names
from planner.language.formatting import definite
from planner.language.object_classes import KINDS
from planner.language.object_names import (
    canonical,
    known_words,
    list_kinds,
    name_kinds,
    name_object,
    named_several,
    resolve,
    singles_out,
    synonyms,
    tell_words,
)
from planner.plan import Bilingual, Language, say_same
from planner.skills.result_text import name_count
from tests.conftest import ROOT

MEANT = {
    "red cup": ("cup", "red"), "mug": ("cup", None), "couch": ("sofa", None),
    "two red cups": ("cup", "red"), "the big grey sofa": ("sofa", "gray"),
    "light blue books": ("book", "blue"), "dark-red chair": ("chair", "red"),
    "cup that is red": ("cup", "red"), "the bottle on the table": ("bottle", None),
    "people": ("person", None), "a man": ("person", None), "knives": ("knife", None),
    "boxes": ("box", None), "television": ("tv", None), "potted plant": ("plant", None),
    "orange": ("orange", None), "orange ball": ("ball", "orange"), "sports_ball": ("ball", None),
    "Dining Table": ("table", None), "anyone": ("person", None),
    "红色的杯子": ("cup", "red"), "一个红色的杯子": ("cup", "red"), "红杯子": ("cup", "red"),
    "紅色的杯子": ("cup", "red"), "那把椅子": ("chair", None), "红色的那个杯子": ("cup", "red"),
    "深蓝色的书": ("book", "blue"), "桌子上的杯子": ("cup", None), "有人": ("person", None),
    "几个人": ("person", None), "水瓶": ("bottle", None), "瓶子": ("bottle", None),
    "杯子是白色的": ("cup", "white"), "三把椅子": ("chair", None), "粉红色的球": ("ball", "pink"),
    "电视机": ("tv", None), "门": ("door", None), "盆栽": ("plant", None),
}  # fmt: skip
NOTHING = ("", "red", "红色", "John", "my sister's bottle", "person in a red shirt", "something",
           "the cup of coffee", "cupboard", "水", "我姐姐的瓶子", "穿红衣服的人", "东西", "？",
           "a" * 80)  # fmt: skip


@pytest.mark.parametrize("language", [None, Language.EN, Language.ZH])
def test_words_mean_a_class_and_a_colour(language: Language | None) -> None:
    assert {words: resolve(words, language) for words in MEANT} == MEANT
    assert [words for words in NOTHING if resolve(words, language) is not None] == []


def test_what_says_which_one_by_more_than_kind_and_colour_is_known() -> None:
    which = (
        "the small cup", "chair beside the window", "the other person", "bottle on the table",
        "another red cup", "big grey sofa", "the man near the door", "小杯子", "另一个人",
        "桌子上的杯子", "窗户旁边的椅子", "桌子旁边的红色的椅子",
    )  # fmt: skip
    any_one = (
        "red cup", "the nearest chair", "my cup", "that chair", "two red cups", "light blue book",
        "cup that is red", "a man", "红色的杯子", "最近的椅子", "家里的杯子", "那把椅子",
        "我的杯子", "dining table", "forklift", "",
    )  # fmt: skip
    assert [words for words in which if not singles_out(words)] == []
    assert [words for words in any_one if singles_out(words)] == []


def test_only_what_the_detector_knows_is_meant() -> None:
    assert resolve("red couch", classes=("cup", "chair")) is None
    assert resolve("红色的杯子", Language.ZH, ("cup",)) == ("cup", "red")
    assert resolve("two blue forklifts", classes=("forklift",)) is None  # no plural is guessed
    assert resolve("the blue fork_lift", classes=("fork_lift",)) == ("fork_lift", "blue")


def test_a_detectors_names_become_ids() -> None:
    names = {"Dining Table": "table", "tvmonitor": "tv", "couch": "sofa", "sports ball": "ball",
             "aeroplane": "airplane", "杯子": "cup", "my thing!": "my_thing",
             "": "thing"}  # fmt: skip
    assert {name: canonical(name) for name in names} == names
    coco = ROOT.parent / "shared" / "data" / "models" / "coco_classes.txt"
    if not coco.is_file():
        pytest.skip("shared/data is not here: the list of COCO's names can't be compared")
    ids = {canonical(name) for name in coco.read_text("utf-8").splitlines()}
    assert len(ids) == 80
    assert ids <= set(KINDS)


def test_a_thing_is_named_in_both_languages() -> None:
    assert (name_object("cup", "red").en, name_object("cup", "red").zh) == ("red cup", "红色的杯子")
    assert name_object("fork_lift").en == "fork lift"
    assert list_kinds(["cup", "tv"]).zh == "杯子、电视"
    assert list_kinds(list(KINDS), 2).en.endswith(f"and {len(KINDS) - 2} more")
    for label in KINDS:  # no two classes share a word
        for words in synonyms(label, Language.EN):
            assert canonical(words) == label
        assert resolve(name_object(label).zh) == (label, None)
        assert resolve(named_several(label).en) == (label, None)


def test_several_things_have_their_plural() -> None:
    several = [named_several(label).en for label in ("cup", "knife", "wine_glass", "grand_brush")]
    assert several == ["cups", "knives", "wine glasses", "grand brushes"]
    assert named_several("sheep", "black") == Bilingual(en="black sheep", zh="黑色的羊")


def test_colours_are_told_by_their_plain_words() -> None:
    told = "".join(color_names.color_name(color).zh for color in color_names.COLORS)
    assert told == "红色橙色黄色绿色蓝色紫色粉色棕色黑色灰色白色"


@pytest.mark.parametrize("color", color_names.COLORS)
def test_every_colour_has_its_words(color: str) -> None:
    name = color_names.color_name(color)
    en, zh = name.en, name.zh
    assert color_names.color_of(en) == color_names.color_of(zh) == color
    assert resolve(f"{en} cup") == resolve(f"{zh}的杯子") == ("cup", color)
    assert color_names.may_be(color, color)
    assert color_names.may_be(color, None)
    assert not color_names.may_be("red", "blue")


@pytest.fixture
def owners() -> Iterator[tuple[str, ...]]:
    """Have the owner's file name two classes of its own, and give a cup one more name."""
    name_kinds({
        "umbrella_stand": ("Umbrella Stand", "雨伞架", "brolly rack"),
        "cup": ("cup", "搪瓷缸"),
        "dustpan": ("簸箕",),
    })  # fmt: skip
    yield ("cup", "umbrella_stand", "dustpan", "forklift")
    name_kinds({})


def test_the_owners_names_are_understood_and_said_in_both_languages(
    owners: tuple[str, ...],
) -> None:
    for words, meant in (
        ("umbrella stand", ("umbrella_stand", None)),
        ("the red umbrella-stand", ("umbrella_stand", "red")),
        ("brolly rack", ("umbrella_stand", None)),
        ("雨伞架", ("umbrella_stand", None)),
        ("红色的雨伞架", ("umbrella_stand", "red")),
        ("搪瓷缸", ("cup", None)),
        ("mug", ("cup", None)),
        ("那个簸箕", ("dustpan", None)),
        ("dustpan", ("dustpan", None)),
        ("forklift", ("forklift", None)),
    ):
        assert resolve(words, None, owners) == meant, words
        assert resolve(words, None, ("chair",)) is None, words
    assert name_object("umbrella_stand", "red") == Bilingual(
        en="red umbrella stand", zh="红色的雨伞架"
    )
    assert named_several("umbrella_stand").en == "umbrella stands"
    assert name_object("dustpan") == Bilingual(en="dustpan", zh="簸箕")
    assert name_object("forklift") == Bilingual(en="forklift", zh="forklift")
    assert synonyms("cup", Language.ZH)[-1] == "搪瓷缸"
    assert known_words(owners) >= {"雨伞架", "brolly rack", "cup", "杯子", "搪瓷缸", "簸箕"}
    assert list_kinds(owners).zh == "杯子、雨伞架、簸箕、forklift"


def test_names_of_another_detector_take_their_place(owners: tuple[str, ...]) -> None:
    assert resolve("雨伞架", None, owners) is not None
    name_kinds({"umbrella_stand": ("umbrella stand", "伞桶")})
    assert resolve("雨伞架", None, owners) is None
    assert resolve("伞桶", None, owners) == ("umbrella_stand", None)


def test_things_are_counted_in_the_grammar_of_each_language() -> None:
    asked = ((1, "apple"), (2, "chair"), (3, "book"), (1, "scissors"), (0, "cup"), (12, "cat"))
    said = [name_count(*each) for each in asked]
    assert [each.en for each in said] == [
        "an apple", "two chairs", "three books", "a pair of scissors", "no cups", "12 cats",
    ]  # fmt: skip
    assert [each.zh for each in said] == [
        "一个苹果", "两把椅子", "三本书", "一把剪刀", "零个杯子", "12只猫",
    ]  # fmt: skip


def test_a_plans_words_for_a_thing_are_told_in_each_language() -> None:
    assert tell_words("red cup") == Bilingual(en="red cup", zh="红色的杯子")
    assert tell_words("手机") == Bilingual(en="cell phone", zh="手机")
    assert tell_words("guitar") == say_same("guitar")


def test_known_places_have_an_article_and_own_names_have_none() -> None:
    names = ("kitchen", "Room 5", "mom's room", "my desk", "the den")
    said = [definite(Bilingual(en=name, zh="房间")).en for name in names]
    assert said == ["the kitchen", "Room 5", "mom's room", "my desk", "the den"]
