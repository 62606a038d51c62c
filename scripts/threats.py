# ruff: noqa: E501  # names of tests and rows of a Markdown table can not be broken
"""Print docs/security.md from the table of attacks that were tried, each with the tests that prove it.

``python -m scripts.threats`` writes the page, with ``--check`` it tells by its exit status whether
the page is fresh. A test holds every named test to exist.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

PAGE = Path(__file__).resolve().parents[1] / "docs" / "security.md"


@dataclass(frozen=True, slots=True)
class Threat:
    """Describe one attack or fault, what the product does about it, and the tests that try it."""

    attack: str
    answer: str
    tests: tuple[str, ...]
    """``folder/file.py::function`` below ``tests/``."""


@dataclass(frozen=True, slots=True)
class ThreatAsker:
    """Describe somebody who may sit somewhere, and what they can and can't do there."""

    who: str
    can: str
    cannot: str


ASKERS = (
    ThreatAsker("anybody on the network, without a token",
          "load the page, which holds no secret; hold some connections for 5 s",
          "read the robot, order anything, keep a stop from another address or connection"),
    ThreatAsker("a web page of another site, in the browser of somebody with a token",
          "nothing: Host, Origin and content type are judged, and the token lies in no cookie",
          "order, read or frame the robot"),
    ThreatAsker("who has the viewer's token",
          "read all that the page shows; stop, protective stop, disarm",
          "make anything move, arm, change a place or the fence; read what a model wrote"),
    ThreatAsker("who has the operator's token",
          "give goals, steer by hand within its meter",
          "arm or clear a hold of a robot of metal without the operator's key"),
    ThreatAsker("the planner's user (a planner that was taken over)",
          "everything that a person may ask for at the bridge's door; show a person something untrue "
          "in the page; answer the shell that a stop was confirmed, where that shell can't ask "
          "the bridge",
          "say what the lidar, the wheels or localization saw; reach the wheels past the bridge; read "
          "the operator's key; foretell a nonce; drive further than a person granted; stand in for "
          "the bridge before the shell's direct way"),
    ThreatAsker("localization's and the camera's users",
          "what the planner's user may; localization also says where the robot is, within what "
          "odometry allows",
          "reach the wheels or the lidar"),
    ThreatAsker("the bridge's and the drive's users, and root",
          "everything", "be guarded against by this software"),
    ThreatAsker("a user of the machine in none of the groups",
          "ask at the planner's HTTP port: without tokens that is all that an operator's token may; "
          "stop every robot that runs there; leave a note of a robot that is none, which is named "
          "with its user's number",
          "connect to any door of the robot; hide another's robot from `pons stop`; be sent a token"),
    ThreatAsker("whoever reaches the transport of a ROS 2 base (rosbridge, DDS, zenoh)",
          "hear lidar, odometry and the relay; say what the base itself may be told past the relay, "
          "where its cmd_vel is open to all; without a key for the relay also command it, until the "
          "bridge sees that (`DRIVE_FOREIGN`)",
          "command a relay that has a key ([ros2.md](ros2.md)); reach a loopback from elsewhere"),
)  # fmt: skip

_CONNECTIONS = "planner/api/test_connections.py"
_STOP = "pons/test_stop.py"
_FALSE = "bridge/core/sensing/test_sensor_update_lies.py"
_DESK = "pons/robot/test_trial_desk.py"
_KEY = "bridge/test_operator_key.py"

THREATS = (
    Threat(
        "A standing order that a model, a stop word, a viewer or a flood of orders would make",
        "No model makes one; an order's words are read and judged as they are given and again at each firing, what moves beyond them waits for a yes; 64 orders, 5 minutes apart; a viewer gets 403",
        (
            "planner/orders/test_with_missions.py::test_a_model_that_drives_elsewhere_at_its_time_is_asked_about",
            "planner/orders/test_with_missions.py::test_nothing_fires_after_a_stop_until_a_person_acts",
            "planner/api/test_order_routes.py::test_a_viewer_may_look_and_change_nothing",
            "planner/api/test_order_routes.py::test_no_more_orders_are_kept_than_a_page_can_show",
        ),
    ),
    Threat(
        "A yes of somebody who may only look, or of the model itself, to a plan that waits for a person",
        "The viewer's token gets 403 `operator_needed` on every way to say yes; what a model says, offers or fills in is nobody's answer, and an order that its yes would begin waits again",
        (
            "planner/api/test_real_missions.py::test_a_viewers_yes_to_an_open_confirmation_is_refused_and_an_operators_drives",
            "planner/api/test_real_missions.py::test_a_model_that_says_yes_itself_confirms_nothing",
            "planner/api/test_real_missions.py::test_a_model_that_decides_upon_its_own_question_does_not_answer_it",
        ),
    ),
    Threat(
        "Plans and bodies that are nested without end",
        "A plan's steps stand 3 deep at most (`bad_plan`, an order is `order_not_understood`); a body that no parser of ours goes down is 400 `malformed_json`",
        (
            "planner/api/test_real_missions.py::test_conditions_that_a_model_nests_beyond_the_bound_are_refused_as_goal_and_as_order",
            "planner/api/test_order_routes.py::test_a_body_that_is_nested_without_end_is_refused_with_a_code",
        ),
    ),
    Threat(
        "An address that is told of standing orders hangs, redirects or fails",
        "Three tries in 12 s beside everything else, 32 messages wait at most, no redirect is followed, the URL is never logged",
        (
            "planner/orders/test_notifier.py::test_tries_are_bounded_and_no_redirect_is_followed",
            "planner/orders/test_notifier.py::test_a_dead_address_is_given_up",
            "planner/orders/test_notifier.py::test_no_more_than_so_many_wait",
        ),
    ),
    Threat("Connections that send nothing, or trickle, by the thousand",
           "A request's head has 5 s, a body 5 s and 64 kB/s; 128 connections an address, 512 in all; room "
           "is made by the oldest without a complete request, by one with a stop last",
           (f"{_CONNECTIONS}::test_a_connection_without_a_complete_request_ends",
            f"{_CONNECTIONS}::test_what_trickles_ends",
            f"{_CONNECTIONS}::test_when_room_is_short_the_oldest_without_a_request_goes_and_a_stop_is_served",
            "planner/api/test_crowd.py::test_connections_leave_files_for_everything_else")),
    Threat("TLS clients that never shake hands",
           "They are let go after 5 s",
           ("planner/test_tls.py::test_a_client_that_never_shakes_hands_is_let_go",)),
    Threat("Headers without end, many or one",
           "431 `headers_too_large` at 32 KiB or 100 fields, trailers and extensions included",
           (f"{_CONNECTIONS}::test_headers_are_bounded_wherever_they_stand",)),
    Threat("Malformed Host or Origin",
           "403 without a traceback",
           ("planner/api/test_middleware.py::test_a_malformed_host_leaves_no_traceback",)),
    Threat("A log that is flooded",
           "`pons up` keeps 10 MB and two older files of each log; wrong tokens are one line in 10 s",
           ("pons/test_supervisor.py::test_a_log_that_floods_fills_no_disk_and_its_writer_lives",
            "planner/api/test_middleware.py::test_a_thousand_guesses_are_a_few_lines")),
    Threat("Goals of 200 000 characters, or 50 a second; sockets that ask for snapshots for ever",
           "4 000 characters, 2 a second of an address after 50, one snapshot a second a socket, lists "
           "below 1 MB; a stop has none of these bounds",
           ("planner/api/test_goals.py::test_a_sentence_of_4_000_characters_is_taken_and_a_longer_one_refused",
            "planner/api/test_goals.py::test_goals_have_a_rate_and_stops_have_none",
            "planner/api/test_listing.py::test_a_list_of_the_longest_goals_is_below_a_megabyte_and_names_all_that_are_open",
            "planner/api/test_websocket.py::test_snapshots_that_are_asked_for_at_once_are_one_a_second",
            "planner/api/test_websocket.py::test_a_stop_has_no_rate")),
    Threat("The stop at the robot itself: a foreign lock, a full disk, a read-only home, a wrong or "
           "missing robot.toml, a hung or dead planner",
           "`pons stop`, `estop` and `disarm` take no lock, write nothing and ask any robot that is there; "
           "whatever breaks one way, the other is waited for",
           (f"{_STOP}::test_the_robot_stands_still_on_a_full_disk",
            f"{_STOP}::test_the_robot_stands_still_with_no_byte_left_to_write",
            f"{_STOP}::test_the_robot_stands_still_for_who_may_write_nothing_in_its_home",
            f"{_STOP}::test_whatever_robot_toml_says_the_robot_that_is_there_stands_still",
            f"{_STOP}::test_a_hung_planner_does_not_keep_the_stop",
            f"{_STOP}::test_whatever_breaks_the_second_way_the_first_is_waited_for")),
    Threat("Somebody takes the bridge's place at its socket",
           "Each door's folder is its listener's alone to write; the shell asks the kernel who listens, "
           "sends a stop all the same, signs nothing and does not say confirmed",
           (f"{_STOP}::test_who_took_the_bridges_place_is_told_to_stop_but_not_believed",
            "wire/test_sockets.py::test_a_folder_in_which_others_could_replace_a_socket_is_refused",
            "deploy/test_users.py::test_each_user_says_what_its_groups_let_it_and_takes_nobodys_place")),
    Threat("A planner that was taken over answers `pons stop` that the bridge confirmed",
           "The shell asks the bridge itself as well, and says confirmed on its word alone; where it can't be "
           "asked, from another machine or by a user without the right, the shell says whose word it has",
           (f"{_STOP}::test_a_planner_that_says_confirmed_is_not_believed_where_the_bridge_is_silent",
            f"{_STOP}::test_the_bridge_is_asked_even_where_the_planner_has_confirmed",
            f"{_STOP}::test_where_no_bridge_is_in_reach_the_planners_word_is_called_so",
            f"{_STOP}::test_who_may_not_ask_the_bridge_is_told_the_planners_word")),
    Threat("The planner's user says a scan, a pose, a drive's state or a drive's command",
           "It is heard nowhere: senses and wheels have doors of their own, and no session relays",
           ("wire/test_doors.py::test_what_the_bridge_drives_by_comes_in_where_neither_planner_nor_operator_knocks",
            "wire/test_doors.py::test_only_the_bridge_may_reach_the_wheels",
            "wire/test_strangers.py::test_a_stranger_reaches_the_listener_of_one_door_with_what_it_hears",
            "wire/test_strangers.py::test_without_access_control_a_client_would_be_relayed")),
    Threat("Somebody answers in an absent camera's place and says what the bridge is doing",
           "Pictures are all that is heard there",
           ("wire/test_strangers.py::test_who_takes_an_absent_cameras_place_says_pictures_and_nothing_else",)),
    Threat("Localization creeps away bit by bit, or leaps again and again",
           "More than odometry may have been wrong takes the grant; the third time in a minute disarms",
           (f"{_FALSE}::test_no_small_steps_move_the_pose_of_a_standing_robot_far",
            f"{_FALSE}::test_a_pose_that_drifts_on_and_on_disarms")),
    Threat("Somebody else commands the drive",
           "An echo of what was never sent, or of another's command, stops the robot until a reset (`DRIVE_FOREIGN`); a ROS 2 relay with a key takes no stranger's command",
           (f"{_FALSE}::test_an_echo_of_what_was_never_sent_stops_and_needs_a_reset",
            f"{_FALSE}::test_an_echo_of_another_commander_stops_at_once",
            "examples/ros2_relay/test_relay.py::test_with_a_key_only_what_is_signed_with_it_moves_the_base")),
    Threat("A stop that is taken for an old one, or lost among garbage and known ids",
           "An id is a repeat for 5 s and never across a resume, reset or arm; what can't be read on a stop's key stops; the whole ring is read",
           ("bridge/core/modes/test_operator.py::test_a_known_id_stops_again_once_the_robot_was_let_go",
            "bridge/test_link.py::test_a_stop_behind_many_that_have_their_verdict_is_seen",
            "bridge/test_link.py::test_one_readable_stop_among_unreadable_ones_is_seen")),
    Threat("A note that hides or forges a running robot",
           "A note counts where folder, file and name are of one user and its writer lives; no token goes to another user's planner",
           ("pons/test_running.py::test_a_note_in_anothers_name_is_not_believed",
            "pons/test_running.py::test_a_note_that_is_none_hides_no_other")),
    Threat("One message with a number far ahead shuts the true sensor out",
           "Far numbers are not believed while the sender speaks, and any number counts after silence",
           (f"{_FALSE}::test_one_number_far_ahead_shuts_no_lidar_out",)),
    Threat("A stick that nobody holds drives on, out of the fence",
           "By hand 50 m and 600 s after a signed act; a metre outside counts ten (`HAND_BUDGET`)",
           ("bridge/core/authority/test_ownership_grants.py::test_a_hand_stands_when_its_metres_are_spent_and_a_signed_act_renews_them",
            "bridge/core/authority/test_ownership_grants.py::test_a_metre_outside_the_fence_counts_ten_of_the_hands")),
    Threat("A stick gripped anew after a person's stop, by a client without a proof",
           "A stop takes what a hand may drive; only a signed act (resume, arm) gives it anew",
           ("bridge/core/authority/test_ownership_grants.py::test_after_a_stop_no_stick_moves_the_robot_before_a_signed_act",)),
    Threat("A person's proof is collected for later",
           "Nonces hold 64 bits of chance drawn for the tick, and none outlives a stop, a protective stop "
           "or a disarm; a proof binds kind, robot, run, request and nonce, a fence's also its text",
           ("bridge/core/laws/test_nonces.py::test_a_proof_under_a_nonce_that_was_not_shown_yet_never_counts",
            "bridge/core/laws/test_nonces.py::test_after_a_stop_no_proof_from_before_it_counts")),
    Threat("The operator's key is guessed, read, exchanged or put there by another",
           "`pons key new` draws 32 random bytes; a link, a pipe, another owner or other readers are refused; "
           "the page takes the key on secure pages alone",
           (f"{_KEY}::test_a_key_that_is_a_link_refuses_to_start",
            f"{_KEY}::test_a_key_of_another_user_refuses_to_start",
            f"{_KEY}::test_a_key_that_others_can_reach_refuses_to_start",
            "pons/test_key.py::test_the_key_is_random_private_printable_and_taken_by_the_bridge")),
    Threat("Set-up whose nonce anybody spends, or whose page another client stands in for",
           "Only a begin with a fitting proof spends the nonce; the state shows a digest of the begin's id, and a watch "
           "names the id itself",
           (f"{_DESK}::test_without_a_fitting_proof_nothing_is_opened_and_a_nonce_counts_once",
            f"{_DESK}::test_what_a_page_shows_of_a_trial_does_not_let_another_watch_it")),
    Threat("A planner that hangs, by a sentence or otherwise",
           "Its loop feeds a watchdog: after 5 s without a beat `pons up` and systemd start it again; the robot stands "
           "long before that (`BRAIN_LOST`), and what was under way waits for a person",
           ("pons/test_supervisor.py::test_a_child_whose_loop_falls_silent_is_killed_and_due_again",)),
    Threat("The path between browser and planner is listened to or rewritten",
           "`pons up --tls`, a pair of your own, or nginx or Caddy ([tls.md](tls.md))",
           ("planner/test_tls.py::test_a_pair_that_does_not_fit_is_refused_in_one_line",
            "pons/test_authority.py::test_a_stolen_authority_signs_for_no_bank",
            "pons/test_http.py::test_nothing_is_said_in_clear_to_a_planner_that_speaks_tls",
            "deploy/test_proxies.py::test_a_stop_goes_through_with_nothing_but_the_token")),
    Threat("A proxy before a planner that trusts loopback",
           "What a proxy hands on is refused without a token (403 `proxy_without_token`), stops excepted",
           ("planner/api/test_middleware.py::test_what_is_refused_is_told_in_both_languages",)),
    Threat("Wrong tokens by the thousand", "Each waits longer, up to 2 s; a right one never waits",
           ("planner/api/test_middleware.py::test_each_wrong_token_of_an_address_waits_longer_and_none_for_ever",
            "planner/api/test_middleware.py::test_a_right_token_is_served_while_its_address_guesses")),
    Threat("A stop in a binary frame, a dead-man that is a word",
           "A stop is a stop in either kind of frame; a dead-man is true or false",
           ("planner/api/test_websocket.py::test_a_stop_is_a_stop_in_either_kind_of_frame",
            "planner/api/test_goals.py::test_steering_takes_nothing_for_what_it_is_not")),
    Threat("Map images that are devices, pipes or huge; paths out of the site; aliases without end",
           "Plain files within the site's folder, bounded before they are read; YAML written out",
           ("wire/test_plain_file.py::test_a_device_a_pipe_a_folder_and_a_socket_are_no_plain_files",
            "wire/test_site_map.py::test_an_image_outside_the_sites_folder_is_refused")),
    Threat("A recording whose frame claims a gigabyte",
           "Refused before it is unpacked",
           ("bridge/recording/test_mcap_file.py::test_a_frame_that_unpacks_to_more_than_its_chunk_says_is_never_unpacked",)),
    Threat("A place called “yes”, or drawn as another's name",
           "Refused by name",
           ("planner/site/test_known_places.py::test_a_name_that_looks_like_another_is_refused",)),
    Threat("Others of the machine read every sentence said",
           "`pons up` and the units keep files for their own user",
           ("pons/test_private.py::test_what_a_robot_keeps_is_readable_by_its_own_user_alone",)),
    Threat("A bridge that was frozen for seconds goes on",
           "From zero, where the drive has timed out meanwhile",
           ("bridge/core/motion/test_wheel_command.py::test_after_a_freeze_nothing_is_ramped_down",)),
)  # fmt: skip

_INTRODUCTION = """\
# Security

Generated by `python -m scripts.threats`; `make docs` writes it anew and `make check` fails when it is
stale. How hazards of the robot itself are watched: [safety.md](safety.md). How to deploy it with a user
for each process: [deploy.md](deploy.md). `make attack` repeats the attacks from outside.

The bridge believes nobody about safety: a planner may crash, hang or lie, and the robot then stands or
drives what a person granted, inside of the fence, as slowly as the lidar's picture asks for. That holds
where the processes have users of their own. Under one user (`pons up`, one container) the kernel parts
nothing: whoever runs code as that user may take any process's place.

## Who may sit where

| who | can | cannot |
|---|---|---|
"""

_TRIED = """
## What was tried

Each line is an attack or a fault that worked once, what answers it now, and the tests below `tests/`
that fail without the answer.

| attack or fault | answer | tests |
|---|---|---|
"""

_OPEN = """
## What is not promised

- A webhook or ntfy topic that the owner sets learns when somebody is at home, what the robot is asked to do and how it
  went (`words = false`: codes alone); whoever reads the topic reads that. No picture and no position is sent.
- A simulated robot (a virtual drive) has no key: whoever may give orders ends another's stop with the next order, in the same
  moment. Two people with one simulated robot, a class for example, should know it. With metal each order that ends a
  stop needs the operator's own proof, made after that stop.
- From another machine, or as a user without the right to the bridge's socket, `pons stop` has the planner's
  word alone, and says so. Whoever doubts it says `pons stop` at the robot, or presses the robot's own button.
- A planner that was taken over can show anything in the page. The page signs what it shows, for the nonce of this moment and one kind
  of act; a person who sees an untrue picture may still sign for a true act.
- A flood of complete requests is not limited by rate, goals excepted; a stop by a new connection took at
  most 0.1 s beside the floods that were tried (ADR 0029).
- Access to the machine (root, the bridge's or the drive's user, its cables) is access to the wheels.
- No package was judged by `make audit` where no database could be reached; it then says NOT AUDITED.
- The robot's own radio, operating system, model endpoint and browser are not ours.
"""


def render() -> str:
    """Return the whole page."""
    askers = [f"| {asker.who} | {asker.can} | {asker.cannot} |\n" for asker in ASKERS]
    threats = [
        f"| {threat.attack} | {threat.answer} | "
        + "<br>".join(f"`{test}`" for test in threat.tests)
        + " |\n"
        for threat in THREATS
    ]
    return "".join([_INTRODUCTION, *askers, _TRIED, *threats, _OPEN])


def main(arguments: list[str]) -> int:
    """Write or check the page; 1 where it is stale."""
    if arguments != ["--check"]:
        PAGE.write_text(render(), "utf-8")
        return 0
    if PAGE.exists() and PAGE.read_text("utf-8") == render():
        return 0
    print(f"{PAGE} is not what the table says; run python -m scripts.threats")
    return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
