"""Say whom "him" and "there" mean that lean on the orders before: a person, a place, a question.

Pure. Laws: a name is put in a pronoun's place only where the newest order that speaks of people
speaks of one alone, whom the pronoun fits; "there" is a place that a person named, never one of an
answer; a condition is written out by the question that the newest order looks into, and by no
other. What is not beyond doubt stays as it was said, for a brain to ask about.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.leaning_condition import WhetherThere, read_whether_there, write_condition
from planner.language.motion_guard.mentioned_names import find_places
from planner.language.person_names import people_named

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.mission.state import Mission
    from planner.plan import Vocabulary
    from planner.site.site_view import SiteView

ORDERS_BACK = 3
"""Orders before the newest one in which a person may have been spoken of."""
_HER = re.compile(
    r"(?:mom|mum|mommy|mummy|mother|grandma|grandmother|granny|nana|nan|gran|mama|wife|daughter"
    r"|sister|aunt|auntie)$"
    r"|妈|奶奶|外婆|姥姥|姐|妹|阿姨|老婆|妻|女",
    re.IGNORECASE,
)
_HIM = re.compile(
    r"(?:dad|daddy|father|grandpa|grandfather|grand?dad|gramps|papa|husband|son|brother|uncle)$"
    r"|爸|爷爷|外公|姥爷|哥|弟|叔|老公|丈夫|儿子|先生",
    re.IGNORECASE,
)
_SPEAKS = re.compile(
    r"\b(?P<verb>tell|ask|inform|remind|warn|greet|let) (?P<who>him|her|them)\b(?! own\b)"
    r"|\b(?P<to>(?:say|speak|talk)\b[^,;]*? to) (?P<who_2>him|her|them)(?=$|[ ,.;!?])",
    re.IGNORECASE,
)
_SPEAKS_ZH = re.compile(
    r"(?P<verb>告诉|通知|提醒|问一下|问问|询问|问|跟(?=[他她]们?(?:说|讲))|对(?=[他她]们?(?:说"
    r"|讲))|和(?=[他她]们?(?:说|讲))"
    r"|叫(?=[他她])|喊(?=[他她]))(?:一下)?(?P<who>他们|她们|他|她)(?P<says>说一声|说一下|说|讲)?"
)
_SPEAKS_AGAIN = re.compile(
    r"(?:(?:please|ok|okay|well|now|and|just|then|go|back|no|can you|could you)[ ,]+)*"
    r"(?:tell|ask|remind|warn|greet|call) (?P<who>him|her|them)"
    r" (?:again|once more|one more time|a second time)(?:[ ,]+(?:please|then|louder))*[.!]*",
    re.IGNORECASE,
)
_SPEAKS_AGAIN_ZH = re.compile(
    r"(?:那|你|请|麻烦|再|去|回去|,|，)*再(?:去)?(?:问|告诉|提醒|通知|叫|喊|[跟和对](?=.{1,2}[说讲]))"
    r"(?P<who>他|她)们?(?:说|讲)?(?:一?(?:遍|次|声|下))(?:吧|呗|啊)*[。！]*"
)
_SPEAKING = frozenset({"say", "ask"})
_GO_THERE = re.compile(
    r"(?P<head>(?:^|(?<=[ ,]))"
    r"(?:(?:go|drive|come|head|walk|move|pop)(?: (?:over|back|on|straight))?"
    r"|(?:wait|stay|look|look around|stand)(?: over)?))"
    r" there(?=$| (?:and|then|please|now)\b|[,.;!?])",
    re.IGNORECASE,
)
_GO_THERE_ZH = re.compile(r"(?P<head>去|到|回|回到|开到|前往)(?:那里|那儿|那边)")
_GO_BACK = re.compile(
    r"\b(?:go|head|pop|drive|nip)(?: right| straight)? back(?: (?:in )?there)?(?: again)?(?:,| and"
    r"| to) $"
    r"|(?:再)?(?:回去|过去|去)(?:再)?(?=$)",
    re.IGNORECASE,
)
"""Before an order about a person whose place is named besides."""
_WAITS = re.compile(r"(?:wait|stay|look|stand)", re.IGNORECASE)


def name_antecedents(
    text: str, orders: Sequence[Mission], facts: SiteView, names: Vocabulary
) -> str | None:
    """Return a sentence with its condition, its person and its place in full; None: as it is.

    Args:
        text: as it was said.
        orders: the orders before it, the newest first.
        facts: the site.
        names: of its places.
    """
    if not orders:
        return None
    again = (_SPEAKS_AGAIN_ZH if has_chinese(text) else _SPEAKS_AGAIN).fullmatch(text.strip())
    if again is not None:
        return _speak_again(again["who"], orders[0])
    condition = _write_condition(text, orders[0], facts)
    if condition is not None:
        return condition
    chinese = has_chinese(text)
    said = _name_person(text, orders, facts, names, chinese=chinese) or text
    return _name_place(said, orders[0], facts, names, chinese=chinese) or (
        said if said != text else None
    )


def _speak_again(who: str, last: Mission) -> str | None:
    """Return the order to say or ask the same once more; None where another person is meant."""
    people = people_named(last.order_text)
    spoke = any(step.kind in _SPEAKING for step in last.steps)
    return last.order_text if spoke and len(people) == 1 and fits(who, people[0]) else None


def _write_condition(text: str, last: Mission, facts: SiteView) -> str | None:
    looks = [step for step in last.steps if step.kind in ("look", "find")]
    if not looks:
        return None
    look, place = looks[-1], looks[-1].place
    asked = read_whether_there(last.order_text) or read_whether_there(look.text or "")
    if look.kind == "find" and look.object is not None:
        asked = WhetherThere(look.object, "")
    if asked is None or (place is not None and place not in facts.targets):
        return None
    target = facts.targets.get(place or "")
    tongue = "zh" if has_chinese(text) else "en"
    return write_condition(asked, target.name.of(tongue) if target is not None else "", text)


def _name_person(
    text: str,
    orders: Sequence[Mission],
    facts: SiteView,
    names: Vocabulary,
    *,
    chinese: bool,
) -> str | None:
    """Return a sentence with the person of an order before for "him"; None where in doubt."""
    pattern = _SPEAKS_ZH if chinese else _SPEAKS
    found = pattern.search(text)
    if found is None or len(pattern.findall(text)) > 1 or _speaks_of_people(text[: found.start()]):
        return None
    for order in orders[: ORDERS_BACK + 1]:
        if _speaks_of_people(order.order_text):
            return _put_person(text, found, order, facts, names, chinese=chinese)
    return None


_PEOPLE = re.compile(
    r"\b(?:some|any|every)(?:one|body)\b|\bpe(?:rson|ople)\b|\b(?:guest|visitor)s?\b"
    r"|\bwho\b|人|谁|客",
    re.IGNORECASE,
)


def _speaks_of_people(text: str) -> bool:
    return bool(people_named(text)) or _PEOPLE.search(text) is not None


def _put_person(
    text: str,
    found: re.Match[str],
    order: Mission,
    facts: SiteView,
    names: Vocabulary,
    *,
    chinese: bool,
) -> str | None:
    people = people_named(order.order_text)
    who = found["who"] or found.groupdict().get("who_2") or ""
    if has_chinese(order.order_text) is not chinese or len(people) > 1:
        return None
    person = people[0] if people else ("人" if chinese else "the person")
    if people and not fits(who, person):
        return None
    here = find_places(text, names)
    there = {place.id for place in find_places(order.order_text, names)}
    name = facts.targets[there.pop()].name.of("zh" if chinese else "en") if len(there) == 1 else ""
    start, end = text[: found.start()], text[found.end() :]
    if name:  # "go back and ask her": back to her
        start = _GO_BACK.sub("", start)
    if chinese:
        verb = found["verb"].replace("跟", "告诉").replace("对", "告诉").replace("和", "告诉")
        at = f"{name}的" if name and not here else ""
        return f"{start}{verb}{at}{person}{end}"
    verb = found["verb"] or found["to"]
    at = f" in the {name}" if name and not here else ""
    return f"{start}{verb} {person}{at}{end}"


def fits(pronoun: str, person: str) -> bool:
    """Tell whether a pronoun can mean a person of this name."""
    she, he = _HER.search(person) is not None, _HIM.search(person) is not None
    if pronoun.lower() in ("him", "他"):
        return not she or he
    return not he or she if pronoun.lower() in ("her", "她") else True


def _name_place(
    text: str, last: Mission, facts: SiteView, names: Vocabulary, *, chinese: bool
) -> str | None:
    """Return a sentence with the one place that the newest order named for "there"."""
    if find_places(text, names):
        return None
    there = {place.id for place in find_places(last.order_text, names)}
    found = (_GO_THERE_ZH if chinese else _GO_THERE).search(text)
    if found is None or len(there) != 1:
        return None
    name = facts.targets[there.pop()].name.of("zh" if chinese else "en")
    to = name if chinese else f" {'in' if _WAITS.match(found['head']) else 'to'} the {name}"
    return f"{text[: found.start()]}{found['head']}{to}{text[found.end() :]}"
