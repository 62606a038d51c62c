"""A skill: one function, which works its steps out. Copy it into $PONS_HOME/skills."""

from pons.skill import Duration, Step, World, ask, go_to, patrol, say

_PER_ROOM_S = 60


def plants(long: Duration, world: World) -> list[Step]:
    """Go round the rooms that time is left for, so that somebody waters the plants.

    en: [do] the plant round for {long}
    zh: 做{long}的浇花巡视
    """
    rooms = world.rooms()[: max(1, int(long // _PER_ROOM_S))]
    if world.battery is not None and world.battery < 0.2:
        return [say("My battery is too low for the plants.")]
    if len(rooms) == 1:
        return [go_to(rooms[0]), say(f"Only the {world.name(rooms[0])} today.")]
    return [ask(f"{len(rooms)} rooms: have you water enough?"), patrol(rooms)]
