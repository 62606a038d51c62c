"""Read English words about the standing orders that are kept: list, move, skip a day, remove, pause.

Pure, on folded text, whole sentences only. An order is called by its number, by a word of it, or by
its time; which one that is, is for the desk to find. Law: words that are no time, no day and no
length change nothing ("make it quick").
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.schedule.command import (
    ChangeOrders,
    CorrectOrder,
    Delay,
    LeaveOutDays,
    ListOrders,
    RemindAgain,
    Retime,
    ask_days,
)
from planner.language.schedule.parts import (
    After,
    DayPart,
    OnceDay,
    WeekDays,
    end_of_pause,
)
from planner.language.schedule.time_finder import reads_timing, whole_parts

if TYPE_CHECKING:
    from planner.language.schedule.command import Act, FoundChange
    from planner.language.schedule.parts import Part


KINDS = (
    r"(?:reminders?|standing orders?|routines?|schedules?|scheduled (?:tasks?|orders?|jobs?)"
    r"|timers?|alarms?|recurring (?:tasks?|orders?)|daily (?:tasks?|orders?))"
)
MY = (
    r"(?:(?:all(?: of)?|both(?: of)?|every(?: single| last)?|each) )?"
    r"(?:the|my|your|our|this|that|those|these)? ?"
)
_GAVE = r"(?:have i|did i|have we|did we) (?:ask(?:ed)?|told|tell|give|given) you to do"
_LIST = re.compile(
    r"what (?:do you do|are you doing) (?:for (?:me|us) )?(?:regularly|by yourself|(?:every|each) day)"
    rf"|(?:what|which) (?:are )?{MY}{KINDS}(?: (?:do (?:i|you|we) have|(?:are|did|have) (?:i |there )?"
    rf"(?:got|set|given|active|made)|are there|are you keeping))?|what(?:'s| is)(?: on)? {MY}schedule"
    rf"|(?:list|show|read|tell)(?: me)?(?: out)? {MY}{KINDS}"
    rf"|(?:(?:do (?:i|we) have|are there|is there|have (?:i|we) got) )?(?:any )?{KINDS}(?: set| left)?"
    rf"|what {_GAVE}(?: regularly| so far)?"
    rf"|(?:what|which) (?:{KINDS}|orders|jobs|tasks|chores|duties) (?:(?:have|did) (?:i|we) (?:give|given|gave"
    r"|set|tell|told|ask|asked|left)\b.*|(?:are|do) you (?:still )?(?:keep|keeping|have)\b.*)"
    r"|(?:tell me|show me|list) what (?:you|i|we)(?:'ve| have)(?: got)? (?:planned|scheduled|set up)"
)
_AT_TIME = re.compile(
    rf"what (?:do you do(?: for (?:me|us))?|will you do|are you going to do|{_GAVE})(?: for| on)? (?P<a>.+)"
    r"|(?:what(?:'s| is)|is there anything|anything|is anything) (?:on|planned|due|scheduled|coming up)"
    r"(?: for| on)? (?P<b>.+)"
    r"|(?:do (?:i|we) have|have (?:i|we) got) anything(?: on| planned| set)?(?: for)? (?P<c>.+)"
)
_LEFT = re.compile(
    r"how (?:long|much (?:time|longer)|many minutes)(?: more)?(?: (?:have i got|do i have|is there|is))?"
    rf"(?: (?:left|remaining|to go))+(?: (?:on|for|until|till|before) {MY}(?P<a>.+))?"
    rf"|how (?:long|much (?:time|longer)) (?:is it )?(?:until|till|before) {MY}(?P<b>.*?{KINDS}.*)"
)
_NEXT = re.compile(
    rf"(?:when|what time|at what time)(?: is|'s| are| do| does| will| did i set)? {MY}(?:next )?"
    rf"(?P<what>[a-z0-9' -]*? )?(?P<kind>{KINDS})"
    r"(?: (?:for|about|to|of|at|that says?) (?P<of>.+?))?"
    r"(?: (?:due|next|set for|set|go off|ring|come|fire|be))*"
    r"|(?:when|what time|at what time) (?:will|do|are) you (?:next )?(?:going to )?(?:remind(?:ing)?"
    r"|(?P<wake>wak(?:e|ing))) me(?: up)?(?: (?:of|about|to|that) (?P<of2>.+?))?(?: next)?"
)
_OFTEN = (
    r"(?:evening|morning|afternoon|night|nightly|daily|hourly|weekly|weekday|weekend|noon|monday"
    r"|tuesday|wednesday|thursday|friday|saturday|sunday|recurring|scheduled|standing)"
)
_ACTS: tuple[tuple[Act, str], ...] = (
    ("remove", r"(?:i|we) (?:don't|do not|no longer) need|cancel|delete|remove|drop|stop|end|forget|clear|get rid of|no more|turn off"
     r"|switch off|call off|don't do|do not do|quit"),
    ("pause", r"pause|suspend|mute|skip"),
    ("resume", r"resume|continue|restart|unpause|re-?enable|turn on|switch on|start|carry on with"),
)  # fmt: skip
_TAIL = r"(?: (?:any ?more|any longer|again|for now|for good|from now on|now|please))*"
_NAMED = re.compile(
    rf"(?:{MY}(?P<kind>{KINDS})(?: (?:for(?! now)|about|to|of|at|with|that says?) (?P<of>.+?))?"
    rf"|{MY}(?P<what>.+?) (?P<kind2>{KINDS})"
    rf"|(?:the |my |your )?(?P<often>{_OFTEN}(?: (?!again\b)[\w'-]+){{1,3}})"
    r"|(?:standing )?(?:order|reminder|number)? ?(?P<id>o\d{1,6})"
    rf"|the one(?:s)? (?P<one>.+?)|(?:the|my|that|this) (?P<called>.+?) ones?){_TAIL}"
)
_ONE = re.compile(r"reminder|alarm|timer|(?:standing|recurring|scheduled|daily) (?:order|task|job)")
_UNTIL = re.compile(r"(?P<rest>.+?) (?P<words>(?:until|till|up to) (?P<t>.+)|for (?P<for>.+))")
_REMINDING = re.compile(
    rf"(?:(?:stop|quit) reminding me|(?:don't|do not|never) remind me)"
    rf"(?: (?:to|about|of|that) (?P<of>.+?))?{_TAIL}"
)
_NOT_ANY_MORE = re.compile(
    rf"(?:don't|do not|never|stop|quit|no more) (?!let me forget|remind)(?P<what>.+?){_TAIL}"
)
_EVER = re.compile(
    r".+ (?:in the (?:morning|afternoon|evening)s?|at (?:night|noon)|(?:at|on) weekends?)"
)
_LEAVES_OUT = re.compile(
    r"(?P<no>(?:don't|do not|you needn't|(?:you )?(?:don't|do not) (?:have|need) to|no|there's no need to)"
    r" (?!more\b|forget\b|let me\b|fail\b)|(?:skip|leave out|cancel|drop) )(?P<what>.+)"
)
_SEVERAL = re.compile(
    r"[,;.:]|\b(?:if|unless|until|till|before|after|when|or|but|instead|only|then|every|each|at (?:\d|noon))\b"
)
_NO = r"(?:(?:no|nope|sorry|oops|wait|actually|ah|oh|i mean|rather)[ ,.!]+)*"
_IT = r"(?:it|that|this|them)"
_W = r"(?:(?:the|my|that|this|your|our) )?(?P<w>[a-z0-9' -]{2,60}?)"
_TO = r"(?:to|at|for|on|into|until|till)"
_INSTEAD = r"(?: (?:instead|rather|then|from now on))?"
_MOVE = r"(?:make|set|put|change|move|shift|switch|reschedule|push|postpone)"
_RETIME = (
    re.compile(
        rf"{_NO}(?:let's |i'd rather )?{_MOVE} {_IT} (?:back |forward )?(?:{_TO} )?(?P<t>.+?){_INSTEAD}"
        r"(?:,? (?:and )?not (?P<o>.+?)| instead of (?P<o2>.+?))?"
    ),
    re.compile(rf"{_NO}(?P<t>.+?)(?:,? (?:and )?not| instead of| (?:is|would be) better than) (?P<o>.+?)"),
    re.compile(rf"{_NO}not (?P<o>.+?)(?:,| but|, but) (?:rather )?(?P<t>.+?)"),
    re.compile(rf"{_NO}(?:let's (?:do|say|have) )?(?P<t>.+?) (?:instead|rather)"),
    re.compile(rf"{_NO}(?:i (?:meant?|said)|(?:it|that) (?:should|has to|must) be)(?: {_TO})? (?P<t>.+?)"),
    re.compile(r"(?:(?:no|nope|sorry|oops|wait|actually|rather)[ ,.!]+)+(?P<sure>(?:at|every|on|in) .+?)"),
)  # fmt: skip
_DAYS = re.compile(
    rf"{_NO}(?:but |and )?(?:(?P<not>not|never|except|without)|only|just)(?: (?:on|for|at))?(?: the)?"
    r" (?P<d>[a-z, ]+?)(?: please)?"
)
_SHIFTS, _WAYS = "push|postpone|delay|put|move|bring|shift", "back|off|out|forward|up"
_LATER = re.compile(
    rf"{_NO}(?:(?:make|do|set) {_IT} )?(?P<n>.+?) (?P<way>later|earlier|sooner)"
    rf"|{_NO}(?P<act>{_SHIFTS}) (?:{_IT}|{_W})(?: (?P<dir>{_WAYS}))? (?:by )?(?P<n2>(?:\d|an? |half |[a-z]+ m|[a-z]+ h).*)"
)
_AGAIN = re.compile(
    r"(?:hit )?snooze(?: (?:it|that|this|(?:the|my) (?:alarm|reminder)))?(?: (?:for|by) (?P<a>.+))?"
    r"|(?:remind|wake) me (?:up )?(?:again )?(?:a (?:bit|little) )?later(?: on)?"
    r"|(?:remind|wake) me (?:up )?again in (?P<b>.+?)|not (?:now|yet)[, ]+(?:but )?remind me (?:again )?in (?P<c>.+)"
    r"|(?:give me |just |i need )?(?:another (?P<d>.+?)|(?P<e>[a-z0-9 ]+?) more (?P<u>[a-z]+))"
)
_RENAMED = re.compile(rf"{_MOVE} (?:the|my|that|this|your|our) (?P<w>[a-z0-9' -]{{2,60}}?)")


def read_asked(folded: str) -> ListOrders | None:
    """Return what a sentence asks about standing orders; None where it asks nothing of them."""
    if _LIST.fullmatch(folded) is not None:
        return ListOrders()
    at_time = _AT_TIME.fullmatch(folded)
    if at_time is not None:
        words = next(text for text in at_time.groupdict().values() if text)
        words = re.sub(r"\b(morning|afternoon|evening|night)s\b", r"\1", words)
        return ask_days(_first(words, ("", "on ", "every ")), words)
    left = _LEFT.fullmatch(folded)
    if left is not None:
        named = left["a"] or left["b"] or ""
        kind = re.search(rf"\b{KINDS}\b", named)
        which = re.sub(rf"\b{KINDS}\b(?: (?:for|about|to|of))?", "", named).strip()
        reminds = kind is not None and kind[0].startswith("reminder")
        return ListOrders(which, reminders=reminds, next_runs=True, is_sure=kind is not None)
    asked = _NEXT.fullmatch(folded)
    if asked is None:
        return None
    which = asked["of2"] or asked["of"] or asked["what"] or ("wake" if asked["wake"] else "")
    kinds = asked["kind"] or "reminder"
    return ListOrders(which.strip(), reminders=kinds.startswith("reminder"), next_runs=True)


def read_change(folded: str) -> ChangeOrders | None:
    """Return which orders are removed, paused, resumed or left out on a day; None: none are."""
    if (skipped := _read_skip(folded)) is not None:
        return skipped
    reminding = _REMINDING.fullmatch(folded)
    if reminding is not None:
        return ChangeOrders("remove", reminding["of"] or "", reminders=True)
    for act, verbs in _ACTS:
        verb = re.match(rf"(?:{verbs}) ", folded)
        if verb is not None:
            rest = folded[verb.end() :]
            timed = _read_until(rest) if act == "pause" else None
            if (found := timed or _read_named(act, rest)) is not None:
                return found
    denied = _NOT_ANY_MORE.fullmatch(folded)
    if denied is None:
        return None
    again = reads_timing(denied["what"], in_chinese=False)
    more = folded.endswith(("more", "longer")) or folded.startswith(("stop", "no more"))
    if again or _EVER.fullmatch(denied["what"]):
        return ChangeOrders("remove", denied["what"], is_sure=again)
    known = more and not re.match(r"no more |stop ", folded)
    return ChangeOrders("remove", denied["what"], is_sure=False) if known else None


def _read_skip(folded: str) -> ChangeOrders | None:
    """Read "don't wake me tomorrow", "skip the check tonight", "no pills on Saturday"."""
    found = _LEAVES_OUT.fullmatch(folded)
    if found is None or _SEVERAL.search(found["what"]) is not None:
        return None
    said = found["what"]
    for cut in re.finditer(r" ", said):
        parts = whole_parts(said[cut.end() :], in_chinese=False)
        days = [part for part in parts if isinstance(part, OnceDay)]
        if len(days) != 1 or any(not isinstance(part, (OnceDay, DayPart)) for part in parts):
            continue
        words = re.sub(r"^(?:the|my|your|our) | for$", "", said[: cut.start()])
        by_id = re.fullmatch(r"(?:order |reminder )?(o\d{1,6})", words)
        remind = re.fullmatch(r"remind me(?: (?:to|about|of|that) (?P<of>.+))?", words)
        called = remind or re.fullmatch(r"(?P<of>.*?) ?\b(?:reminders?|alarms?)", words)
        which = by_id[1] if by_id is not None else words
        which = called["of"] or "" if called is not None else which
        part = next((part for part in parts if isinstance(part, DayPart)), None)
        if part is not None and days[0].ahead != 0:  # of two a day the one is meant
            which = f"{which} in the {part.value}".strip()
        return ChangeOrders(
            "skip", which, reminders=called is not None, day=days[0],
            until_words=said[cut.end() :], is_sure=False,
            is_single=not which and words.endswith(("reminder", "alarm")),
        )  # fmt: skip
    return None


def _read_until(rest: str) -> ChangeOrders | None:
    """Read "the evening check until Monday", "my reminders for a week"."""
    found = _UNTIL.fullmatch(rest)
    named = _read_named("pause", found["rest"]) if found is not None else None
    if found is None or named is None:
        return None
    leads, words = (("", "on ", "at "), found["t"]) if found["t"] else (("in ",), found["for"])
    ends = (end_of_pause(whole_parts(lead + words, in_chinese=False)) for lead in leads)
    until = next((each for each in ends if each is not None), None)
    return None if until is None else replace(named, until=until, until_words=found["words"])


def _read_named(act: Act, rest: str) -> ChangeOrders | None:
    found = _NAMED.fullmatch(rest)
    if found is None:
        return None
    kind = found["kind"] or found["kind2"] or ""
    names = ("of", "what", "often", "id", "one", "called")
    which = next((found[name] for name in names if found[name]), "")
    if re.search(r"\bor\b|,", which) is not None:
        return None  # a choice, or a second order
    if found["one"] and not reads_timing(found["one"], in_chinese=False):
        return None
    every = rest.startswith(("all", "every", "each", "both"))
    alone = bool(found["kind"]) and not which and _ONE.fullmatch(kind) is not None
    return ChangeOrders(
        act, which.strip(), reminders="reminder" in kind, is_single=alone and not every,
        is_every=every, is_sure=not found["called"],
    )  # fmt: skip


def read_correction(folded: str) -> CorrectOrder | ChangeOrders | None:
    """Return how a sentence moves an order, or which days it leaves out of it; None: it does not."""
    once = _read_one_day(folded)
    if once is not None:
        return once
    found = _read_again(folded) or _read_later(folded) or _read_days(folded) or _read_time(folded)
    if found is None:
        return None
    change, which, words = found
    sure = re.search(r"\b(?:reminder|alarm|timer|standing order|routine)s?\b", which) is not None
    return CorrectOrder(change, words or folded, which, is_sure=sure)


def _read_again(said: str) -> FoundChange | None:
    found = _AGAIN.fullmatch(said)
    if found is None:
        return None
    lasts = next((found[name] for name in "abcd" if found[name]), None)
    lasts = f"{found['e']} {found['u']}" if found["e"] else lasts
    if lasts is None:
        return RemindAgain(), "", ""
    seconds = _lasts(re.sub(r"^(?=(?:hour|minute)s?$)", "one ", lasts))
    return None if seconds is None else (RemindAgain(seconds), "", "")


def _read_later(said: str) -> FoundChange | None:
    found = _LATER.fullmatch(said)
    lasts = (found["n"] or found["n2"]) if found is not None else ""
    seconds = _lasts(lasts) if lasts else None
    if found is None or seconds is None:
        return None
    way = found["way"] or found["dir"]
    early = way in ("earlier", "sooner", "forward", "up") or found["act"] == "bring"
    words = f"make it {lasts} {'earlier' if early else 'later'}"
    return Delay(-seconds if early else seconds), found["w"] or "", words


def _read_days(said: str) -> FoundChange | None:
    found = _DAYS.fullmatch(said)
    parts = _first(found["d"], ("on ", "every ", "at ")) if found is not None else ()
    if found is None or len(parts) != 1:
        return None
    if isinstance(parts[0], OnceDay) and parts[0].weekday is not None and not found["not"]:
        return LeaveOutDays(frozenset({(parts[0].weekday + 1) % 7}), keeps=True), "", ""
    days = parts[0].days if isinstance(parts[0], WeekDays) else None
    return None if days is None else (LeaveOutDays(days, keeps=not found["not"]), "", "")


def _read_one_day(said: str) -> ChangeOrders | None:
    """Read "not on Sunday", "not tomorrow": one day of the order that was spoken of last."""
    found = _DAYS.fullmatch(said)
    parts = _first(found["d"], ("", "on ")) if found is not None and found["not"] else ()
    if len(parts) != 1 or not isinstance(parts[0], OnceDay):
        return None
    return ChangeOrders("skip", "", day=parts[0], until_words=found["d"], is_spoken=True,  # type: ignore[index]
                        is_sure=False)  # fmt: skip


def _read_time(said: str) -> FoundChange | None:
    for pattern in _RETIME:
        found = pattern.fullmatch(said)
        if found is None:
            continue
        group = found.groupdict()
        old = group.get("o") or group.get("o2")
        sure = group.get("sure")
        parts = whole_parts(sure, in_chinese=False) if sure else _time(group["t"])
        before = _time(old) if old else ()
        if parts and (before or not old):
            return Retime(parts, before), "", ""
    for cut in re.finditer(rf" (?:{_TO} |(?=every |daily|hourly))", said):
        named, parts = _RENAMED.fullmatch(said[: cut.start()]), _time(said[cut.end() :])
        if named is not None and parts:
            return Retime(parts), named["w"], f"make it {said[cut.end() :]}"
    return None


def _time(words: str) -> tuple[Part, ...]:
    """Return the parts of a time that may be said without its "at"."""
    return _first(re.sub(rf"{_INSTEAD}$", "", words), ("", "at ", "on ", "in "))


def _first(words: str, leads: tuple[str, ...]) -> tuple[Part, ...]:
    found = (whole_parts(lead + words, in_chinese=False) for lead in leads)
    return next((parts for parts in found if parts), ())


def _lasts(words: str) -> float | None:
    parts = whole_parts(f"in {words}", in_chinese=False)
    return parts[0].seconds if len(parts) == 1 and isinstance(parts[0], After) else None
