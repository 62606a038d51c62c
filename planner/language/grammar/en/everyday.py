"""Own the English phrases of everyday speech, and the plain orders that they are."""

from __future__ import annotations

from planner.language.grammar.everyday import table
from planner.language.grammar.lexicon import MARK
from planner.language.numbers import EN_DURATION, EN_LENGTH

_THE = r"(?:(?:the|a|my|our|your|this|that) )?"
_PLACE = rf"{_THE}{MARK}"
_END = r"(?=$|[,.!?;])"
_BEGIN = r"(?:^|(?<=[.!?;] ))"
_WHO = (
    r"(?:robot|robo|pons|mate|buddy|pal|love|dear|darling|honey|sweetie|sweetheart|friend|my friend"
    r"|boy|girl|lad|bro|bud|dude|man|sir|champ|chum|little (?:one|guy|fella|fellow|buddy|robot)"
    r"|old (?:chap|boy|thing)|y'?all|beta)"
)
_CALLS = (
    r"(?:hey|hi|hello|oi|yo|ahoy|ok|okay|right(?: then)?|alright|all right|so|well|now(?: then)?)"
)
_GOES = (
    r"(?:pop|nip|swing|trot|scoot|hop|roll|mosey|stroll|wander|dash|zip|trundle|wheel|toddle"
    r"|shuffle|march|waltz|pootle|amble|bounce|whizz|race|rush|shift|relocate|skip|jog|slide|sneak|make (?:your|a)"
    r" (?:way|trip)|take (?:yourself|a (?:trip|walk|stroll|drive|run))|get (?:yourself|your [a-z]+)"
    r"|bring yourself|(?:drag|move|drive|roll|wheel|take) yourself|find your way|head|proceed|get|come)"
)
_ASIDE = r"(?: (?:on|off|over|down|up|along|out|back|round|around|across|across the hall|straight|through))*"
_ONE = r"(?:i|he|she|it|they|we|(?:the |my |our )?(?:baby|kids?|dog|cat|m[uo]m|dad|gran(?:ny|dma)))"
_REASON = (
    rf"{_ONE}(?: is|'s| are|'re| am|'m|s)? (?:all |so |really |very |just |still )?(?:lost|missing"
    r"|gone|asleep|sleeping|hungry|thirsty|waiting|tired|late|in a (?:hurry|rush)|cold|bored|sad"
    r"|lonely|driving me (?:mad|crazy|nuts)|in (?:my|the|our) way|running late|starving|freezing)"
    r"|you(?:'re| are) (?:on my (?:foot|feet|toes?)|blocking (?:me|us|the way)|too close(?: to me)?)"
    r"|you(?:'re| are) (?:low on|short of|out of|running (?:out of|low on)) (?:battery|power|juice)"
    r"|(?:your|the) battery (?:must be|is|looks|seems) (?:nearly |almost |very |pretty )?(?:flat|low"
    r"|dead|empty)|you (?:are|'re) in (?:my|the) way|ur (?:drunk|slow|late)"
)
_LOOKS = (
    r"(?:(?:have|take) a (?:quick |little |good )?(?:nosy|nose|gander|butcher's|peek|peep|squint"
    r"|look(?: see)?|scout|poke|snoop|rummage|glance)|scope out|suss out|case|poke around|snoop around)"
)
_HAVE_A_LOOK = (
    r"(?:please |now |just |could you |can you )*(?:go |come )?(?:and )?(?:have a (?:quick )?(?:look"
    r"|search|check)|take a look|look|check|see|search|count(?: them)?|find out|hunt for it"
    r"|(?:find|look for|track down) (?:it|him|her|them))(?: for me| please| will you| would you| now)*"
)
_SAYABLE = (
    r"(?:(?!(?:if|unless|when|until|till|while|before|after|or|and|then|tomorrow|tonight|later)\b)[a-z0-9']+ ?)+?"
    r"(?:(?: in|in) (?:a|one|two|five|ten|half an?) (?:minutes?|mins?|moment|seconds?|secs?|hours?|bit|while))?"
)
"""Words to be said: when they are true is theirs, not the order's."""
_SOUGHT = r"(?P<t>(?:the|my|our|a|an|any) [a-z]+(?: [a-z]+){0,2}?)(?=$|[,.]| and\b)"
_ORDERS = r"(?:go|drive|come|return|head|pop|nip|wait|charge|find|look|turn|follow)"
_AND_GO = r"(?:go (?:home|to|back|and|charge)|come back|drive to|return|head (?:to|home|back))"
_ENDS_IN_ORDER = rf"[^\",;]*? (?:(?:and )?then {_ORDERS}|and {_AND_GO})\b"
_TO_SOMEBODY = r"(?:good ?night|night night|happy [a-z]+|thank you) to\b"
"""What is said to somebody, or ends in another order, is no place that is only spoken of."""
_SAYS = r"(?:shout|yell|call out|announce|holler|proclaim)(?: out)?"
_HOME = r"(?:house|home|flat|apartment|place|building|rooms|premises)"
_AROUND = (
    r"(?: (?:of|round|around|through|about) (?:all (?:of )?|every |each )?(?:the |our |my )?"
    rf"(?:whole |entire )?(?:{_HOME}|room))?"
)
_NUMBER = (
    r"(?:five|ten|fifteen|twenty|thirty|forty|fifty|sixty|seventy|eighty|ninety|forty five"
    r"|\d{1,3})"
)

_A_BIT = r"(?:just )?(?:a (?:(?:little |wee |tiny )?bit|wee|little|tad|touch|smidge|step)|slightly)"
"""The robot takes 20 cm for it: a short step."""

_NO_ASIDE = (
    rf"(?![^,.!;?]*(?:{MARK}|\b(?:go|come|drive|find|look|stop|wait|turn|follow|bring|say|tell|ask|check|follow"
    r"|mean|meant|said|mind|wrong|sorry|joking|kidding|rather|instead|not|never|done|finished|enough|later"
    r"|tomorrow|tonight|minutes?|hours?|seconds?|before|after|when|while|until|till|if|unless|only|except"
    r"|but|or|and|without|o'clock|safe|danger(?:ous)?|broken|blocked|locked|closed|shut|wet)\b|n't))"
)
_STATES = (
    rf"{_NO_ASIDE}(?:i|we|he|she|it|they|you|that|there|this|(?:the|my|our) [a-z]+(?: [a-z]+)?|[a-z]+(?= is\b|'s\b))"
    r"(?:'s|'m|'re|'ve|'ll| is| am| are| was| were| have| has| had| will| shall| must| need| needs| think| thought"
    r"| guess| left| lost| just| heard| feel| can hear| smell| hope| am)\b[^,.!;?]*"
)
"""A clause that says how things stand and orders nothing: why something is ordered."""

_LOST = (
    r"(?:i (?:can ?not|could not) (?:find|see)|(?:i|we)(?:'ve| have)? (?:just )?lost|have you seen"
    r"|where (?:on earth )?(?:is|are|has|have|did i (?:put|leave)))"
)
_WHOEVER = (
    r"^(?:please )?tell (?:whoever|everyone who|everybody who|anyone who|anybody who)(?:'s| is) "
)
_UNLESS_SOMEBODY = (
    r"^unless (?:there is |there's )?(?:somebody|someone|anybody|anyone)(?: is|'s)?"
    r" (?P<a>(?:in|at|by) (?:the |my |our )?[a-z']+(?: (?!go|drive|come|look|find|say|count)[a-z']+)?)"
)
TOLD_TWICE = table(
    (r"\bcount (?:down )?(?:from |to )?(?P<n>\d+|ten|twenty|thirty|forty|fifty|sixty)(?: seconds)?(?=$|[,.;!]| (?:and|then)\b)",
     r"wait \g<n> seconds"),
    (r"\bare (?:sat|seated|sitting|standing|stood|lying|left|kept) (?=(?:in|at|on|by|near|there)\b)", "are "),
    (r"^(?:please )?(?:go|drive|head|get) back (?:to )?where you (?:were|came from|come from|started)(?: before| from)?[.!]*$", "come back"),
    (r"^where do (?:we|you|i|they) (?:keep|put|store) (?P<t>(?:the|our|my) [a-z]+)\?*$", r"where is \g<t>?"),
    (rf"{_WHOEVER}(?:in|at) (?P<p>(?:the |my |our )?[a-z]+(?: [a-z]+)?) that (?P<w>[^\"]+)$", r'go to \g<p> and say "\g<w>"'),
    (r"\b(?P<o>otherwise|or else|if not),? (?:then )?try (?P<p>(?:the|my|our) [a-z]+(?: [a-z]+)?)$", r"\g<o> look in \g<p>"),
    (r"(?<=[ ,])(?P<o>otherwise|or else|if not|else),? dock(?: yourself)?(?=[.!]*$)", r"\g<o> go to the dock"),
    (r"\bcome (?:back )?(?:(?:and|to) )?(?:tell (?:me|us)|let (?:me|us) know)(?=[!.]*$|[,;.])", "come back"),
    (r"\b(?:(?:have|take) a (?:good |quick |little |proper )*)?look (?:a?round|through|over|all over) "
     rf"(?:the|our|my) (?:(?:whole|entire) {_HOME}|house|flat|apartment)(?!(?: again| now)? for\b)", "patrol the house"),
    (r"\b(?:(?:have|take) a (?:good |quick |little |proper )*)?look (?:a?round|through|over|all over) "
     rf"(?:the|our|my) (?:whole |entire )?{_HOME} for (?P<t>(?:the|my|our|a|an) [a-z]+(?: [a-z]+)??)(?=[.!]*$)",
     r"find \g<t>"),
    (r"(?<=[a-z])[,.;]+ ?you (?:look|seem|sound) (?:a (?:bit|little) |very |so |really |dead )*(?:tired|exhausted|knackered"
     r"|sleepy|worn out|shattered|dusty|bored|lonely)(?=[.!]*$)", ""),
    (r"\bcount (?P<t>(?:(?:all|the|my|our) )+[a-z]+(?: [a-z]+)?) (?P<p>(?:in|at|on) [a-z ]+?),? (?:and|then|and then)"
     r" (?:count )?(?:the ones|those) (?=(?:in|at|on)\b)", r"count \g<t> \g<p> and then count \g<t> "),
    (rf"^{_LOST} (?P<t>(?:my|our|the|me) [a-z]+(?: [a-z]+)??)(?: (?:got to|gone|hiding|anywhere|any more|again|lately|around))?[,.;!?]+ (?:so |please "
     r"|can you |could you |will you |would you )*(?:go )?(?:and )?(?:look|search|hunt|have a look|find|track down)(?: for)?"
     r" (?:it|him|her|them)(?: please| for me)*[.?!]*$", r"find \g<t>"),
    (r"\bif you will (?=(?:see|find|spot|notice|meet)\b)", "if you "),
    (r"\bturn (?:yourself )?(?:a?round|about)[, ]+(?:and |so (?:that )?you (?:are |can )?)?fac(?:e|ing)"
     r" (?:the other way|away)\b", "turn around"),
    (r"^if you can ?not (?:find|see|spot) (?P<t>[a-z' ]+?) (?P<a>(?:in|at|on|by) [a-z' ]+?)[, ]+(?:then )?"
     r"(?:try|check|(?:go (?:and )?)?look (?:for it )?(?:in|at)) (?P<b>[a-z' ]+)$",
     r"find \g<t> \g<a>, if you can not find it, find \g<t> in \g<b>"),
    (r"^(?:get|come|go) out of (?:the |my |our )?[a-z]+(?: [a-z]+)?,? (?:and |then )+(?=(?:go|come|drive|head)\b)", ""),
    (rf"{_UNLESS_SOMEBODY},? go in(?: there)?(?= and\b|$)", r"if there is nobody \g<a>, go there"),
    (rf"{_UNLESS_SOMEBODY}(?:, ?| )(?=(?:go|drive|come|look|find|say|count)\b)", r"if there is nobody \g<a>, "),
    (r"\bface the other way[, ]+(?:so |that is |i\.e\. |and )?(?:turn )?(?:a?round )?(?:by )?"
     r"(?:180|one hundred and eighty) degrees\b", "turn around"),
)  # fmt: skip
"""One turn in two clauses: read as two, the robot would stand as it stood. And what hangs on an order
that fails, or on an empty room, said before it."""

ENGLISH_EVERYDAY = table(
    *((rf"\b(?:{chat})\b", plain) for chat, plain in (
        ("u(?! turn)", "you"), ("ur(?= (?:way|self))", "your"), ("plz|pls|pleas|plse", "please"),
        ("chek|chk", "check"), ("gimme", "give me"), ("lemme", "let me"), ("wanna", "want to"),
        ("gonna", "going to"), ("gotta", "have to"), ("im", "i am"), ("em", "them"),
        ("whats", "what is"), ("wheres", "where is"), ("thats", "that is"), ("theres", "there is"),
        ("d'you", "do you"), ("pleeease|pleez|pleeze", "please"), ("kichen|kitchn", "kitchen"),
    )),
    # towards the person or away from them? Only a reason tells
    (rf"\bcome back {_A_BIT}(?=[,.!;]+ ?(?:you are|you're) (?:on my|blocking|too close|in (?:my|the) way))",
     "move back 20 cm"),
    # "The kitchen" alone names it, "kitchen" and "the kitchen, please" order
    (rf"^(?P<p>{_PLACE}),? (?:please|pls|now|at once)[.!]*$", r"go to \g<p>"),
    # hesitation, address, courtesy
    (r"(?:^|[ ,])(?:u+h+m*|u+m+|e+r+m*|h+m+|ah+|you know(?: what)?|sort of|kind of|kinda|basically"
     r"|literally|what is it called|what do you call it|what's its name)(?=$|[ ,.!?])", " "),
    (r"\b(the|to|my|a|in|at|and|go|go to|go in)[, ]+\1\b", r"\1"),
    (rf"{_BEGIN}(?:like|so|and|but|now|anyway)(?:,| like| so)+ ?(?=\w)", ""),
    (rf"{_BEGIN}{_CALLS}(?: {_WHO})?(?:,| ) ?(?=[\w\ue000-\ue7ff])", ""),
    (rf"{_BEGIN}{_WHO}(?:(?:,|!) ?| (?=(?:go|come|drive|find|look|{MARK}|the {MARK})))", ""),
    (rf"[, ]+{_WHO}{_END}", ""),
    (r"[, ]+(?:for me|for us|would you|will you|could you|can you|innit|cheers|ta|got it|on the double"
     r"|chop chop|asap|right away|straight away|quick smart|there's a (?:good )?(?:love|lad|boy)"
     rf"|no rush|right now|for a (?:sec|second|moment|minute|bit|mo|while)|ok|okay|alright|please|pretty please|thanks|now|then){_END}", ""),
    (r"\b(?:can|could|would|will) you (?:maybe|possibly|perhaps|please|just|kindly|quickly|maybe just)"
     r"+ (?=\w)", "can you "),
    (r"^(?:is there any chance|any chance|do you think|i wonder if|i was wondering if|would it be"
     r"(?: at all)? possible(?: for)?|could i (?:trouble|bother|ask) you|can i (?:trouble|ask) you"
     r"|be a (?:dear|love|pet|star) and|be so (?:good|kind)(?: as)? to|do (?:me a favou?r|one thing)"
     r"(?:,| and)?"
     r"|your job is|might i (?:trouble|ask|bother) you|may i (?:trouble|ask|bother|have) you"
     r"|have you got (?:a|one) (?:minute|moment|second|sec)|can you spare (?:a|one) (?:minute|moment)"
     r"|perhaps|maybe|i was hoping|i am hoping|i hope|time for you|it is time for you|shall we"
     r"|(?:you could )?make yourself useful and|you (?:had|'d) better|go on and|feel free)"
     r"(?: you)?(?: could| would| can)?(?: to)? (?=[a-z])", ""),
    (r"^(?:so )?(?:what )?i(?: would|'d)? (?:really )?(?:like|love|want|need|appreciate)(?: it if| is| is for)? you"
     r"(?: could| would| can)?(?: to)? (?=[a-z])", ""),
    (rf"^{_STATES}[,.!;]+ ?(?:so |and so |and )?(?=[\w{MARK[1:-1]}])", ""),
    (rf"(?<=\w)(?:[,.!;]+ ?| )(?:because |cause |cos |since ){_STATES}$", ""),
    (rf"(?<=[\w{MARK[1:-1]}])[,.!;]+ ?{_STATES}$", ""),
    (rf"{_BEGIN}come on(?: then)?,? (?=\w)", ""),
    (r"^(?:do you |you )?want to (?=(?:go|drive|come|head|look|find|count|have)\b)", ""),
    (r"^you can (?:now )?(?=(?:go|drive|come|head|look)\b)", ""),
    (r"^let(?:'s| us) see you (?=(?:go|drive|come|look|find|count)\b)", ""),
    (r"^(?:please )?to (?=(?:go|drive|come)\b)", ""),
    (rf"^(?:you (?:should|need to|ought to|have to|must) be|you(?: are|'re) (?:needed|wanted)) (?:in|at|by) (?P<p>{_PLACE})",
     r"go to \g<p>"),
    (rf"^(?:go|drive) to (?P<p>{_PLACE}),? but (?:first )?(?:stop(?: off)?|swing|pop|call)(?: in)? (?:at|by|in) (?P<q>{_PLACE})"
     r"(?: on (?:the|your) way(?: there)?| first)?$", r"go to \g<q> then go to \g<p>"),
    (rf"\b(?:go|drive|roll|pop|head) past (?P<p>{_PLACE})", r"go to \g<p>"),
    (rf"(?P<p>{_PLACE}) area\b", r"\g<p>"),
    (rf"\bgo (?:to )?where (?P<p>{_PLACE}) is\b", r"go to \g<p>"),
    (rf"^(?:over|off|up|down|across|straight|along|round) to (?P<p>{_PLACE})(?=$|[,.])", r"go to \g<p>"),
    (rf"^(?:let us|can we|could we|can i|could i|may i|we need to|i need to|i want to|i would like to) have you"
     rf"(?: over)? (?:in|at|by|on|near|next to) (?P<p>{_PLACE})", r"go to \g<p>"),
    (rf"^(?:get|come|go|move) out of {_PLACE},? (?:and )?(?:in)?to (?P<p>{_PLACE})$", r"go to \g<p>"),
    (r",? and (?P<b>[^,]+?) (?:when|once) you(?: get| are| arrive| have got)(?: there| in)?$", r", then \g<b>"),
    (rf"^(?P<v>tell|ask|remind) (?P<n>(?:my |our )?[a-z]+) (?P<w>[^,]+), (?:he|she|they)(?:'s| is| are)(?: in|at)+"
     rf" (?P<p>{_PLACE})$", r"\g<v> \g<n> in \g<p> \g<w>"),
    (rf"^(?:go )?look (?:under|behind|beside|on|next to) (?P<p>{_PLACE}) for (?P<t>(?:the|my|our|a|any) [a-z ]+)$", r"look for \g<t> at \g<p>"),
    (rf"^(?:is there )?(?:any chance )?(?:that )?there is (?P<t>(?:a|an|any|some) [a-z ]+?) (?P<w>in|at|on|by) (?P<p>{_PLACE})\?$",
     r"is there \g<t> \g<w> \g<p>?"),
    (r"\b(?:have|take) a (?:scout|look|hunt|search|scour|nose|rummage|root|poke)(?: a?round| about)? for (?P<t>(?:a|an|the|my|our|some) [a-z ]+)$",
     r"find \g<t>"),
    (r"\b(?:see|check) if you can (?:spot|find|see|locate) (?P<t>(?:a|an|the|my|our|[a-z]+'s) [a-z ]+?)(?: anywhere| somewhere| around)?$",
     r"find \g<t>"),
    (rf"^go (?P<p>{MARK})(?= then\b|,| and\b|$)", r"go to \g<p>"),
    (rf"^to (?P<p>{_PLACE})[.!]*$", r"go to \g<p>"),
    (r",? in (?:that|this) order$", ""),
    (rf"^(?P<p>{_PLACE}) first,? (?=(?:and |then )+)", r"go to \g<p>, "),
    (rf"\bcome (?:on )?(?:over |back |up )?here (?:to|by|into|in|next to|near) (?P<p>{_PLACE})", r"go to \g<p>"),
    (rf"\bgo (?:down|along|up|across) (?P<p>{_PLACE}){_END}", r"go to \g<p>"),
    (r"\breport(?: back)?(?: to me)? (?:over |back )?here(?=[!.]*$|[,;.])", "come back"),
    (r"\bcheck for (?=(?:the|my|our|a|an|any|some) )", "look for "),
    (r"(?:,| and| then)+ (?:stop|halt|stay) there(?=[.!]*$)", ""),
    (rf"^(?:go )?(?:and )?(?:check|search|try|look in|look at|look on) (?P<a>{_PLACE}),? and (?:then )?(?:in |at |on )?"
     rf"(?P<b>{_PLACE}) for {_SOUGHT}", r"go to \g<a> and see if there is \g<t>, then go to \g<b> and see if there is \g<t>"),
    (rf"\b(?:{_LOOKS}|look|check)(?: for it)? (?:in|at|on|under|by) (?P<p>{_PLACE})(?:,| and| then)+ (?:in|at|on|by|under)"
     rf" (?P<q>{_PLACE})(?=$|[,.]| and\b| then\b)", r"look in \g<p>, then look in \g<q>"),
    (rf"\bgo over there (?:by|to|at|near) (?P<p>{_PLACE})", r"go to \g<p>"),
    (rf"\b{_LOOKS} (?:a?round|at|in|inside|into|through)? ?(?P<p>{_PLACE}) and (?=(?:see|check|tell|find)\b)",
     r"go to \g<p> and "),
    (r"\bhave a (?:quick )?look (?=if\b|whether\b)", "see "),
    (rf"^(?P<q>how many [a-z ]+? are there) (?:a?round|about) (?P<p>{_PLACE})", r"\g<q> at \g<p>"),
    (r"^would you mind(?: awfully| terribly)? (?:checking|seeing|looking)(?: (?:whether|if))?", "check if"),
    (r"^would you mind(?: awfully| terribly)? (?:going|popping|driving|heading)\b", "go"),
    (rf"(?:^|[,.!;]+ ?)(?:{_REASON})(?:(?=$|[,.!;])|(?= go\b))", ","),
    (rf"(?<=\w) (?:{_REASON})$", ""),
    (rf"(?:^|, ?)(?:she|he|it)(?:'s| is| are)? (?:still )?(?:there|here)?{_END}$", ""),
    # where the person is
    (rf"^i am (?:sitting |standing |lying |waiting |over )*(?:in|at|by|on|near) (?P<p>{_PLACE})[, .]*"
     r"(?:so |and )?come (?:here|over|to me|and (?:get|find) me|find me|get me)$", r"go to \g<p>"),
    (r"^come (?:here|over|to me|find me|and find me|and get me|get me)[, .]+(?:i am )?(?:sitting "
     rf"|standing |lying |waiting |over )*(?:in|at|by|on|near) (?P<p>{_PLACE})$", r"go to \g<p>"),
    (rf"\bcome (?:and )?(?:find|see|meet|join|get) me (?:in|at|by|on|near) (?P<p>{_PLACE})", r"go to \g<p>"),
    (rf"\bcome to (?P<p>{_PLACE})[,.]+ (?:i(?:'m| am)) (?:in |over |right )?(?:here|there)$", r"go to \g<p>"),
    # lengths, angles, times
    (rf"\b(?P<v>back up|reverse|(?:go|move|get|scoot|shuffle|roll|drive) back(?:wards?)?) {_A_BIT}{_END}",
     "move back 20 cm"),
    (rf"\b(?:move|go|drive|roll|scoot|shuffle|inch|edge|come) (?:{_A_BIT} )?(?:forwards?|ahead|closer)(?: {_A_BIT})?(?=$|[,.])",
     "move forward 20 cm"),
    (r"\b(?:a|one) (met(?:re|er)) and a half\b", r"1.5 \1s"),
    (r"\b(one|two|three|four|five) and a half (met(?:re|er)s?|m)\b", r"\1.5 \2"),
    (r"\bone\.5\b", "1.5"), (r"\btwo\.5\b", "2.5"), (r"\bthree\.5\b", "3.5"), (r"\bfour\.5\b", "4.5"),
    (r"\b(?:a|one) quarter of an hour\b", "15 minutes"),
    (r"\b(?:half an hour|a half hour|half hour)\b", "30 minutes"),
    (r"\bcouple metres\b", "couple of metres"),
    (rf"^(?P<l>{EN_LENGTH})(?: straight)? (?P<d>forwards?|backwards?|back|ahead)$", r"move \g<d> \g<l>"),
    (rf"\b(?:back up|reverse|go backwards?|scoot back(?:wards?)?|shuffle back(?:wards?)?|move back(?:wards?)?"
     rf"|inch back|back off)(?: a (?:bit|little|tad|touch))?,?(?: like| say| about| maybe| by| around)?"
     rf" (?P<l>{EN_LENGTH})", r"move back \g<l>"),
    (rf"\b(?:scoot|shuffle|inch|nudge|edge|creep|roll|scooch)(?: yourself)? (?P<d>forwards?|ahead)(?: by| about)?"
     rf" (?P<l>{EN_LENGTH})", r"move forward \g<l>"),
    (r"\b(?:spin|turn|twirl|whirl)(?: yourself)?(?: a?round)? once$|\bdo (?:a|one) (?:little |full |complete "
     r"|quick )*(?:circle|spin|twirl|turn|pirouette|rotation|360)(?: on the spot)?\b"
     r"|\b(?:do|turn|make) a (?:full )?(?:360|three sixty)\b", "turn a full circle"),
    (r"\b(?:do|make|pull) a (?:little |quick )*(?:u turn|180|one eighty|about turn|half turn)\b|\babout face\b"
     r"|\bface the other way\b|\bturn (?:yourself )?(?:right )?(?:around|round)(?= and\b|,|$)", "turn around"),
    (rf"\bturn (?P<s>left|right),? (?:about |by |roughly |around |say )*(?P<n>{_NUMBER})(?= ?$|[,.])",
     r"turn \g<s> \g<n> degrees"),
    (rf"\b(?:drive|go|move|roll|carry|keep going|keep driving) on(?: for)? (?P<l>{EN_LENGTH})$",
     r"move forward \g<l>"),
    # people
    (r"\b(?:tag along(?: behind| with)?|trail after|stick (?:with|to|close to)|keep close to"
     r"|come along with|walk along with|keep pace with) ", "follow "),
    (r"\btell (?:whoever|anyone|anybody|everyone|everybody|the people)(?:'s| is| who is|s)? in"
     rf" (?P<p>{_PLACE}) (?:that )?(?P<w>[^\"]+)$", r'go to \g<p> and say "\g<w>"'),
    (rf"\b{_SAYS}(?: that)? (?P<w>(?!(?:if|when\w*|unless|until|once|as soon|for|to|what\w*|who|whether)\b)[^\",;]+)$", r'say "\g<w>"'),
    (rf"\bsay (?:that )?(?P<w>(?:i|we|he|she|they)(?:'ll| will|'re| are|'m| am|'s| is) {_SAYABLE})"
     r"(?=[.!]*$|[,;]| and (?:then )?(?:come|go|drive|head|return)\b)", r'say "\g<w>"'),
    (rf"\bsay (?!{_TO_SOMEBODY})(?P<w>[^\",;]*{MARK}[^\",;]*?),? (?:(?:and )?then (?={_ORDERS}\b)|and (?={_AND_GO}\b))",
     r'say "\g<w>", then '),
    (r"\bgo off (?:and|to) (?=(?:re)?charge\b)", ""),
    (rf"\bsay (?!{_TO_SOMEBODY}|{_ENDS_IN_ORDER})(?P<w>[^\",;]*{MARK}[^\",;]*)$", r'say "\g<w>"'),
    (r"(?<=then )tell (?:them|him|her|everyone) (?:that )?(?P<w>[^\",;]+?)(?=$|[,;])", r'say "\g<w>"'),
    (r"^(?P<c>if\b[^\"]+?)[, ]+(?:then )?tell (?:them|him|her|everyone|everybody) (?:that )?"
     r"(?P<w>[^\",;]+?)(?=$|[,;]? ?(?:otherwise|or else|else|if not)\b)", r'\g<c>, say "\g<w>"'),
    (r"\b(?:inform|advise) me\b", "tell me"),
    # looking
    (r"(?P<l>\b(?:look|check|see|peek|peep|glance|inspect)\b[^.;]*?)[, ]+and tell me what(?: all)? (?:you (?:can )?(?:see|find)|is (?:in )?there|is going on)$", r"\g<l>"),
    (r"[, ]+and (?:then )?come (?:back )?(?:and )?tell me (?:where (?:it|he|she) is|what you (?:find|see|found|saw))$",
     ", then come back"),
    (rf"\b(?:check|see|look) (?:if|whether) (?P<t>(?:the|my|a|our) [a-z ]+?) (?:has |have |had )?(?:rolled|fallen|fell|gone|went"
     rf"|slipped|got|ended up) (?:under|behind|beside|next to|in|into|to|on) (?P<p>{_PLACE})", r"look for \g<t> at \g<p>"),
    (rf"^have (?:we|i|you) (?:still )?(?:got )?(?:any|some) (?P<t>[a-z ]+?)(?: left)? (?P<w>in|at|on|by) (?P<p>{_PLACE})\??$",
     r"are there any \g<t> \g<w> \g<p>?"),
    (rf"^(?:go )?(?:look|check|peek|peep)(?: in| into| at| inside)? (?P<p>{_PLACE})[, ]+(?:and )?if (?:it is|it's|that is) empty,?",
     r"if there is nobody in \g<p>,"),
    (rf"^is there (?:something|anything) (?:lying |standing |sitting )?(?:in front of|before|outside) (?P<p>{_PLACE})\??$",
     r"is there anything at \g<p>?"),
    (rf"\b{_LOOKS} (?:a?round|at|in|inside|into|through)? ?(?P<p>{_PLACE})"
     r"[, ]+(?:and )?(?:tell|let|inform) me(?: know)? (?:if|whether) you (?:spot|see|find|notice)"
     r" (?P<t>(?:my|the|a|an|any) [a-z ]+)$", r"look for \g<t> in \g<p>"),
    (rf"\b{_LOOKS} (?:a?round|at|in|inside|into|through)? ?(?P<p>{_PLACE})(?: for (?P<t>[a-z ]+))?$",
     r"look in \g<p>"),
    (rf"\b(?:give|get) me eyes on (?P<p>{_PLACE})", r"look at \g<p>"),
    (rf"^(?P<q>(?:is|are|how many|what|who|whose)\b[^?]*?[a-z\ue000-\ue7ff])[?,.]* {_HAVE_A_LOOK}$", r"\g<q>?"),
    (r"^(?:where (?:is|are|on earth (?:is|are|has)|has)) (?P<t>(?:the|my|our|that) [a-z]+(?: [a-z]+)??)"
     rf"(?: gone| got to)?[?,.]* {_HAVE_A_LOOK}$", r"find \g<t>"),
    (r"\band (?:let|tell) me(?: know)? if (?:anything|something)(?: is| looks| seems)?"
     r" (?:odd|wrong|off|strange|weird|out of place|amiss|unusual)$", ""),
    (rf"^(?:is|are) there (?P<t>(?:a|an|any|some) [a-z ]+?) (?:under|behind|in front of|beside|next to) (?P<p>{_PLACE})\\??$",
     r"is there \g<t> at \g<p>?"),
    (rf"^(?:go )?(?:look|check|see)(?: in| at| inside)? (?P<p>{_PLACE})(?: for [a-z]+)?[.,;]* (?:and )?if (?:she|he|somebody|someone"
     r"|anybody|they)(?:'s| is| are) (?:in )?there,?", r"if there is somebody in \g<p>,"),
    # home and rounds
    (rf"\bhome to {_PLACE}(?=$|[,.])", "go home"),
    (rf"\b(?:off|away|over) to (?P<p>{_PLACE}) with you\b", r"go to \g<p>"),
    (rf"^(?:do|make|drive|take|go) (?P<n>two|three|four|five|\d) (?:rounds|laps|tours|circuits|turns) (?:of|through|around|round|between)"
     rf" (?P<l>{_PLACE}(?:(?:,? and|,) {_PLACE})+)$", r"patrol \g<l>, \g<n> times"),
    (rf"\b(?:go )?(?:and )?(?:park|plug|dock|plonk|sit|put) yourself(?: in| down)? (?:on|at|in|into|to|by|near|next to) (?P<p>{_PLACE})",
     r"go to \g<p>"),
    (rf"\b(?:go |come |get |head )?(?:on |right |straight )?back (?:to|on|onto|in|into) (?P<p>{_PLACE})$", r"go to \g<p>"),
    (r"\b(?:park|plug|dock) yourself(?: in)?(?: (?:on|at|in|into|to) (?:the |your )?(?:charger|dock"
     r"|charging (?:dock|station)|station))?\b|\b(?:back|off) to (?:base|the dock|your (?:dock|charger)"
     r"|the charger)\b|\bcharge up(?: (?:at|on) (?:the |your )?(?:station|dock|charger))?"
     r"|\bgo back (?:and |to )charge\b|\b(?:go )?(?:get )?charge yourself(?: up)?\b|\b(?:go|head|run) (?:on )?home\b", "go charge"),
    (r"\b(?:go|drive|walk|wander|roam|run)(?: all)? (?:a?round|through|into) (?:all|every|each)(?: of)?(?: single)?"
     r"(?: (?:the|our|my))? rooms?\b", "patrol all rooms"),
    (rf"\b(?:do|make|take|drive|go) (?P<n>two|three|four|five|[2-5]) (?:laps|rounds|tours|circuits) (?:of|round|around|through)"
     rf" (?:the|our|my) (?:whole |entire )?{_HOME}(?=$|[.!])", r"patrol the house, \g<n> times"),
    (rf"\b(?:do|make|take|have|go on|go for) (?:a|the|your|one|another) (?:quick |little |full )*(?:lap|round"
     rf"|rounds|tour|sweep|circuit|patrol|walk|turn|(?:wander|stroll|drive|scout)(?= (?:a?round|through))){_AROUND}(?=$|[,.!?]| \w+ times| twice| and\b)"
     rf"|\bpatrol(?: (?:the|our|my) (?:whole |entire )?{_HOME})?(?=$|[,.!?]| \w+ times| twice| and\b)"
     rf"|\b(?:tour|circle|walk around|go around|wander around|cruise around) (?:the|our|my) (?:whole |entire )?{_HOME}",
     "patrol the house"),
    (rf"\b(?:go )?(?:back and forth|to and fro|backwards and forwards) between (?P<a>{_PLACE}) and (?P<b>{_PLACE})"
     r" (?P<n>twice|\w+ times)$", r"go to \g<a> then go to \g<b>, \g<n>"),
    (rf"^(?:go )?to (?P<a>{_PLACE}) and back(?: again)? (?P<n>twice|\w+ times)", r"go to \g<a> then come back, \g<n>"),
    (rf"\bturn (?:a?round )?(?:to face|and face|towards?) (?P<p>{_PLACE})", r"face \g<p>"),
    # waiting
    (rf"\b(?:stop|halt|pause)(?: off)? (?:at|by|in) (?P<p>{_PLACE}) for (?P<d>{EN_DURATION})",
     r"go to \g<p> and wait \g<d>"),
    (rf"\b(?:hang about|hang on|hang around|hold on|stick around|linger|chill|loiter|keep watch|stand guard"
     rf"|sit tight)(?: here| there)?(?: for)?(?: about| around| roughly)? (?P<d>{EN_DURATION})", r"wait \g<d>"),
    (rf"\b(?:wait|stay|pause|stand)(?: here| there)? for (?:about|around|roughly) (?P<d>{EN_DURATION})", r"wait \g<d>"),
    (rf"^wait for me (?:in|at|by|near) (?P<p>{_PLACE})$", r"go to \g<p> and wait for somebody"),
    (rf"\b(?:go |come )?(?:and )?(?:park|wait|stay|stand|sit|hang out|hang about|hover|post yourself|park yourself"
     rf"|stand guard)(?: right)? (?:in|at|by|on|near|next to|beside) (?P<p>{_PLACE})(?= (?:and|until|till|for|then)\b|[,.]|$)",
     r"go to \g<p> and stay there"),
    (r"\band stay there (?=(?:until|till) )", "and wait "),
    (rf"\band stay there for (?P<d>{EN_DURATION})", r"and wait \g<d>"),
    # going
    (rf"(?P<p>{MARK}) (?=(?:turn|come|go|drive|look|wait|find|count|say|tell|check|see|ask|patrol|follow|then)\b)", r"\g<p>, "),
    (r"[, ]*\band after (?:that|this)\b", ", then"),
    (rf"\b(?:off you (?:go|trot|pop|toddle|pootle)|{_GOES}){_ASIDE} (?:to|into|in|towards?|by|at|near|next to)"
     rf" (?P<p>{_PLACE})", r"go to \g<p>"),
    (rf"^(?:be |right )?(?:you )?(?:to be )?(?:next to|beside|by|at|in|near) (?P<p>{_PLACE})$", r"go to \g<p>"),
    (rf"\bcome (?:and )?(?:play|sit|hang out|join us|help)(?: with (?:me|us))? (?:in|at|by) (?P<p>{_PLACE})$",
     r"go to \g<p>"),
    (rf"\b(?P<v>(?:count|look|check|search|find|see|how many|is there|are there)\b[^,.;!?]*? (?:in|at|on|by))"
     rf" (?P<l>{_PLACE}(?:, {_PLACE})*),? and (?={_PLACE}(?:[,.!?]|$))", r"\g<v> \g<l> and in "),
    (rf"^(?:first,? )?(?:to )?(?P<p>{_PLACE})(?=(?: then| and then|,| and)+ )", r"go to \g<p>"),
    (rf"(?:(?<= then )|(?<=, )|(?<= and ))(?:to )?(?P<p>{_PLACE})(?=(?: then| and then|,| and)+ |$)", r"go to \g<p>"),
    (rf"(?P<a>^|, )(?P<p>{_PLACE}) (?={_PLACE}(?: {_PLACE})*$)", r"\g<a>\g<p>, "),
    (rf"^(?:to )?(?P<p>{MARK})[.!]*$", r"go to \g<p>"),
)  # fmt: skip
