"""English rows of what a sentence changes: an act and its whole sentence, in order. Data only.

``§`` stands for the letters of a place's name. Courtesy at both ends, and a reason behind a comma
where ``REASON`` says so, are taken off before.
"""

from __future__ import annotations

from planner.language.changes import Row
from planner.plan import Edit

DET = r"(?:(?:the|my|our|your|his|her|their|a|an|some|any) )?"
AT = (
    r"(?:(?:over|out|down|up|back|round|through|on|straight) )?"
    r"(?:(?:to|in|into|inside|at|on|by|near|beside|next to|around|under|behind) )?"
)
P = (
    rf"{AT}{DET}(?P<p>§+)(?: room)?(?:,? (?:i (?:guess|think),? )?"
    rf"(?:on|in|at|by|near|next to|beside) {DET}(?P<i>§+))?"
)
Q = rf"{AT}{DET}(?P<q>§+)"
THING = rf"{DET}(?P<thing>[a-z][a-z -]{{1,24}}?)"
WHO = r"(?P<person>(?:(?:my|our) )?[a-z][a-z'-]{1,15})"
LEAD = (
    r"(?:um+|uh+|er+|h+m+|well|ok|okay|hey|robot|pons|please|pls|right|alright|all right|great"
    r"|good|lovely|thanks|really|are you (?:really |quite )?sure|is that right"
    r"|that can't be(?: right)?"
    r"|yes|yeah|yep|now|so|just|dear|(?:can|could|would|will) you)[ ,?]+"
)
TAIL = (
    r"[ ,]+(?:please|pls|thanks|thank you|then|now|dear|mate|love|darling|for me|robot|pons"
    r"|(?:i'm |i am )?sorry|right now|at the moment|today|this time|for now|(?:just )?to be sure"
    r"|though)"
)
REASON = (
    r"(?:,| because| since| as) (?:because |since |as )?(?!.*\b(?:if|unless|until|till|when|but"
    r"|instead|then|so|please|you can|go|drive|come|look|check|find|try|turn|tell|ask|say|wait)\b)"
    r"(?:i|we|he|she|it|they|there|that|this|one|some(?:body|one)|nobody|no one|every(?:body|one)"
    r"|(?:the|my|our|his|her) [a-z]+(?: [a-z]+)?|[a-z]+(?=')|mum|mom|dad|grandma|grandpa)"
    r"(?:'[a-z]+| [a-z]+)\b[a-z' ]*"
)
_DENY = (
    r"(?:(?:no|nope|nah|oops|wrong(?: room| place| one| way)?|not (?:t?here|that(?: one| room"
    r"| way)?)|on (?:second thoughts?|reflection)|come to think of it)[ ,]+)"
)
_NO = rf"(?:{_DENY}|(?:wait|oh|ah|sorry|actually|hang on|hold on|really|i mean)[ ,]+)"
_TAKE = rf"(?:{_DENY}|(?:sorry|wait|actually|hang on)[ ,]+)"
_MEANT = (
    r"(?:i (?:meant?|said|wanted|want)(?: to say)?|i was thinking of|make (?:it|that)|it(?:'s"
    r"| is))"
)
_TOO = r"(?:,? (?:too|as well|also|while you(?:'re| are) (?:there|at it|about it)))"
_JOIN = r"(?:(?:oh|and(?: then)?|also|plus|after that|afterwards),? (?:now )?)"
_VERB = (
    r"(?:go|drive|come|head|move|return|turn|look|find|search|count|follow|patrol|wait|visit|check"
    r"|say|tell|ask|take|bring|get|see|stop|have a look|pop|stand|back)\b"
)
_MORE = r"(?:(?:more|further|farther)(?: more)?)"
_BIT = (
    r"(?:(?:just )?(?:a |one )?(?:(?:tiny |wee |little )?(?:bit|touch|tad|smidge)|little)|some"
    r"|slightly)"
)
_ONCE_MORE = r"(?:again|once more|one more time|a second time|another time)"
_THEM = r"(?: (?:it|that|this|them|those|these|there|in there|over there))?"
_VISITS = (
    r"(?:(?:go|look|driv|check|search|visit|enter|do|try|inspect)(?:e|ing)?"
    r"(?: (?:in|into|to|inside|through|round))?)"
)
_HE = r"(?P<who>he|she|they|it|that)"
_IS = (
    r"(?:'s|'ll be|'re| is| are| was| were| will be"
    r"| (?:should|must|might|may|could|ought to|has to) be)"
)
HEDGE = (
    r"(?:probably|possibly|perhaps|maybe|(?:most |very )?likely|usually|surely|definitely|still"
    r"|always|of course|now|actually|really|already|i(?:'d| would)? (?:think|guess|suppose"
    r"|believe|reckon|imagine|bet|say|expect)(?: that)?|i(?:'m| am) (?:pretty |quite )?sure"
    r"|not sure|no idea|(?:i )?(?:dunno|don't know)|as (?:usual|always|ever)|or something"
    r"|for a start|again|first|both|all|just)"
)
_BUSY = (
    r"(?:sitting|lying|resting|sleeping|working|reading|cooking|playing|busy"
    r"|watching (?:§+|telly|television|a film))"
)
_TRY = (
    r"(?:(?:then )?(?:you (?:could|can|should|might) )?(?:try(?: looking)?"
    r"|(?:have|take) another look|look again|let's try|how about|go with|start (?:with|in)))"
)
_CHECK = (
    r"(?:(?:you (?:could|can|should|might) )?(?:go (?:and )?|just )?(?:check|search|look"
    r"|have a look|take a look))"
)
_MISSED = (
    r"(?P<missed>(?:(?:it|he|she|they)(?:'s|'re| is| are) )?not there|nothing there|no luck)[ ,?]+"
)
_EVERYWHERE = (
    r"(?:(?:in |through )?(?:all (?:of )?(?:them|the rooms)|them all|every(?:where| room)"
    r"|any(?:where| of them| room)|all over the (?:house|place|flat)|the whole (?:house|flat"
    r"|place|home)|(?:the |all the )?other rooms|another room|somewhere else|elsewhere"
    r"|the (?:others|rest)(?: of them)?))"
)
_MARK = r"(?=.*\b(?:also|too|as well|while you)\b|(?:oh|and)\b)"
"""One thing more is asked for, beside what was."""
_LOUDER = r"(?:(?:a )?(?:bit |little |lot |much )?(?:louder|slower|more slowly|clearer))"

ROWS: tuple[Row, ...] = (
    # act, whole sentence, slots that its words fill by themselves
    Row(Edit.WHERE, rf"(?:{_MISSED})?(?:{_HE}{_IS} )(?:{HEDGE} )*(?:{_BUSY} )?{P}"
     rf"(?:,? {_BUSY})?", "tells"),
    Row(Edit.WHERE, r"(?:i|we)(?:'ve| have)?(?: (?:may|might|must|could) have)?(?: just| last)*"
     rf" (?:left|put|saw|seen|had|forgot|dropped|used) (?P<who>it|them) {P}", "tells"),
    Row(Edit.WHERE, rf"(?:{_MISSED})?{_TRY} {P}", "tries"),
    Row(Edit.WHERE, rf"then {P}", "tries kind=then"),
    Row(Edit.WHERE, rf"(?:{_MISSED})?{_CHECK} {P}(?: instead)?", "tells tries"),
    Row(Edit.WHERE, rf"(?:{_MISSED})?{P}(?:,? {_BUSY})?"),
    Row(Edit.WHERE, rf"(?:{_MISSED})?(?:(?:{_TRY}|{_CHECK}) )?{_EVERYWHERE}", "tries"),
    Row(Edit.AGAIN, r"(?:do |try |go |run )?(?:(?:it|that|this|the same(?: thing)?) )?"
     rf"{_ONCE_MORE}|(?:repeat|redo) (?:it|that|this)(?: again)?|(?:the )?same (?:thing )?again"
     r"|repeat(?: the)?(?: last)? (?:goal|order|task|drive)"),
    Row(Edit.AGAIN, r"(?:do |go |try )?(?:(?:it|that|this|the same) )?(?:again )?"
     r"(?P<times>twice|thrice|(?:two|three|four|five|[2-9]) times)(?: more| again)?"),
    Row(Edit.AGAIN, r"(?:do )?(?:(?:it|that|this) )?(?P<times>two|three|four|five|[2-9]) more"
     r"(?: times)?"),
    Row(Edit.AGAIN, rf"(?:(?:go (?:and |back and )?|just )?(?P<kind>count|look)(?:{_THEM}"
     rf"(?: properly| carefully)?) {_ONCE_MORE})(?:,? (?:i (?:think|bet) )?"
     r"(?:there (?:must|should) be more|you missed [a-z ]+))?"),
    Row(Edit.AGAIN, rf"(?:go (?:and |back and )?)?(?:check|search){_THEM} {_ONCE_MORE}"
     rf"|double[- ]check{_THEM}|(?:have|take) another (?:look|go)(?: (?:in )?there)?"
     r"(?:,? (?:i (?:think|bet) )?you missed [a-z ]+)?", "kind=look"),
    Row(Edit.AGAIN, rf"recount{_THEM}|(?:have|take) another count", "kind=count"),
    Row(Edit.AGAIN, r"(?:(?:she|he|they|nobody) (?:didn't|couldn't) (?:hear|understand|catch)"
     r"(?: (?:you|it|that))*[ ,]+)?(?:so )?(?:say|repeat|shout) (?:it|that|this)"
     rf"(?: to (?:her|him|them))?(?: (?:{_ONCE_MORE}|(?P<times>twice|two times)(?: more)?))?"
     rf"(?:[ ,]*(?:but )?{_LOUDER})?", "kind=say"),
    Row(Edit.AGAIN, rf"(?:and )?(?:{_ONCE_MORE}[ ,]*(?:but )?)?{_LOUDER}", "kind=say"),
    Row(Edit.AGAIN, r"(?:(?:and|no|then|go back and)(?: ?, ?| )?)*"
     r"(?:tell|ask|remind|warn|greet|call)"
     rf" (?P<who>him|her|them) {_ONCE_MORE}(?:,? louder)?", "kind=tell"),
    Row(Edit.OTHER, rf"{_NO}*(?:i meant? |i said |go to |to )?(?:the|that) other(?: one| room"
     r"| place)?"),
    Row(Edit.LEAVE_OUT, rf"(?:{_NO}|but[ ,]+|and[ ,]+)*(?P<denied>not |i (?:didn't|did not|never)"
     rf" (?:say|said|mean|meant|want|wanted|ask for|asked for) ){P}"),
    Row(Edit.LEAVE_OUT, rf"(?:{_NO}|but[ ,]+|and[ ,]+|also[ ,]+)*(?:(?:you (?:can|could|may|might)"
     r"(?: as well)? )?(?:skip|omit|ignore|leave out|miss out|pass over|stay out of"
     rf"|(?:keep|stay) (?:away from|clear of)) {P}|(?:you (?:can|could|may) )?leave"
     r" (?:(?:the|my|our) )?(?P<p2>§+) out(?: of it)?|(?:all |everywhere )?(?:but not"
     r"|except(?: for)?|apart from|without|not including) (?:(?:the|my|our) )?(?P<p3>§+))",
     "kind=skip"),
    Row(Edit.LEAVE_OUT, rf"(?:{_NO}|but[ ,]+|and[ ,]+)*(?:(?:don't|do not)(?: bother)?"
     rf" (?:with|about|{_VISITS})|(?:you (?:don't|do not) (?:need|have) to|you needn't"
     rf"|(?:there(?:'s| is) )?no (?:need to|point(?: in)?)) {_VISITS}"
     rf"|never ?mind(?: about)?) {P}"),
    Row(Edit.LEAVE_OUT, rf"{_NO}*(?:i (?:know|think) )?(?:it|he|she|they)(?:'s not|'re not| is not"
     rf"| are not| isn't| aren't) {P}(?: either)?", "tells"),
    Row(Edit.FIRST, rf"(?:{_NO}|but )*(?:(?:(?:go|drive|head) to|do|check|visit|try|look in"
     rf"|take) {P}"
     r" first|(?:start|begin) (?:with|in|at) (?:(?:the|my|our) )?(?P<p2>§+)"
     r"|(?:(?:the|my|our) )?(?P<p3>§+) first)"),
    Row(Edit.INSTEAD, rf"{_NO}*(?:not {Q}[ ,]+)(?:but )?(?:rather )?(?:i (?:want|need) you"
     rf" (?:to (?:go|come|be) )?)?(?:it(?:'s| is) )?{P}"),
    Row(Edit.INSTEAD, rf"{_NO}+{_HE}(?:'s|'re| is| are)(?: (?:now|actually|really|just|back))* {P}"
     rf"(?: (?:now|today|instead))?(?:,? not {Q}(?: any ?more)?)?"),
    Row(Edit.INSTEAD, rf"{_NO}*{_HE}(?:'s|'re| is| are)(?:n't| not) {Q}[ ,]+(?:but )?(?:(?:he|she"
     rf"|they|it)(?:'s|'re| is| are) )?(?:now )?{P}"),
    Row(Edit.INSTEAD, rf"{_NO}*(?:{_DENY}{_NO}*(?:{_MEANT} )?|{_MEANT} )(?:rather |try |better "
     rf"|instead )?{P}"
     r"(?: first| instead| rather| i meant?)?(?:[ ,]+(?:so )?(?:go|drive|come) (?:over )?there"
     r"(?: instead)?)?"),
    Row(Edit.INSTEAD, rf"{_NO}*{P},? i meant?"),
    Row(Edit.INSTEAD, rf"(?:{_TAKE}+(?:i meant? |i said )?(?:(?:tell|ask|call|get) )?|i meant? "
     rf"){WHO}(?: instead)?(?:,? not (?:my )?[a-z]+)?"),
    Row(Edit.INSTEAD, rf"(?:tell|ask|call) {WHO} instead"),
    Row(Edit.INSTEAD, rf"{_TAKE}+say (?P<words>[^,]{{2,60}})|{_NO}*say (?P<words2>[^,]{{2,60}}?),?"
     r" instead"),
    Row(Edit.OTHER_SIDE, rf"{_NO}*(?:i (?:meant|said) )?(?:turn |go )?(?:to )?(?:the|your"
     rf"|my) other"
     r" (?:way|side|direction|left|right)(?:,? (?:i (?:meant|said) )?(?P<side>left|right))?"),
    Row(Edit.OTHER_SIDE, rf"(?:{_NO}+|i (?:meant|said) )(?:(?:turn|go) )?(?:to )?(?:the |your "
     rf"|my )?"
     r"(?P<side>left|right)(?: i (?:meant|mean|said))?(?:,? not (?:left|right))?"),
    Row(Edit.OTHER_SIDE, r"(?P<side>left|right)[ ,]+(?:i (?:meant|mean|said)|not (?:left|right))"),
    Row(Edit.OTHER_SIDE, r"(?:no,? )?(?:that's |that is )?(?:the )?wrong (?:way|direction|side)"
     r"(?:,? (?:dear,? )?(?:turn |go )?(?:to )?(?:the )?(?P<side>left|right))?"),
    Row(Edit.MORE, rf"(?:and |nearly,? |almost,? |still )?(?:(?:go|move|drive|turn) )?(?:{_BIT} )?"
     rf"{_MORE}(?: (?:to )?(?:the |your )?(?P<side>left|right|forwards?|ahead|backwards?|back))?"
     rf"(?:,? (?:{_BIT} )?more)?|keep going {_BIT}(?: more)?|{_BIT} more"),
    Row(Edit.MORE, r"(?:and )?(?:go |move |turn )?another (?P<amount>(?:\d{1,3}(?:\.\d)? ?|(?:a"
     r"|one"
     r"|two|half an?|half|ten|twenty|thirty|fifty) )?)(?P<unit>metres?|meters?|m|cm"
     r"|centimet(?:er|re)s?|degrees?)"),
    Row(Edit.MORE, rf"(?:{_BIT} )?(?:closer|nearer)", "kind=closer"),
    Row(Edit.MORE, r"(?:(?:that(?:'s| is| was)? )?(?:too (?:far|much)|much too far|over)[ ,]+)?"
     rf"(?:now |so )*(?:(?:go|come|turn|move|drive) )?(?:back {_BIT}|{_BIT} back(?:wards)?)",
     "back"),
    Row(Edit.MORE, r"(?:that(?:'s| is| was)? )?(?:too (?:far|much)|much too far)[ ,]+(?:now |so )*"
     rf"(?:(?:go|come|move|drive) )?(?:forwards? {_BIT}|{_BIT} forwards?)", "back kind=forth"),
    Row(Edit.LIKE, r"(?:what|which) colou?r(?:(?: is| are|'s)(?: (?:it|that|they))?)?"
     r"|what(?:'s| is) (?:its|the) colou?r", "words=what colour is the {}"),
    Row(Edit.LIKE, r"what does (?:it|that) look like", "words=what does the {} look like"),
    Row(Edit.THE_ONE, rf"(?:go|drive|come|move|head)(?: over| back| on)? to the one {P}"),
    Row(Edit.SEEN, rf"(?:and )?(?:was|were) (?:it|they|he|she|that) {P}"),
    Row(Edit.SEEN, r"(?:and )?(?:see|seen|saw|spot|spotted|notice|noticed|meet|met|find|found)"
     r" (?P<seen>(?:any|some)(?:one|body|thing)(?: [a-z]+){0,2}|any [a-z]+(?: [a-z]+)?)"),
    Row(Edit.INSTEAD, rf"{_NO}*(?:{_DENY}{_NO}*|{_MEANT} )(?P<rest>{_VERB}.+)"),
    Row(Edit.ALSO, r"(?:and )?(?:when|once|after|as soon as) (?:you(?:'re| are) (?:all )?(?:done"
     rf"|finished)(?: with (?:that|it|this)| there| here)?(?: {Q})?|you(?: have|'ve)?"
     r" finish(?:ed)?(?: (?:that|it|this))?(?: (?:in )?(?:(?:the|my|our) )?(?P<q2>§+))?"
     rf"|that(?:'s| is) (?:done|finished))[ ,]+(?:then )?(?:{P}|(?P<rest>{_VERB}.+))"),
    Row(Edit.ALSO, rf"(?:(?:and )?(?:what|how) about |(?:now )?(?:do )?(?:the )?same(?: thing)?"
     rf"(?: again)? (?:in|at|for|with) |and (?:now )?){P}{_TOO}?", "asks"),
    Row(Edit.ALSO, rf"{_JOIN}+{P}{_TOO}?|(?:do |take in |include |throw in |add )?{AT}(?:(?:the|my"
     rf"|our) )?(?P<p2>§+){_TOO}+|(?:do|take in|include|throw in|add) (?:(?:the|my|our) )?"
     r"(?P<p3>§+)(?: to (?:it|that|the|your) ?(?:round|patrol|tour|list)?s?)?"),
    Row(Edit.ALSO, rf"{_MARK}{_JOIN}*(?:see|check|look)(?: and see)? (?:if|whether) (?:there(?:'s"
     rf"| is| are)"
     rf"|you (?:can )?(?:see|find)) {THING}{_TOO}*", "kind=look"),
    Row(Edit.ALSO, rf"{_MARK}{_JOIN}*(?:look for|find|search for) {THING}{_TOO}*(?: in there"
     rf"| there)?{_TOO}*",
     "kind=find"),
    Row(Edit.ALSO, rf"{_MARK}{_JOIN}*(?:count|how many) {THING}{_TOO}*", "kind=count"),
    Row(Edit.ALSO, rf"(?:and(?: then| also| after that| now)?|also|after that|afterwards"
     rf"|and afterwards"
     rf"|and then also),? (?P<rest>{_VERB}.+?){_TOO}?|(?P<rest2>{_VERB}.+?){_TOO}"),
    Row(Edit.ALSO, rf"{_JOIN}*(?:(?:tell|ask|call|get|invite) )?{WHO}{_TOO}|and (?:(?:tell|ask"
     rf"|call"
     r"|get|invite) )?(?P<person2>(?:(?:my|our) )?[a-z][a-z'-]{1,15})"),
    Row(Edit.ALSO, rf"(?:(?:oh|and|also|what about|how about|plus),? )+{THING}{_TOO}?"
     rf"|{DET}(?P<thing2>[a-z][a-z -]{{1,24}}?){_TOO}"),
)  # fmt: skip
