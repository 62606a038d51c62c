"""Read English orders: what vetoes a sentence, where clauses end, and what a clause can mean.

A clause is read whole or not at all; the rules name every word that they pass over.
"""

from __future__ import annotations

import re

from planner.brain.offline.grammar import (
    QUOTE,
    Build,
    Grammar,
    about,
    come_back,
    drive_into,
    drive_to,
    home,
    lacks,
    next_place,
    route,
    say,
    set_out,
    stand,
    wait,
)
from planner.brain.offline.lexicon import MARK
from planner.brain.offline.meaning import Rule, Topic
from planner.brain.offline.numbers import EN_DURATION
from planner.plan import Code

_GO = (
    r"(?:go|drive|move|head|walk|navigate|travel|proceed|run|roll|come|return|get|continue)"
    r"(?: (?:back|over|straight|directly|on|down|up|out|along|ahead|right|off))?"
)
_LEAD = r"(?:take|lead|guide|bring|show|escort|accompany|walk) (?:me|us)(?: the way)?"
_PERSON = (
    r"(?:me|him|her|them|us|(?:the |a |that )?(?:person|man|woman|people|someone|somebody|boy|girl)"
    r"\b.*)"
)
_ORIGIN = (
    r"(?:(?:the |your )?(?:start|starting (?:point|position|place)|origin)"
    r"|where (?:you|we|i) (?:started|were|are|am|are now|began|came from|left)(?: from)?"
    r"|(?:this|the same) (?:place|spot|position))"
)
_DOCK = (
    r"(?:the |your )?(?:(?:charging |docking )?(?:dock|station|point)|charger|base|home)"
    r"(?: station)?"
)
_CAMERA = (
    r"(?:find|locate|look|search|seek|spot|pinpoint|identify|detect|see|watch|check|inspect|"
    r"observe|scan|count|describe|recogni[sz]e|follow|meet|greet|face|contact|escort|accompany|"
    r"guide|lead|introduce|photograph|explore|monitor|come after|go after|how many|is there|"
    r"are there|who is|what do you see|what is (?:in|on|there)|(?:do|did) you see|point (?:at|to)|"
    r"tell me (?:how many|what|which|who|the (?:name|pose|gender|colou?r|number)))\b.*"
)
_ARM = (
    r"(?:bring|fetch|get|grab|grasp|pick|put|place|take|carry|deliver|give|hand|hold|lift|drop|"
    r"pour|open|close|shut|push|pull|press|turn (?:on|off)|switch|clean|wash|wipe|sweep|vacuum|mop|"
    r"cook|bake|make|prepare|serve|dump|throw|distribute|arrange|set|offer|handshake|shake|collect|"
    r"gather|pack|load|unload|transport|stack|fill|retrieve|provide|remove|water|feed|plug|unplug|"
    r"move the|sort|tidy)\b.*"
    r"|.*\b(?:bring|fetch|grab|grasp|deliver|pick up|put down)\b.*"
)
_TALK = (
    r"(?:answer|tell|talk|speak|ask|say|sing|dance|play|remind|call|report|explain|read|repeat|"
    r"wave)\b.*"
)
_RELATIVE = (
    r"(?:(?:move|go|drive|walk|come|step|roll) )?(?:a (?:bit|little) )?"
    r"(?:forwards?|ahead|straight|backwards?|left|right|closer|away|sideways|in circles?)\b.*"
    r"|(?:turn|rotate|spin|reverse|back up|patrol|wander|roam|circle|orbit|park)\b.*"
    r"|(?:move|go|drive|walk) (?:for )?(?:about )?(?:back )?\d.*"
    r"|(?:move|go|drive|walk) to the (?:left|right|front)\b.*"
)
_WHERE = (
    r"where are (?:you|we)(?: (?:now|at|right now|currently|located))?|where is (?:the|my) robot"
    r"|(?:what is|tell me) (?:your|the) (?:current )?(?:location|position)|tell me where you are"
    r"|(?:which|what) (?:room|place) are you (?:in|at)|what (?:room|place) is this"
    r"|(?:report )?your (?:location|position)"
)
_PLACES = (
    r"(?:what|which) (?:places|rooms|locations) (?:do you know|are there|can you go to|exist)"
    r"|where can you (?:go|drive)|what can you do|help"
    r"|(?:list|show me|tell me|name) (?:all )?(?:the |your )?(?:known )?(?:places|rooms|locations)"
)
_HELLO = (
    r"hello|hi|good (?:morning|afternoon|evening|night)|goodbye|bye|thank you|thanks|welcome"
    r"|i am (?:here|back|ready)"
)


def _rule(pattern: str, build: Build) -> Rule:
    return Rule(re.compile(pattern), build)


_RULES = (
    _rule(_WHERE, about(Topic.WHERE)),
    _rule(_PLACES, about(Topic.PLACES)),
    _rule(rf"{_GO} (?:to )?(?:your )?(?:home|base)", home),
    _rule(rf"{_GO} to {_DOCK}|dock(?: yourself| (?:at|with|in|to) {_DOCK})?", home),
    _rule(
        r"(?:go (?:and |to )?)?(?:re)?charg(?:e|ing)(?: (?:yourself|up|(?:your|the) battery))?",
        home,
    ),
    _rule(
        r"(?:(?:come|go|get|drive|head|walk|move|return|turn|navigate) )?back(?: again)?"
        rf"(?: (?:here|to (?:me|us|{_ORIGIN})))?"
        rf"|return(?: (?:here|to (?:me|us|{_ORIGIN})))?|(?:go|drive|move|walk) to {_ORIGIN}",
        come_back,
    ),
    _rule(
        r"(?:wait|stay|pause|remain|stand|hold|rest)(?: still)?(?: (?:here|there|in place))?"
        rf"(?: for)? {EN_DURATION}(?: (?:here|there))?",
        wait,
    ),
    _rule(r"(?:stop|wait|stay) there", stand),
    _rule(rf"(?:say|announce|tell (?:me|us|them|everyone))(?: out loud)? ?(?P<quote>{QUOTE})", say),
    _rule(rf"say (?P<words>{_HELLO})(?: to (?:me|us|everyone|everybody))?", say),
    _rule(rf"{_GO} from (?P<start>.+?) (?:to|into|towards?) (?P<place>.+)", route),
    _rule(r"(?:(?:start|starting|leave|depart) )?from (?P<place>.+)", set_out),
    _rule(rf"(?:start |starting )?from (?P<start>.+?) {_GO} to (?P<place>.+)", route),
    _rule(rf"{_LEAD} (?:to|towards?|into) (?P<place>.+)", drive_to),
    _rule(
        rf"(?:come|get)(?: over)? (?:here|over)|{_GO} (?:to|towards?) {_PERSON}",
        lacks(Code.NO_CAMERA),
    ),
    _rule(rf"{_GO} to (?P<go>(?:the )?{MARK}) to (?:{_CAMERA})", lacks(Code.NO_CAMERA)),
    _rule(rf"{_GO} to (?P<go>(?:the )?{MARK}) to (?:{_ARM})", lacks(Code.NO_CAPABILITY)),
    _rule(_CAMERA, lacks(Code.NO_CAMERA)),
    _rule(_RELATIVE, lacks(Code.NO_CAPABILITY)),
    _rule(rf"(?:{_GO} (?:into|in|inside)|enter into) (?P<place>.+)", drive_into),
    _rule(
        rf"(?:{_GO} (?:to|towards?|at|for)|visit|reach|approach|make your way to|find your way to|"
        r"stop by|pass by|drop by|enter(?: to)?) (?P<place>.+)",
        drive_to,
    ),
    _rule(rf"{_GO} (?P<place>(?:near|next to|by|beside|close to|up to) .+)", drive_to),
    _rule(_ARM, lacks(Code.NO_CAPABILITY)),
    _rule(_TALK, lacks(Code.NO_CAPABILITY)),
    _rule(r"(?P<place>.+)", next_place),
)

_NEGATION = (
    r"\b(?:not|no|never|none|nobody|nowhere|neither|nor|without|except|avoid|instead|refuse|"
    r"forbid(?:den)?|prohibited|skip|ignore|forget|cannot|unable|dont|doesnt|cant|wont|cancel|abort|"
    r"shouldnt|mustnt|undo|rather than|other than|apart from|away from|far from|out of)\b"
)
_HARM = (
    r"\b(?:hit|ram|crash|attack|kick|hurt|kill|smash|stab|punch|injure|bump|chase|scare|"
    r"(?:run|drive|roll) over(?! to)|run into|knock (?:down|over)|block the)\b"
)
_CONDITION = (
    r"\b(?:if|unless|when|whenever|until|till|while|in case|provided|as soon as|once|otherwise|"
    r"else|whether|depending|assuming|suppose)\b"
)
_SCOPE = (
    r"\b(?:speed|fast|faster|slow|slowly|slower|quick|quickly|quicker|hurry|mph|coordinates?|"
    r"(?:met(?:re|er)s?|cm|km) (?:per|an?) (?:second|hour|minute))\b|m/s|km/h|\b[xy] ?= ?-?\d"
    r"|[(\[] ?-?\d+(?:\.\d+)? ?, ?-?\d"
)
_COURTESY = (
    r"please|pls|plz|kindly|robot|pons|hey|hi|hello|ok|okay|well|alright|now|right now|just|"
    r"(?:can|could|would|will) you|i (?:want|need|would like) you to|go ahead|try to|let us|"
    r"you (?:should|must|can|may|need to|have to)|you|and|also|then|next|thanks|thank you|"
    r"go and(?= (?:find|look|check|see|visit|wait|get|fetch|bring|pick|count|charge|recharge))|"
    r"go(?= (?:find|look|check|see|visit|wait|fetch|bring|pick|count|get))|come and(?= \w)"
)
_THANKS = (
    r"please|pls|plz|now|right now|immediately|for me|thanks|thank you|robot|pons|ok|okay|too|"
    r"as well|will you|would you|could you"
)

ENGLISH = Grammar(
    asked=re.compile(r"(?!)()"),  # "can you …" is a courtesy that needs no closing word
    vetoes=(
        (Code.NEGATED, re.compile(_NEGATION)),
        (Code.UNSAFE, re.compile(_HARM)),
        (Code.CONDITIONAL, re.compile(_CONDITION)),
        (Code.AMBIGUOUS, re.compile(r"\b(?:or|either|whichever)\b")),
        (Code.OUT_OF_SCOPE, re.compile(_SCOPE)),
    ),
    clause_end=re.compile(
        r"[,;!?:。、]+|\.(?!\d)|\s[-–—]+\s|—"
        r"|\b(?:and then|then|and|after that|afterwards|followed by)\b"
    ),
    courtesy=re.compile(rf"^(?:(?:{_COURTESY})(?:\s+|$))+"),
    thanks=re.compile(rf"(?:^|\s+)(?:{_THANKS})$"),
    opening=re.compile(r"^(?:first of all|firstly|first|to begin with|to start)\s+|\s+first$"),
    closing=re.compile(r"^(?:finally|lastly|last|at last|in the end)\s+|\s+(?:at the end|last)$"),
    rules=_RULES,
)
