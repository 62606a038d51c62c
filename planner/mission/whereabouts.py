"""Say what an order means once a person says where: "the kitchen, probably", "she's in the study".

Pure. A place that is said alone answers where somebody is whom the order before names ("where is
Mum?"), or narrows the search that it asked for. Laws: the order speaks of one person, or its steps
do nothing but search for one thing; the place is named in these words, and no second one besides;
a denial, a choice or a condition is no answer. What is in doubt stays as it was said.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, place_alone, plain
from planner.language.object_names import resolve
from planner.language.person_names import is_given_name, people_named
from planner.mission.antecedents import fits
from planner.mission.outcomes import spot_at
from planner.plan import Code, GoalState

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.plan import Vocabulary
    from planner.site.site_view import SiteView

MAX_READ = 100
"""Characters; a longer sentence is an order of its own."""
_ENDS = " .!,;:。~…，；！"
_HEDGE = (
    r"(?:probably|possibly|perhaps|maybe|(?:most |very )?likely|usually|normally|surely"
    r"|definitely|certainly|still|just|always|of course|no doubt"
    r"|i(?:'d| would)? (?:think|guess|suppose|believe|reckon|imagine|bet|say|assume|expect)"
    r"|i(?:'m| am) (?:pretty |quite |fairly |almost )?sure|my guess is)"
)
_OPEN = (
    r"(?:ok|okay|well|um+|uh+|er+|oh|ah|hm+|right|alright|all right|yes|yeah|yep|sure"
    r"|please|robot|pons|actually|in that case|no worries|no problem|thanks|fine"
    r"|(?:it's|it is|he's|she's|they're) not there|nothing there\??|no luck\??|not there"
    r"|not sure|i(?:'m| am) not sure|(?:i )?(?:dunno|don't know|do not know)|no idea)"
)
_IS = (
    r"(?:'s|'ll be|'re| is| are| was| were| will be"
    r"| (?:should|must|might|may|could|ought to|has to|has got to) be)"
)
_LOOKS = (
    r"(?:try(?: looking)?|(?:go (?:and )?|just )?(?:check|search|look|have a look|take a look)"
    r"|(?:(?:have|take) )?another look|look again|let's (?:try|say)|how about|go with"
    r"|start (?:with|in))"
)
_AT = (
    r"(?:(?:over |out |down |up |back |round |through )?"
    r"(?:to|into|in|inside|at|on|by|near|around|round|next to|beside|under|underneath|beneath"
    r"|behind)) "
)
_BUSY = (
    r"(?:sitting|lying|resting|sleeping|working|reading|cooking|playing|busy"
    r"|having(?: (?!having\b)[a-z]+){1,3}?"
    r"|watching (?:tv|telly|television|a film))"
)
_LEFT_IT = (
    r"(?:i|we)(?:'ve| have)?(?: (?:may|might|must|could) have)?(?: just| last| probably)*"
    r" (?:left|put|saw|seen|had|forgot|forgotten|dropped|used) (?:it|them)"
)
_PLACE = r"(?:(?:the|my|our|your|his|her|their) )?[a-z][a-z' -]{1,30}?"
_REASON = (
    r"(?:(?:because |since |as )?(?:it|he|she|they)\b(?!.*\b(?:not|never|if|or|unless)\b|.*n't)"
    r"(?=.*\b(?:there|in|keeps?|kept|usually|always|lives?|belongs?|sits?|works?|sleeps?|working"
    r"|sleeping|reading|cooking|resting)\b)[a-z' ]{2,40}"
    r"|(?:i|we)(?:'ve| have)?(?: just| only)?(?: think)?(?: i| we)? (?:saw|left|put|had|used|heard"
    r"|met) (?:it|him|her|them)\b[a-z' ]{0,30}"
    r"|that(?:'s| is) where (?:(?:i|we)(?: usually| always| last)? (?:saw|left|put|had|used|keep"
    r"|kept)"
    r"|(?:it|he|she|they)(?:'s|'re| is| are| was| were| usually| always| lives?| sits?"
    r"| belongs?))\b"
    r"[a-z' ]{0,30})"
)
_TAIL = (
    rf"(?:{_HEDGE}|as (?:usual|always|ever)|then|again|instead|first|please|thanks|thank you|now"
    r"|right now|at the moment|today|or something|for a start|mate|love"
    rf"|{_BUSY}|(?<=,) ?{_REASON})"
)
_EN = re.compile(
    rf"(?:{_OPEN}[ ,.!;?]+)*(?:{_HEDGE}(?: that)?[ ,]+)*"
    rf"(?:(?P<who>he|she|they|it|that){_IS} (?:(?:{_HEDGE}|both|all)[ ,]+)*(?:{_BUSY} )?"
    rf"|(?P<left>{_LEFT_IT}) |(?:then )?(?:you (?:could|can|should"
    rf"|might) )?(?P<tries>{_LOOKS})(?: again)? (?:{_HEDGE}[ ,]+)*)?"
    rf"(?P<place>(?:{_AT})?{_PLACE})"
    rf"(?:[ ,]+{_HEDGE})*(?P<beside>,? (?:near|by|next to|beside|over by|on|at) {_PLACE})??"
    rf"(?P<tail>(?:[ ,.;!]+{_TAIL})*)"
)
_HEDGE_ZH = (
    r"(?:应该|可能|大概|也许|估计|好像|多半|没准|说不定|我猜|我想|我觉得|我看|一般|平时|通常|肯定"
    r"|就|还|都|是|会)"
)
_OPEN_ZH = (
    r"(?:嗯|呃|哦|噢|啊|那么?|好的?|好吧|行|没事|没关系|不知道|不清楚|不太清楚|我不知道"
    r"|我也不知道|机器人"
    r"|[它他她]?不在(?:那儿|那里|那边)|没有吗?|没(?:找|看)到吗?|谢谢|[,?])"
)
_TAIL_ZH = (
    r"(?:(?:做饭|看电视|睡觉|休息|洗澡|看书|写作业|玩|干活)呢?|吧|咯|啰|喽|呗|啦|呀|啊|哦|哈|了|的"
    r"|好了|试试看?|里面?|那边|那儿|那里|里头|应该|可能|大概"
    r"|我猜|我想"
    r"|老地方|先|再说|谢谢)"
)
_SEEKS_ZH = r"(?:找一?找看?|找找看|找一下|再?看一?看|再?看一下|瞧瞧|瞅瞅|问问看?|问一下)"
_REASON_ZH = (
    r",(?:因为)?(?:[他她它]们?|东西|我)?(?!.*[不没别])(?:应该|可能|大概|一般|平时|总是|老是|刚才"
    r"|刚刚|早上|今早|今天|昨天"
    r"|经常|常|好像|估计|就|还|肯定|多半)*(?:在|放|见|看见|看到)(?:过|着)?[它他她]?(?:在)?(?:那"
    r"|那里|那儿|那边|里面|老地方)?"
    r"(?:的|了|过|呢|吧|呀|啊)*"
)
_ZH = re.compile(
    rf"{_OPEN_ZH}*(?:[^,他她它在去]{{1,6}}[啊呀嘛],)?"
    rf"(?:你?(?P<goes>再去|再到|去|到|再?试试看?|再看看|看看)"
    rf"|我(?:{_HEDGE_ZH}|记得)*(?:把它)?(?P<left>放|丢|落|忘|搁)在"
    rf"|(?P<who>[他她它])们?(?:{_HEDGE_ZH})*在|(?:{_HEDGE_ZH})*在?)"
    rf"(?P<place>[^,，。;！？!?他她它我你不没别还]{{1,8}}?)(?:底下|下面|下边|后面|后边|背后)?"
    rf"(?P<seeks>{_SEEKS_ZH})?{_TAIL_ZH}*(?P<reason>{_REASON_ZH})?{_TAIL_ZH}*"
)
_ALL = (
    r"(?:all (?:of )?(?:them|(?:the )?rooms)|them all|every(?:where| room| one of them)"
    r"|any(?:where| of them| room)|all over the (?:house|place|flat)|the (?:whole"
    r"|entire) (?:house|flat|place|home|apartment))"
)
_OTHERS = (
    r"(?:(?:in )?(?:the |all the |some )?other rooms|(?:in )?another room|somewhere else|elsewhere"
    r"|the others|the rest(?: of (?:them|the (?:rooms|house|flat)))?)"
)
_EVERYWHERE = re.compile(
    rf"(?:{_OPEN}[ ,.!;]+)*(?:{_HEDGE}[ ,]+)*(?:you (?:could|can) )?(?:just )?"
    rf"(?:(?P<tries>{_LOOKS})(?: again)? )?(?:(?:in|through) )?(?:{_ALL}"
    rf"|(?P<others>{_OTHERS}))(?:[ ,]+{_TAIL})*"
)
_EVERYWHERE_ZH = re.compile(
    rf"{_OPEN_ZH}*(?:你)?(?:就|都|再|先|给我|帮我)*(?:去|到|在)?"
    r"(?:到处|每个?(?:房间|屋子?|地方)|所有(?:的)?(?:房间|屋子?|地方)|全部(?:的)?(?:房间|屋子?"
    r"|地方)?|全家|家里|哪个?(?:房间|儿|里)?都行?"
    r"|(?P<others>别的?(?:房间|屋子?|地方)|其他(?:的)?(?:房间|屋子?|地方)|其它(?:的)?(?:房间|屋子?"
    r"|地方)|别处))?"
    rf"(?:都|全|也|挨个|一个个)*{_SEEKS_ZH}?(?:一遍)?{_TAIL_ZH}*"
)
_ALL_ZH = re.compile(
    r"到处|每个?(?:房间|屋|地方)|所有|全部|全家|都(?:去|再)?[找看问瞧]|别处|(?:别"
    r"|其[他它])的?(?:房间|屋|地方)"
)
_WHO, _WHO_ZH = re.compile(r"\b(?:him|her)\b"), re.compile(r"[他她](?!们)")
_NAMED = re.compile(
    r"(?:(?:oh|well|it's|that's)[ ,]+)*(?P<person>(?:(?:my"
    r"|our) )?[a-z]{2,12})(?:[ ,]+of course)?[,.;]*"
    r" (?:(?:he|she)(?:'s| is)(?: probably)?|who(?:'s| is)) (?P<place>(?:in|at|by) .{3,30}|.{3,30})"
)
_NAMED_ZH = re.compile(
    r"(?:是|就是|当然是|叫)?(?P<person>[^,在]{1,6}?)(?:啊|呀|嘛|吧)?,?(?:[他她])?(?:现在|应该|就"
    r"|还)*在(?P<place>[^,]{1,8}?)(?:呢|吧)?"
)
_DENIES = re.compile(
    r"\b(?:not|never|or|if|unless|but|except|don't)\b|n't\b|不是|别去|不去|或|还是|如果|要是|除"
)
_UNSURE = re.compile(
    r"(?:(?:it|he|she|they)(?:'s|'re| is| are) )?not there[ ,.!;]|"
    r"(?:i )?(?:dunno|don't know|do not know)|not sure|i(?:'m| am) not sure"
)
_MISSED = re.compile(
    r"(?:(?:ok|okay|oh|well|right)[ ,]+)*(?:(?:it|he|she|they)(?:'s|'re| is| are) not there"
    r"|not there|nothing there|no luck)[ ,.!;?]|[它他她]?不在那|没(?:有|找到|看到)吗?[,?]"
)
"""Says that the search before found nothing, and what follows is where to go on."""
_THEN = re.compile(r"^(?:(?:ok|okay|right|well)[ ,]+)?then (?=(?:in )?(?:the|my|our) )")
_OWNED = re.compile(r"^(?:his|her|their) ")
THEM = {"he": "him", "she": "her", "他": "他", "她": "她"}
_SOUGHT = frozenset({"find", "go_to", "patrol"})


def answer_whereabouts(text: str, last: Mission, facts: SiteView, names: Vocabulary) -> str | None:
    """Return the order before with the place that a person says now; None where in doubt.

    Args:
        text: as it was said.
        last: the newest order.
        facts: the site.
        names: of its places.
    """
    said = plain(text).strip(_ENDS)
    chinese = has_chinese(said)
    bare = "".join(said.split()).replace("，", ",").replace("。", ",") if chinese else said
    if not 0 < len(bare) <= MAX_READ or text.rstrip().endswith(("?", "？")):
        return None
    if _DENIES.search(bare if chinese else _UNSURE.sub("", bare)):
        return None
    if (everywhere := _search_everywhere(bare, last, chinese=chinese)) is not None:
        return everywhere
    if not chinese and last.has_ended:
        bare = _THEN.sub("try ", bare)  # the search that is over is followed by another
    if (named := _name_somebody(bare, last, facts, names, chinese=chinese)) is not None:
        return named
    found = (_ZH if chinese else _EN).fullmatch(bare)
    place = _place_of(found, facts, names, chinese=chinese) if found is not None else None
    if found is None or place is None:
        return None
    who = found["who"] or ""
    asked = _asked_person(last, names)
    if asked is not None:
        name = facts.targets[place].name.of("zh" if has_chinese(last.order_text) else "en")
        return put_person_at(last.order_text, asked, name, who)
    thing = sought_thing(last)
    if thing is None or (who in THEM and not _is_somebody(thing)):
        return None
    return _narrow(found, last, place, facts, names, chinese=chinese)


def sought_thing(last: Mission) -> str | None:
    """Return the one thing that an order does nothing but search for; None where it does more."""
    things = {step.object for step in last.steps if step.kind == "find"}
    if not last.steps or len(things) != 1 or any(step.kind not in _SOUGHT for step in last.steps):
        return None
    thing = re.sub(
        r"^(?:the|my|our|your|an?|some|any) ", "", things.pop() or "", flags=re.IGNORECASE
    )
    return thing or None


def _is_somebody(thing: str) -> bool:
    kind = resolve(thing)
    return kind is not None and kind[0] == "person"


def is_search_open(last: Mission) -> bool:
    """Tell whether a search goes on, or ended without what it was for."""
    found = last.outcome is not None and last.outcome.code is Code.FOUND
    return not last.has_ended or not (found or last.state is GoalState.SUCCEEDED)


def _name_somebody(
    bare: str, last: Mission, facts: SiteView, names: Vocabulary, *, chinese: bool
) -> str | None:
    """Return "call my wife in the bedroom" of "call her", once a person says who and where."""
    order, plan = plain(last.order_text), last.plan
    asks = last.state is GoalState.NEEDS_CLARIFICATION and plan is not None and not last.steps
    who = (_WHO_ZH if chinese else _WHO).findall(order)
    found = (_NAMED_ZH if chinese else _NAMED).fullmatch(bare)
    if not asks or found is None or len(who) != 1 or find_places(order, names):
        return None
    person = found["person"]
    if people_named(order) or not (is_given_name(person) and fits(who[0], person)):
        return None
    place = place_alone(found["place"], names) if found["place"] else None
    if place is None:
        return None
    at = facts.targets[place].name
    put = f"{at.zh}的{person}" if chinese else f"{person} in the {at.en}"
    return (_WHO_ZH if chinese else _WHO).sub(lambda _: put, order)


def _place_of(
    found: re.Match[str], facts: SiteView, names: Vocabulary, *, chinese: bool
) -> str | None:
    """Return the one place of an answer: of "the study, by the desk" the desk in it."""
    words = found["place"] if chinese else _OWNED.sub("", re.sub(rf"^{_AT}", "", found["place"]))
    place = place_alone(words, names)
    beside = None if chinese else found["beside"]
    if place is None or beside is None:
        return place
    inner = place_alone(
        re.sub(r"^,? ?(?:near|by|next to|beside|over by|on|at) ", "", beside), names
    )
    if inner is None or spot_at(facts, facts.targets[inner].pose).room != place:
        return None
    return inner


def _asked_person(last: Mission, names: Vocabulary) -> str | None:
    """Return the one person of an order that waits until somebody says where that person is."""
    if find_places(last.order_text, names):
        return None
    people = people_named(last.order_text)
    plan = last.plan
    asks = (
        last.state is GoalState.NEEDS_CLARIFICATION
        and plan is not None
        and plan.code is Code.INCOMPLETE
    )
    seeks = any(step.kind == "find" and step.place is None for step in last.steps)
    return people[0] if len(people) == 1 and (asks or (seeks and not last.has_ended)) else None


def put_person_at(order: str, person: str, place: str, who: str) -> str | None:
    """Return "tell Dad in the study …" of "tell Dad …"."""
    if who in ("it", "that", "它") or (who in THEM and not fits(THEM[who], person)):
        return None
    words = plain(order)
    if has_chinese(order):
        at = words.find(plain(person))
        return f"{words[:at]}{place}的{words[at:]}" if at >= 0 else None
    named = re.search(rf"\b{re.escape(person)}\b(?!'s)", order, re.IGNORECASE)
    if named is None:
        return None
    return f"{order[: named.end()]} in the {place}{order[named.end() :]}"


def _narrow(
    found: re.Match[str],
    last: Mission,
    place: str,
    facts: SiteView,
    names: Vocabulary,
    *,
    chinese: bool,
) -> str | None:
    """Return the search of one place; None where the words are an order, or tell of something."""
    tells = bool(found["who"])
    if chinese:
        goes, sure = found["goes"] or "", bool(found["reason"])
        alone = goes in ("去", "到") and not (found["seeks"] or sure)
        tells = tells or bool(found["left"]) or (goes in ("去", "到", "看看") and not sure)
    else:
        alone = False
        orders = re.search(r"\b(?:check|search|look)\b", found["tries"] or "")
        anew = re.search(r"\b(?:another|again)\b", f"{found['tries']}{found['tail']}")
        tells = tells or bool(found["left"]) or (orders is not None and anew is None)
    placed = {each.id for each in find_places(last.order_text, names)}
    bare = not (found["tries"] if not chinese else found["goes"])
    open_ = is_search_open(last) or _MISSED.match(found[0]) is not None
    if alone or (tells and not open_) or (bare and not tells and placed):
        return None
    return search_of_place(last, place, facts)


def search_of_place(last: Mission, place: str, facts: SiteView) -> str | None:
    """Return the search of one place in place of all that an order searches for its one thing."""
    thing = sought_thing(last)
    if thing is None:
        return None
    target = facts.targets[place]
    if has_chinese(thing):
        return f"去{target.name.zh}找{thing}"
    return f"look for the {thing} {'in' if target.room else 'near'} the {target.name.en}"


def _search_everywhere(bare: str, last: Mission, *, chinese: bool) -> str | None:
    """Return the search of the whole home that "try all of them" asks for."""
    thing = sought_thing(last)
    found = (_EVERYWHERE_ZH if chinese else _EVERYWHERE).fullmatch(bare)
    if thing is None or found is None or (chinese and not _ALL_ZH.search(bare)):
        return None
    return f"到处找{thing}" if has_chinese(thing) else f"look for the {thing} in every room"
