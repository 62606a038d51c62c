"""Put what was seen into sentences, in both languages. Pure; figures come from the sight."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from planner.language.object_classes import HOME
from planner.language.object_names import listed as labels_listed
from planner.language.object_names import named, singles_out
from planner.mission.skills.spatial_relations import told
from planner.plan import Bilingual, Code, message, same

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from planner.mission.skills.perception import Wanted
    from planner.mission.state import SiteView
    from planner.perception.snapshot import Thing

_MANY = {"person": "people", "sheep": "sheep", "knife": "knives", "mouse": "mice"}
_SHOWN = 12
NOWHERE = Bilingual(en="I looked nowhere.", zh="哪里都没有看。")
HERE = Bilingual(en="here", zh="这里")


def called(label: str, color: str | None = None) -> Bilingual:
    """Return a thing's name with its article: ``a red cup``, ``红色的杯子``."""
    name = named(label, color)
    article = "an" if name.en[:1] in "aeiou" else "a"
    return Bilingual(en=f"{article} {name.en}", zh=name.zh)


def counted(count: int, label: str, color: str | None = None) -> Bilingual:
    """Return so many of a thing: ``2 red cups``, ``2 个红色的杯子``."""
    name = named(label, color)
    if count == 1:
        return Bilingual(en=f"1 {name.en}", zh=f"1 个{name.zh}")
    first, _, last = name.en.rpartition(" ")
    many = f"{first} {_MANY.get(label) or _plural(last)}".strip()
    return Bilingual(en=f"{count} {many}", zh=f"{count} 个{name.zh}")


def _plural(word: str) -> str:
    return f"{word}es" if word.endswith(("s", "x", "ch", "sh")) else f"{word}s"


def known_things(classes: tuple[str, ...]) -> Bilingual:
    """List what can be recognised; what most detectors of a home know, where it is not known."""
    return labels_listed(classes or [kind.id for kind in HOME])


def unknown_name(name: str, classes: tuple[str, ...]) -> Bilingual:
    """Say that these eyes don't know such a thing, and what they know."""
    return message(Code.OBJECT_UNKNOWN, name=same(name), known=known_things(classes))


def unknown_words(words: str, classes: tuple[str, ...], kind: str = "") -> Bilingual:
    """Say that these eyes don't know a thing and what they know, or not which one is meant.

    What they can tell besides depends on the kind of step: somebody who walks has no neighbour.
    """
    if not singles_out(words, classes):
        return unknown_name(words, classes)
    if kind == "follow":
        return Bilingual(
            en=f"I can't tell by sight which one “{words}” is: I follow the nearest one in sight, "
            "and can't pick out another, nor tell one by what is near.",
            zh=f"我看不出“{words}”指的是哪一个：我只会跟随看得见的最近的一个，"
            "不能挑出另一个，也不能靠旁边的东西来认。",
        )
    return Bilingual(
        en=f"I can't tell by sight which one “{words}” is: I know kind, colour, and what a thing "
        "is on, under or near, where I know that, too.",
        zh=f"我看不出“{words}”指的是哪一个：我只能分辨种类和颜色，"
        "以及它在我认得的什么东西的上面、下面或旁边。",
    )


def room_name(facts: SiteView, room: str | None) -> Bilingual | None:
    """Return a room's name, where it is one."""
    target = facts.targets.get(room or "")
    return target.name if target is not None else None


def by_neighbour(what: Bilingual, wanted: Wanted | None) -> Bilingual:
    """Return a thing's name with the neighbour that it was told by, where there is one."""
    if wanted is None or wanted.by is None or wanted.relation is None:
        return what
    return told(what, wanted.relation, named(wanted.by.label, wanted.by.color))


def found_at(facts: SiteView, label: str, color: str | None, room: str | None, away: float | None,
             wanted: Wanted | None = None) -> Bilingual:  # fmt: skip
    """Say where a thing is: its room and how far it is from the robot."""
    what, where = by_neighbour(called(label, color), wanted), room_name(facts, room)
    en = f"I found {what.en}" + (f" in the {where.en}" if where else "")
    zh = f"在{where.zh}看到{what.zh}" if where else f"看到{what.zh}"
    if away is not None:
        en, zh = f"{en}, {away:.1f} m from me", f"{zh}，离我 {away:.1f} 米"
    return Bilingual(en=f"{en}.", zh=f"{zh}。")


def looked_in(facts: SiteView, rooms: Iterable[str], shut: Iterable[str], spent: str | None,
              alike: Sequence[Thing] = ()) -> Bilingual:  # fmt: skip
    """Say which rooms were looked through, which could not be reached, and what ran out.

    Of things that are ``alike``, it is said that light may have changed their colour.
    """
    seen = [room_name(facts, r) or same(r) for r in rooms]
    closed = [room_name(facts, r) or same(r) for r in shut]
    en = [f"I looked in the {_and([n.en for n in seen])}."] if seen else []
    zh = [f"看过的地方：{'、'.join(n.zh for n in seen)}。"] if seen else []
    if closed:
        en.append(f"I found no way to the {_and([n.en for n in closed])}.")
        zh.append(f"去不了的地方：{'、'.join(n.zh for n in closed)}。")
    if spent is not None:
        en.append("The way or the time for one search is used up.")
        zh.append("单次寻找的里程或时间已用完。")
    if alike:
        others = listed(alike)
        en.append(f"I saw {others.en}; light may change a colour.")
        zh.append(f"看到 {others.zh}；光线可能改变颜色。")
    return Bilingual(en=" ".join(en) or NOWHERE.en, zh="".join(zh) or NOWHERE.zh)


def listed(things: Iterable[Thing]) -> Bilingual:
    """List things by kind and colour with their numbers: ``2 chairs, 1 red cup``."""
    kinds = Counter((t.label, t.color) for t in things)
    said = [counted(n, *kind) for kind, n in sorted(kinds.items(), key=lambda k: (-k[1], str(k)))]
    return Bilingual(
        en=_and([s.en for s in said[:_SHOWN]]), zh="、".join(s.zh for s in said[:_SHOWN])
    )


def _and(names: list[str]) -> str:
    return "".join(names) if len(names) < 2 else f"{', '.join(names[:-1])} and {names[-1]}"
