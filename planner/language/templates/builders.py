"""Name the plans that templates may have, and what builds the meaning of each."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.templates import driving, people, sights, skills

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from planner.language.grammar.parse_result import Meaning, Reading
    from planner.language.templates.template_file import TemplateFind

BUILDERS: Mapping[str, Callable[[TemplateFind, Reading], Meaning | None]] = {
    "home": driving.home,
    "come_back": driving.come_back,
    "drive_to": driving.drive_to,
    "drive_into": driving.drive_into,
    "route": driving.route,
    "set_out": driving.set_out,
    "stay_at": driving.stay_at,
    "stand": driving.stand,
    "ask": driving.ask,
    "wait": driving.wait,
    "wait_for": driving.wait_for,
    "turn": driving.turn,
    "move": driving.move,
    "turn_and_move": driving.turn_and_move,
    "stand_at": driving.stand_at,
    "patrol": driving.patrol,
    "patrol_all": driving.patrol_all,
    "in_all": driving.in_all,
    "at_stops": driving.at_stops,
    "explore": driving.explore,
    "map_alone": driving.map_alone,
    "say": driving.say,
    "say_hello": driving.say_hello,
    "say_often": driving.say_often,
    "unread": driving.unread_way,
    "next_place": driving.next_place,
    "meet": people.meet,
    "call_somebody": people.call_somebody,
    "go_up_to": people.go_up_to,
    "greet": people.greet,
    "present_itself": people.present_itself,
    "follow": people.follow,
    "guide": people.guide,
    "introduce": people.introduce,
    "tell_topic": people.tell_topic,
    "tell_words": people.tell_words,
    "tell_quote": people.tell_quote,
    "ask_for_words": people.ask_for_words,
    "request": people.request,
    "ask_somebody": people.ask_somebody,
    "bring_answer": people.bring_answer,
    "describe": people.describe,
    "hold_dialogue": people.hold_dialogue,
    "lacks_means": people.lacks_means,
    "find": sights.find,
    "find_by": sights.find_by,
    "find_in_unknown": sights.find_in_unknown,
    "find_each": sights.find_each,
    "count": sights.count,
    "count_all": sights.count,
    "count_by": sights.count_by,
    "look": sights.look,
    "look_there": sights.look_there,
    "look_here": sights.look_here,
    "look_all": sights.look_all,
    "look_by": sights.look_by,
    "report": sights.report,
    "tell_back": sights.tell_back,
    "seek": sights.seek,
    "next_thing": sights.next_thing,
    "use_skill": skills.use_skill,
}
