"""Own the everyday English words that a robot overhears: an order must sound better than they do.

Not what may be said to it, only what else may be said near it. Words of every length and sound
matter more here than words of any meaning.
"""

from __future__ import annotations

COMMON = tuple(
    """
    a about after again all also always am an and any anybody anything are around as ask at away
    baby back bad ball be because been before began begin behind below best better between big
    black blue boil book both box boy bread break bring brother brought brown build but buy by
    cake call came can can't car care carry cat chair change check child children church city clean
    close clothes coat coffee cold color come cook could country cup cut
    dad dance dark day dear did didn't different dinner dirty do doctor does dog doing don't done
    door down draw dress drink drive drop drove
    each early earth easy eat egg eight else empty end enough even evening ever every everybody eye
    face fall family far farm fast father feel feet few fight fill find fine finger finish fire
    first fish five flower fly follow food foot for forget four friend from front full funny
    game garden gave get girl give glad glass go goes going gone good got grandma great green
    had hair half hand happy hard has hat have he head hear heard heart heavy hello help her here
    high him his hold hole home hope horse hot hour house how hungry hurry
    I if in inside into is it its
    job just keep kept key kind king knew know
    lady large last late laugh lay learn leave left leg let letter life light like line listen
    little live long look lost lot loud love lunch
    made make man many may maybe me mean meet men milk mine minute mom money month moon more morning
    most mother mouth move movie much music must my
    name near need never new news next nice night nine no nobody noise north not nothing now number
    of off often oh okay old on once one only open or orange other our out outside over own
    page paint pants paper park part party pass pay people person phone pick picture piece place
    plant play please point poor pretty problem pull push put
    question quick quiet quite rain ran reach read ready really red remember rest return ride right
    river road rock round run
    sad safe said same sat saturday saw say school sea second see seem sell send seven shall she
    ship shirt shoe shop short should show shows shut sick side silly sing sister sit six sky sleep
    slow small smell snow so soap sock soft some somebody something son song soon sorry sound soup
    south speak spoon stand star start stay step still stop store story street strong such sugar
    summer sun sunday supper sure sweet swim
    take talk tall tea teacher tell ten than thank that the their them then there these they thing
    think third this those though thought three through throw time tired to today together told
    tomorrow too took top touch town toy train tree trip true try turn two
    uncle under until up upon us use
    very visit voice wait wake walk wall want warm was wash watch water way we weather week
    well went were wet what wheel when where which
    while white who whole why will wind window winter wish with
    without woman won't word work world would write wrong
    year yellow yes yesterday yet you young your
    """.lower().split()
)
