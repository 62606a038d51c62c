"""Hold what the help of each command says: its line in the list, a sentence, and examples.

Nothing but text, for every ``--help`` passes by here. ``EXIT_STATUS`` is the one table of what a
command's exit status means.
"""

from __future__ import annotations

EXIT_STATUS = (
    (0, "done"),
    (1, "not so: a goal failed, a check found something, or there is nothing to show"),
    (2, "can't be done as it stands: words, setting, file or machine must be mended first"),
    (3, "refused, by the planner, the bridge or the command; the robot did nothing of it"),
    (4, "the goal was cancelled"),
    (5, "the goal waits for a person, or is paused"),
    (6, "nobody answers, or the bridge did not confirm"),
    (130, "ended by Ctrl-C"),
    (141, "nobody read the output to its end"),
)
"""One meaning each, of every command."""


def _entry(line: str, sentences: str = "", *examples: str) -> tuple[str, str, tuple[str, ...]]:
    return line, sentences, examples


HELP = {
    "up": _entry(
        "start the robot: simulator or drive, localization, bridge, planner and page",
        "Start all processes of a robot and keep them running until Ctrl-C. Without options "
        "it is the simulated robot in the demo home. See also: pons down, pons logs, pons "
        "open.",
        "pons up",
        "pons up -d",
        "pons up --robot waveshare_ugv_rover --twin",
        "pons up --map attic",
    ),
    "down": _entry(
        "end the `pons up` of this robot: it brakes, then every process ends",
        "End what `pons up` has started, also in the background. The robot brakes first. "
        "Services of systemd are ended by systemctl.",
        "pons down",
    ),
    "logs": _entry(
        "show what the robot's processes have logged",
        "Show the newest lines of the logs, each with its process; -f goes on showing.",
        "pons logs",
        "pons logs planner -n 100",
        "pons logs -f bridge",
    ),
    "open": _entry(
        "open the robot's page in a browser",
        "Open the page of the running robot in this machine's browser, and print its address.",
        "pons open",
    ),
    "record": _entry(
        "write recordings of the black box as a rosbag2 for the tools of ROS 2",
        "Write recordings of one run as a rosbag2: a folder with an MCAP file of ROS 2 messages "
        "(scan, tf, odom, pose, plan, cmd_vel, rosout, diagnostics); docs/black-box.md.",
        "pons record export .pons/recordings/20261121T083012Z-*.mcap --to drive",
    ),
    "foxglove": _entry(
        "show the running robot live to Foxglove or Lichtblick, until Ctrl-C",
        "Serve scan, pose, route, map, camera, objects, rows and speeds on this machine's "
        "loopback. `layout` prints a window that Foxglove imports; docs/foxglove.md.",
        "pons foxglove",
        "pons foxglove layout > pons-layout.json",
    ),
    "mqtt": _entry(
        "join a smart home by MQTT (Home Assistant), until Ctrl-C",
        "Join the broker that [mqtt] of settings.toml names: the robot appears as a device, takes "
        "orders and stops. `pons up` runs this by itself where [mqtt] is set; docs/smart-home.md.",
        "pons mqtt",
    ),
    "tls": _entry(
        "make or renew the certificate; say what devices must trust",
        "Make or renew this robot's certificate and say which one telephones and shells must "
        "trust.",
        "pons tls",
        "pons up --tls",
    ),
    "say": _entry(
        "give a goal, in English or Chinese, and follow it",
        "Give the robot a goal as a sentence, and show each step until it ends or asks. "
        "Ctrl-C leaves the goal running. See also: pons answer, pons cancel, pons goals.",
        'pons say "go to the kitchen"',
        "pons say 去厨房",
        "pons say --json --no-wait go home",
    ),
    "go": _entry(
        "send the robot to a place by its name, or to a point of the map",
        "Send the robot to a place, or to X and Y [m] of its map and a heading [degrees, counter-"
        "clockwise], and follow it. A point that can't be stood on is refused with its reason.",
        "pons go kitchen",
        "pons go 1.5 4.2",
        "pons go 1.5 4.2 90 --no-wait",
    ),
    "rehearse": _entry(
        "show what a sentence would do, before anything moves",
        "Show each step's way with metres, seconds and its narrowest place; nothing moves and no"
        " goal is made. With --drive the whole plan is driven in the simulator, from where the "
        "robot stands and among what it saw last. Exit status 1: some step of it does not go.",
        'pons rehearse "go to the kitchen, then go home"',
        'pons rehearse --drive "patrol the kitchen and the study"',
        "pons rehearse --goal 39743323ac9e --json",
    ),
    "answer": _entry(
        "answer a goal's question: the one that asks, or named",
        "Answer the question of the goal that asks; name the goal first where several do.",
        "pons answer yes",
        'pons answer 39743323ac9e "the red one"',
    ),
    "confirm": _entry(
        "say yes to the plan that waits for it, or named",
        "Agree to the plan that waits for a yes; name the goal where several wait.",
        "pons confirm",
        "pons confirm 39743323ac9e",
    ),
    "goals": _entry(
        "list what the robot was told: by day, found by words, as JSON",
        "List goals, the newest first, with time, length and result; a goal's id shows all of"
        " it: plan, questions and answers, cost of the model. Ended goals stay listed.",
        "pons goals",
        "pons goals --day 2026-11-29",
        "pons goals --state failed --search kitchen",
        "pons goals 39743323ac9e",
        "pons goals 39743323ac9e --html mission.html",
    ),
    "log": _entry(
        "show what has happened; -f: as it happens",
        "Show the last goals and events of this robot; with -f go on and show each as it comes.",
        "pons log",
        "pons log -f",
        "pons log -f --json",
    ),
    "stop": _entry(
        "stop now and hold, with or without a planner",
        "Stop the robot at its full braking and hold it there, asked by every way there is. "
        "Where no robot is named, every robot of this machine is told. See also: pons resume,"
        " pons estop.",
        "pons stop",
        "pons stop --json",
    ),
    "status": _entry(
        "show the robot and its goals",
        "Show the bridge's mode, the pose, the limits in force and the open goals.",
        "pons status",
        "pons status --json",
    ),
    "cancel": _entry(
        "cancel a goal: the running one unless named",
        "End a goal for good. Without an id it is the running one, else the newest that is open.",
        "pons cancel",
        "pons cancel 39743323ac9e",
    ),
    "pause": _entry(
        "pause a goal: the running one unless named",
        "Pause a goal; the robot stands until `pons resume`.",
        "pons pause",
        "pons pause 39743323ac9e",
    ),
    "resume": _entry(
        "resume the paused goal, or clear what is held",
        "Continue the paused goal. Where none is paused, clear what holds the robot.",
        "pons resume",
        "pons resume 39743323ac9e",
    ),
    "arm": _entry(
        "power the drive, standing",
        "Power the drive; the robot stands. On metal it needs the operator's key of this folder.",
        "pons arm",
    ),
    "disarm": _entry(
        "ramp to zero, then torque off",
        "Brake to a stand, then take the power off the wheels.",
        "pons disarm",
        "pons disarm --json",
    ),
    "estop": _entry(
        "protective stop, latched until reset",
        "Make a protective stop that stays until `pons reset`, then `pons arm` and `pons resume`.",
        "pons estop",
        "pons estop --json",
    ),
    "reset": _entry(
        "leave a latched state; never moves the robot",
        "Leave a protective stop or a fault whose cause is gone. The robot does not move by it.",
        "pons reset",
    ),
    "doctor": _entry(
        "say what this machine lacks and how to mend it",
        "Check the machine, its folders, the robot's devices and the model; each finding says"
        " its cure. Exit status 0 all is well, 1 something works less well, 2 must be mended "
        "first.",
        "pons doctor",
        "pons doctor --robot waveshare_ugv_rover",
        "pons doctor --model qwen3:8b",
    ),
    "calibrate": _entry(
        "drive on a clear floor, measure, write robot.toml",
        "Measure wheels, track and brakes by driving to and fro, and write them into "
        "robot.toml after a yes. Needs a running, armed robot and two metres of clear floor.",
        "pons calibrate",
        "pons calibrate --track",
        "pons calibrate --measured-m",
    ),
    "why": _entry(
        "explain the last stop: row, evidence, what to do",
        "Explain the newest stop of the recordings: who or which row, the evidence, how far "
        "it rolled and what to do now. Needs no running robot.",
        "pons why",
        "pons why --json",
    ),
    "replies": _entry(
        "show what the model wrote about a goal, if kept",
        "Show the model's own words about a goal; settings.toml says of how many they are kept.",
        "pons replies",
        "pons replies 39743323ac9e",
    ),
    "key": _entry(
        "make the key by which the bridge knows its operator",
        "Make the operator's key in the state folder. One that is there is never replaced.",
        "pons key new",
    ),
    "braking": _entry(
        "show what stops have taught of the brakes",
        "Show the braking that was learnt from stops; forget it after a repair, the bridge down.",
        "pons braking",
        "pons braking forget",
    ),
    "fence": _entry(
        "show, propose, accept or reject a fence",
        "Look after where the robot may be. A proposal changes nothing before it is accepted,"
        " with the robot disarmed.",
        "pons fence show",
        "pons fence propose fence.json",
        "pons fence accept 1f2e3d4c5b6a",
    ),
    "people": _entry(
        "list who may use the robot, add or remove somebody",
        "Give a person or a telephone a link of its own, shown once with a QR code, and take it "
        "back. What they do is written down as theirs.",
        "pons people",
        'pons people add "Ana\'s phone"',
        "pons people add guest --role viewer",
        "pons people add Claude --role agent",
        "pons people remove guest",
    ),
    "places": _entry(
        "list the places, remember one here, forget one",
        "List the places that the robot knows, or teach it where it stands by a name.",
        "pons places",
        'pons places remember "the window" --zh 窗边',
        "pons places forget window",
    ),
    "orders": _entry(
        "list standing orders, add, show, pause, remove one",
        "Look after what the robot does by itself at a time or on an event.",
        "pons orders",
        'pons orders add "every morning at 8 go to the kitchen"',
        "pons orders skip o1 2026-12-24",
    ),
    "fault": _entry(
        "break the simulated robot; without a name, mend it",
        "Let a fault stand in the simulator, to see how the robot takes it. A wrong name "
        "lists all.",
        "pons fault lidar_off --for 5",
        "pons fault",
    ),
    "replay": _entry(
        "run a recording again and compare every command",
        "Run recordings again through the bridge's core and compare each command bit for bit,"
        " or think recorded sentences again with another model.",
        "pons replay .pons/recordings/*.mcap",
        "pons replay .pons --with-model qwen3:8b",
    ),
    "detect": _entry(
        "try a detector on pictures: what it is, what it sees",
        "Run the owner's detector, or another file, on pictures and say what it sees.",
        "pons detect kitchen.jpg",
        "pons detect --model yolo.onnx --labels names.txt a.png",
    ),
    "eval": _entry(
        "score what a brain plans, on sentences",
    ),
    "fleet": _entry(
        "give orders to several robots as to one",
    ),
    "mcp": _entry(
        "serve this robot to an assistant that speaks MCP",
    ),
    "mock-llm": _entry(
        "serve a model that is none, with faults",
    ),
    "site": _entry(
        "make a site of a map, name its rooms, check it",
    ),
    "map": _entry(
        "make a site of a drive, or mend the map of one",
    ),
    "robot": _entry(
        "choose a preset, find what is plugged in, try a robot, its wheels off the ground",
    ),
    "skill": _entry(
        "make a skill of your own in a file, check and try it",
    ),
    "nav2": _entry(
        "let Nav2 drive through the bridge, in the planner's place",
    ),
    "completion": _entry(
        "print the completion of words for bash, zsh or fish",
        "Print a script that completes the commands and options of pons; the shell reads it "
        "at its start. Completing runs nothing of Pons.",
        "pons completion bash > ~/.local/share/bash-completion/completions/pons",
        "pons completion zsh > ~/.zfunc/_pons",
        "pons completion fish > ~/.config/fish/completions/pons.fish",
    ),
    "help": _entry(
        "show the help of a command, or `exit-codes`: what an exit status means",
        "Show the help of a command, or the table of exit statuses.",
        "pons help say",
        "pons help exit-codes",
    ),
}
"""By command: line in the list, sentences, examples. Without sentences it reads its own words."""


def exit_table() -> str:
    """Return the table of exit statuses, a line each."""
    rows = "\n".join(f"  {status:<4} {meaning}" for status, meaning in EXIT_STATUS)
    return f"exit status:\n{rows}"
