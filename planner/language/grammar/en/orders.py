"""Read English orders: the vetoes, the ends of clauses, and the meanings of a clause.

A clause is read whole or not at all; the rules name every word that they pass over.
"""

from __future__ import annotations

import re

from planner.language.grammar import unsupported
from planner.language.grammar.checks import EXCEPTIONS_EN
from planner.language.grammar.clauses import Grammar
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.parse_result import TALK, lacks, rule, unread
from planner.language.grammar.unsupported import lacks_arm
from planner.language.templates.reader import TemplateStage
from planner.plan import Code, Language

_ARM = (
    r"(?:bring|fetch|get|grab|grasp|pick|put|place|take|carry|deliver|give|hand|hold|lift|drop|"
    r"pour|open|close|shut|push|pull|press|turn (?:on|off|up|down|over|out)|"
    r"turn .* (?:on|off)|switch|clean|wash|"
    r"wipe|sweep|"
    r"vacuum|mop|cook|bake|make|prepare|serve|dump|throw|distribute|arrange|set|offer|shake|"
    r"collect|"
    r"gather|pack|load|unload|transport|stack|fill|retrieve|provide|remove|water|feed|plug|unplug|"
    r"move the|move my|sort|tidy|leave (?:it|them|a|an|the (?!\W))|slide|knock on|ring|iron|fold|"
    r"hang|"
    r"unlock|lock|light|cut|peel|mix|stir|dust|polish|pass me|help me (?:with|to)|climb|jump|raise|"
    r"lower|fix|repair)"
    r"\b.*"
    r"|.*\b(?:fetch|grab|grasp|pick up|put down|deliver (?:it|them)|bring (?:it|them|me))\b.*"
)
_TALK = r"(?:answer|tell|talk|speak|ask|say|remind|report|explain|read|repeat)\b.*"
"""The robot talks: what it did not read of it, it has not understood."""
_LACKS = (
    r"(?:sing|dance|play|call|wave|sell|order|book|search the (?:web|internet)|translate|calculate|"
    r"write|type|send|email)\b.*"
)
_OWN_MOTION = (
    r"(?:take|make|do|have|pull) (?:an?|one|two|three|another|the|your|some|\d+)\b"
    r"(?: [a-z0-9]+){0,3}? ?\b(?:(?:left|right)(?=$| (?:turn|at|in|into|to|by|here|there|now|after|"
    r"before|past|on)\b)|turns?|steps?|laps?|loops?|rounds?|tour|trip|stroll|walk|drive|ride|spin|"
    r"circles?|detour|stop|break|rest|seat|nap|bow|guess|moment|exit|way|route|path|road)\b.*"
    r"|give (?:me|us) (?:(?:an?|the|some) )?(?:[a-z]+ )?(?:tour|moment|minute|second|break|space|"
    r"room|answer|joke|directions|lift)\b.*"
    r"|(?:put|bring|get|place|take|move|carry|set|drag|haul) (?:yourself|your self)\b.*"
    r"|(?:get|set|carry|hang|hold|pull|keep) (?:off|on|over|up|out|in|it|back|away|down)"
    r"(?: (?:now|here|there|already|again))*"
    r"|(?:get|set|carry|hang|hold|keep) (?:going|moving|started|over here|over there|here|there|"
    r"ready|closer|near|nearer|still|around|behind|ahead|forward|to|into|past|through|across|lost|"
    r"out for|real|close)\b.*"
    r"|hold (?:your )?(?:position|ground)\b.*|(?:set|make) (?:a )?course\b.*|give (?:way|up)\b.*"
    r"|make (?:sure|it (?:to|back)|room|way|some noise|noise|me (?:laugh|happy)|a noise)\b.*"
    r"|take (?:me|us|him|her|them|care|over|it easy|your time|cover|part|place)\b.*"
    r"|leave (?:now|me|us|here|for|this room|the room)\b.*|drop (?:by|in|over|me|us)\b.*"
    r"|bring (?:me|us) (?:over |back )?to\b.*"
    r"|get the (?:hell|heck) out\b.*|get lost\b.*"
    r"|help me (?:with|to) (?:find|look|search|locate|get to|go|count|see|check|follow|reach)\b.*"
)
"""Verbs of an arm that speak of the robot's own way: "take a left", "get going"."""

_NEGATION = (
    r"\b(?:not|no|never|none|nobody|nowhere|neither|nor|without|except|avoid|instead|refuse|"
    r"forbid(?:den)?|prohibited|skip|ignore|forget|cannot|unable|dont|doesnt|cant|wont|cancel|"
    r"abort|"
    r"shouldnt|mustnt|undo|rather than|other than|apart from|away from|far from|out of (?!the )|"
    r"nothing|hardly|by no means|refrain|stay out|keep (?:out|off|away)|"
    r"leave (?:it|them|him|her|me|everything) alone)\b"
)
_CONDITION = (
    r"\b(?:if|unless|when|whenever|until|till|while|in case|provided|as soon as|once(?! (?:around|"
    r"more)\b|$)|"
    r"otherwise|else|whether|depending|assuming|suppose|as long as|except if|every (?:time|hour|"
    r"minute|day|\d+)|"
    r"(?:at|by|around|before|after) \d{1,2}(?::\d\d)?(?: ?[ap]\.?m| o'?clock)|tomorrow|tonight|"
    r"later|"
    r"(?:in|after) (?:\w+ )?(?:minutes?|hours?|days?)|as often as|whoever|wherever)\b"
)
_SCOPE = (
    r"\b(?:speed|fast|faster|slow|slowly|slower|quick|quickly|quicker|hurry|mph|coordinates?|"
    r"(?:met(?:re|er)s?|cm|km) (?:per|an?) (?:second|hour|minute)|"
    r"(?:forwards?|ahead|backwards?|straight|drive|move|go) for (?:\w+ )?(?:seconds?|minutes?|"
    r"secs?)|"
    r"latitude|longitude|gps)\b|m/s|km/h|\b[xy] ?= ?-?\d"
    r"|[(\[] ?-?\d+(?:\.\d+)? ?, ?-?\d"
)
_ORDER_VERBS = (
    r"find|look|check|see|visit|wait|get|fetch|bring|pick|count|charge|recharge|tell|ask|say|meet|"
    r"greet|"
    r"search|inspect|locate|follow|take|put|follow|open|close|give|patrol|describe"
)
_COURTESY = (
    r"please|pls|plz|kindly|robot|pons|hey|hi|hello|ok|okay|well|alright|now|right now|just|so|"
    r"(?:can|could|would|will) you(?: be so kind (?:as )?to)?|would you mind|could i (?:ask|"
    r"get) you to|"
    r"i (?:want|need|would like|would love) you to|i would like it for you to|go ahead|try to|"
    r"let us|"
    r"you (?:should|must|can|may|need to|have to)|you(?! (?:are|were|was)\b)|and|also|then|next|"
    r"thanks|thank you|"
    r"be so kind as to|"
    r"do me a favou?r|i was wondering|dear|my friend|buddy|immediately|quietly|"
    rf"go and(?= (?:{_ORDER_VERBS}))|go(?= (?:{_ORDER_VERBS}))|come and(?= \w)|"
    rf"(?:over|once|when) there(?=,? (?:{_ORDER_VERBS}))"
)
_THANKS = (
    r"please|pls|plz|now|right now|immediately|for me|for us|thanks|thank you|robot|pons|ok|okay|"
    r"too|"
    r"as well|will you|would you|could you|again|at once|would be great|if you please"
)
_PURPOSE = (
    r"find|look|check|see|search|count|locate|inspect|meet|greet|pick|fetch|get|bring|grab|say|"
    r"tell|ask|wait|open|"
    r"close|follow|clean|take|deliver|put|describe|watch|observe"
)


ENGLISH = Grammar(
    asked=re.compile(r"(?!)()"),  # "can you …" is a courtesy that needs no closing word
    vetoes=(
        # ASCII: a Chinese character beside a word is no part of it ("跟着他or").
        (Code.NEGATED, re.compile(f"{_NEGATION}|{EXCEPTIONS_EN}", re.ASCII)),
        (Code.CONDITIONAL, re.compile(_CONDITION, re.ASCII)),
        (Code.AMBIGUOUS, re.compile(r"\b(?:or|either|whichever)\b", re.ASCII)),
        (Code.OUT_OF_SCOPE, re.compile(_SCOPE, re.ASCII)),
    ),
    joint=re.compile(r"(?!)()"),
    clause_end=re.compile(
        r",(?! (?:and )?(?:who |whom )?you (?:can|may|will|could|might|should) (?:also )?(?:find|"
        r"meet|see) )"
        r"|[;!?。、]+|:(?!\d\d)|\.(?!\d)|\s[-–—]+\s|—"
        r"|\b(?:and then|then|and|after that|afterwards|followed by)\b"
        rf"|(?<={MARK}) (?:in order )?to (?=(?:{_PURPOSE})\b)"
    ),
    courtesy=re.compile(rf"^(?:(?:{_COURTESY})(?:\s+|$))+"),
    thanks=re.compile(rf"(?:^|\s+)(?:{_THANKS})$|^(?:go|come|and|then|so)$"),
    opening=re.compile(r"^(?:first of all|firstly|first|to begin with|to start)\s+|\s+first$"),
    closing=re.compile(
        r"^(?:finally|lastly|last|at last|in the end)\s+|\s+(?:at the end|last|afterwards)$"
    ),
    rules=(
        *TALK,
        *unsupported.PAST_ENGLISH,
        *unsupported.ASIDE_ENGLISH,
        TemplateStage(Language.EN, (0, 2)),
        rule(
            r"(?:(?:move|go|drive|walk|come|step|roll|slide) )?(?:a (?:bit|little) )?sideways\b.*",
            lacks(Code.NO_CAPABILITY),
        ),
        rule(
            r"(?:(?:move|go|drive|walk|come|step|roll) )?(?:a (?:bit|little) )?"
            r"(?:left|right|closer|away|in circles?)\b.*"
            r"|turn(?! (?:on|off|up|down|over|out)\b|.* (?:on|off)$)\b.*"
            r"|(?:rotate|spin|reverse|back up|circle|orbit|park)\b.*"
            r"|(?:move|go|drive|walk) (?:for )?(?:about )?(?:back )?\d.*",
            unread,
        ),
        rule(_OWN_MOTION, lacks(Code.NOT_UNDERSTOOD)),
        rule(_ARM, lacks_arm),
        rule(_LACKS, lacks(Code.NO_CAPABILITY)),
        rule(_TALK, unread),
        TemplateStage(Language.EN, (8,)),
        TemplateStage(Language.EN, (9,)),
    ),
)
"""The last of the rules about things reads a bare thing: after all that begins with a verb."""
