"""Own the Chinese ways of saying how long to go on: until it is found, until I say stop.

Pure text to text, on a normalised sentence, before any other reading. A search goes through all
rooms anyway, and the stop lane ends a walk behind somebody at any time: such an end orders nothing
more. Law: only an end of that kind goes; any other "until" stays, and is refused as a condition.
"""

from __future__ import annotations

import re

from planner.language.stop import StopReading, read_stop

_LEAD = r"(?:请|麻烦|帮我|给我|你|您|就)*"
_ROOM_BY_ROOM = (
    r"(?:去|在|到)?(?:一间(?:屋子?|房间?|房)?(?:接|挨)?(?:着)?一间(?:屋子?|房间?|房)?|一个(?:房间|屋子?)?(?:接)?(?:着)?一个(?:房间|屋子?)"
    r"|挨个儿?(?:房间|屋子?)?|逐个(?:房间|屋子?)?|(?:每一?个|所有|全部)的?(?:房间|屋子?)|每间(?:屋子?|房间?|房)?|到处|四处|全屋|满屋子)(?:里面?|都|地|去|挨个儿?)*"
)
_ON_AND_ON = r"(?:一直|不停地?|接着|继续|慢慢)"
_SEARCH = r"(?:找找看?|找一找|找一下|找下去|找)"
_FOUND = re.compile(
    rf"^(?P<a>{_LEAD}[^,。;找]*?)(?P<b>{_SEARCH})(?P<t>[^,。;找到]{{0,10}}?),?(?:你|就|再)*(?P<u>一直|直到|一直到)?"
    r"(?:找|看|瞧|搜)(?:到|见|着)(?P<t2>[^,。;]{0,10}?)了?(?P<end>为止|再停|才停|才算完)?(?P<tail>(?:[,。].+)?)$"
)
_STILL_SEARCH = re.compile(
    rf"^(?P<a>{_LEAD}[^,。;找]*?{_ON_AND_ON}[^,。;找]*?)找到(?P<t>[^,。;了]{{1,10}}?)为止(?P<tail>(?:[,。].+)?)$"
)
_NOTHING_FOUND = re.compile(
    r"(?P<f>^[^,。;]*找[^,。;]+),(?:如果|要是|万一)?(?:实在)?(?:找不[到着]|没找到|没有?|看不到)(?:的话)?,?(?:就|也就|那就)?"
    r"(?:算了|拉倒|没关系|没事儿?|不要紧)(?:了|吧)?(?P<on>,(?:你|就|直接|再|赶紧)*(?=回)|$)"
)
_FOUND_THEN_BACK = re.compile(
    r"(?P<f>^[^,。;]*找[^,。;到]+),(?:等|你|要是|如果)*(?:找|看)[到见]了?(?:的话|以后|之后)?,?(?:你|就|再|马上|赶紧)*"
    r"(?=(?:回来|回去)(?:告诉我|跟我说)?(?:一声|一下)?$)"
)
_FOLLOW = r"(?:跟着?|跟随|跟住|跟紧)"
_FOLLOWS_ON = re.compile(rf"^(?P<a>{_LEAD})(?:一直|一路|紧紧地?|老老实实地?)+(?={_FOLLOW})")
_UNTIL_SAID = re.compile(
    rf"^(?P<f>{_LEAD}{_FOLLOW}[^,。;别不停]{{0,10}}?),?(?:一直|直到|等到|到|等|除非|你)*[我他她]们?(?:说|喊|叫)[\"“]?(?P<w>[^,。;\"”了]{{1,5}}了?)[\"”]?"
    r"(?:(?:为止|的时候|之后|以后)|,?(?:你|就|才|再|可以)*停(?:下来?)?)*$"
)
_BARE = re.compile(rf"^(?P<a>{_LEAD}){_FOLLOW}(?:走|就行|就好|吧)?$")


def without_known_ends(said: str) -> str:
    """Return a sentence without an end that the order has anyhow."""
    plain = _FOUND_THEN_BACK.sub(r"\g<f>,然后", _NOTHING_FOUND.sub(_goes_on, said))
    if "找" in plain:
        plain = _search_through(plain)
    follows = _FOLLOWS_ON.sub(r"\g<a>", plain)
    stopped = _UNTIL_SAID.fullmatch(follows)
    if stopped is not None and _stops(stopped["w"]):
        follows = stopped["f"]
    elif stopped is not None:
        return said
    bare = _BARE.fullmatch(follows) if follows != plain else None
    return f"{bare['a']}跟着我" if bare is not None else follows


def _goes_on(found: re.Match[str]) -> str:
    return f"{found['f']},然后" if found["on"] else found["f"]


def _stops(word: str) -> bool:
    """Tell whether a word, said while somebody is followed, stops the robot."""
    return any(read_stop(each) is not StopReading.NONE for each in (word, word.removesuffix("了")))


def _search_through(said: str) -> str:
    """Return a search until something is found as the search that it is."""
    still = _STILL_SEARCH.fullmatch(said)
    if still is not None:
        return f"{_place_of(still['a'])}找{still['t']}{still['tail']}"
    found = _FOUND.fullmatch(said)
    if found is None or not (found["u"] or found["end"]):
        return said
    thing = _name_fully(found["t"], found["t2"])
    return f"{_place_of(found['a'])}找{thing}{found['tail']}" if thing else said


def _name_fully(one: str, other: str) -> str | None:
    """Return the fuller of two names of one thing; None where they may be two things."""
    if other in ("", "它", "他", "她", "东西", "人家"):
        return one
    if not one or other.endswith(one):
        return other
    return one if one.endswith(other) else None


def _place_of(words: str) -> str:
    """Return the words before a search without "room by room" and "on and on"."""
    return re.sub(rf"{_ROOM_BY_ROOM}|{_ON_AND_ON}", "", words)
