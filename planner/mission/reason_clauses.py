"""Own the clauses that say why beside a few words, and order nothing: "I think you missed one".

Data only: the patterns end where the clause ends, and a clause with an order, a condition or a
question in it is none of them.
"""

from __future__ import annotations

_ORDERS = (
    r"(?:go|come|drive|turn|move|look|find|search|check|count|follow|wait|say|tell|ask|try|bring"
    r"|stop|if|unless|until|till|when|while|or|instead|please|then|not)"
)
_WHO = (
    r"(?:i|we|you|he|she|it|they|there|that|this|one|somebody|someone|nobody|no one"
    r"|(?:the|my|our|his|her) [a-z]+|[a-z]+(?='))"
)
REASON = rf"(?:because |since )?(?!.*\b{_ORDERS}\b){_WHO}(?:'[a-z]+)? [a-z' ]{{2,60}}"
"""One English clause without a comma; "n't" may stand in it, a denied order may not."""
_ORDERS_ZH = (
    r"(?:如果|要是|假如|的话|除非|别|不要|不用|停|去(?![了过])|回来|过来|到(?![了过处])|改|换|先"
    r"|而是|还是|吗|告诉|帮我|请)"
)
REASON_ZH = (
    rf"(?!.*{_ORDERS_ZH})(?:我|你|[他她它]们?|应该|好像|肯定|可能|刚才|刚刚|都|已经|还有|不止|怎么"
    r"|漏|少|大家|客人|奶奶|爷爷|妈妈?|爸爸?)[^,。;!?]{1,16}"
)
"""One Chinese clause."""
