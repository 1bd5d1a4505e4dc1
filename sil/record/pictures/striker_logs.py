# SPDX-License-Identifier: Apache-2.0
"""Kicks and pictures out of Striker's bus logs (candump -L, gzipped or not), decoded by striker.dbc beside this file:
the build's own, whose identifiers are where identifier_base of its robot moves them."""

import gzip
import logging
import math
import os
import re
import zlib

logging.getLogger("canmatrix").setLevel(logging.ERROR)  # it warns of formats that nobody asked for
import canmatrix.formats  # noqa: E402
from striker_records import FLAG, NUMBER, NUMBER_OR_NULL, WHOLE, WHOLE_OR_NULL, LogError, load  # noqa: E402

HERE = os.path.dirname(os.path.realpath(__file__))
LINE = re.compile(r"\((\d+\.\d+)\) \S+ ([0-9A-F]{3})#((?:[0-9A-F]{2}){0,8})$")
HEXADECIMAL = re.compile(rb"[0-9A-F]*")
ACTIVE, DISARM = 3, 0  # of Status.state, of ModeCommand.mode
EACH_TICK = ("WheelCommand", "WheelState")
ROW = {"episode": WHOLE, "reward": NUMBER, "contact": FLAG, "contact_decision": WHOLE_OR_NULL,
       "v_contact_m_s": NUMBER_OR_NULL, "ball_speed_m_s": NUMBER_OR_NULL, "kicked": FLAG, "driven": FLAG}  # what is read
OTHER_BUILD = ("if the identifiers are moved (identifier_base of a robot's description), take this program out of the build "
               "that recorded it")


class Kick:
    """An episode: from one arming to the next disarming. Times in s since arming; SI units."""

    def __init__(self, begin_s):
        self.begin_s = begin_s
        self.robot, self.ball, self.commands, self.wheels, self.decisions = [], [], [], [], []
        self.lines = []  # of the log, where each of `robot` stands
        self.is_cut = True  # the log ends in it

    def take(self, name, time_s, value, line):
        time_s -= self.begin_s
        if name == "VisionPose":
            self.robot.append((time_s, value["x"] / 1e3, value["y"] / 1e3, math.radians(value["heading"])))
            self.lines.append(line)
        elif name == "VisionBall":
            self.ball.append((time_s, value["x"] / 1e3, value["y"] / 1e3))
        elif name == "WheelCommand":
            self.commands.append((time_s, *(value[f"{side}_{what}"] for what in ("set_point", "torque")
                                            for side in ("left", "right"))))
        elif name == "WheelState":
            self.wheels.append((time_s, value["left_speed"] / 1e3, value["right_speed"] / 1e3))
        elif name == "Decision":
            self.decisions.append((time_s, value["action"], value["best_q"], value["next_q"]))


def messages(*wanted):
    table = os.path.join(HERE, "striker.dbc")
    if not os.path.exists(table):
        raise LogError(f"{table}: is not there; build the target striker-dbc")
    matrix, = canmatrix.formats.loadp(table).values()
    return {frame.arbitration_id.id: frame for frame in matrix.frames if frame.name in wanted}


def require_size(frame, data, place):
    if len(data) != 2 * frame.size:
        raise LogError(f"{place}: {frame.name} has {frame.size} bytes, not those of '{data}'; record the run again")


def decoded(frame, data):
    return {name: float(signal.phys_value) for name, signal in frame.decode(bytes.fromhex(data)).items()}


def kicks_in(log, at_pictures):
    known = messages("Status", "ModeCommand", "VisionPose", "VisionBall", "WheelCommand", "WheelState", "Decision")
    kicks, kick, last, waiting, has_status = [], None, {}, {}, False
    for number, line in enumerate(log, 1):
        parts = LINE.match(line)
        if parts is None:
            raise LogError(f"{log.name}: line {number} is no frame of a candump log")
        if not line.endswith("\n"):
            raise LogError(f"{log.name}: line {number}, the last, is cut; without it the log can be read")
        frame = known.get(int(parts[2], 16))
        if frame is None:
            continue
        require_size(frame, parts[3], f"{log.name}: line {number}")
        if at_pictures and frame.name in EACH_TICK:
            waiting[frame] = (float(parts[1]), parts[3])
            continue
        values, time_s, before = decoded(frame, parts[3]), float(parts[1]), kick
        if frame.name == "Status":
            has_status = True
            if values["state"] == ACTIVE and kick is None:
                kick = Kick(time_s)
                waiting.clear()
                for name, (seen, line_seen) in last.items():  # what the first decision saw
                    kick.take(name, time_s, seen, line_seen)
                kicks.append(kick)
            elif values["state"] != ACTIVE:
                kick = None
        elif frame.name == "ModeCommand":
            kick = None if values["mode"] == DISARM else kick  # pictures of the next episode may come in this tick
        elif kick is not None:
            kick.take(frame.name, time_s, values, number)
            if frame.name == "VisionPose":
                for of_a_tick, (then_s, data) in waiting.items():
                    kick.take(of_a_tick.name, then_s, decoded(of_a_tick, data), number)
                waiting.clear()
        elif frame.name.startswith("Vision"):
            last[frame.name] = (values, number)
        if before is not None and kick is None:
            before.is_cut = False
    if not has_status:
        raise LogError(f"{log.name}: has no Status, which a controller always sends; {OTHER_BUILD}")
    return [kick for kick in kicks if kick.robot and kick.ball]


def kicks_of(file, at_pictures=False):
    """`at_pictures`: of what comes each tick only the last before each picture, which takes about a third of the time."""
    try:
        with open(file, encoding="ascii") as log:
            kicks = kicks_in(log, at_pictures)
    except OSError as error:
        raise LogError(f"{file}: {error.strerror}; give a log of 'striker-sil kick --log'") from error
    except UnicodeDecodeError as error:
        raise LogError(f"{file}: is no candump log") from error
    if not kicks:
        raise LogError(f"{file}: has no kick: no controller was armed and saw robot and ball")
    return kicks


def summary_of(file):
    return load(file, "give what 'striker-sil kick --json' wrote")


def rows_of(file, count):
    """What is known of each of so many episodes, in the order in which they were played."""
    rows = summary_of(file).parts("rows")
    if len(rows) != count:
        raise LogError(f"{file}: has {len(rows)} episodes, the log has {count}; give those of one run")
    rows = sorted(({name: row.take(name, kind) for name, kind in ROW.items()} for row in rows), key=lambda row: row["episode"])
    numbers = [row["episode"] for row in rows]
    if numbers != list(range(numbers[0], numbers[0] + count)):
        raise LogError(f"{file}: its episodes are not those of one run, each once; make the run again")
    return rows


def doubts_of(row, kick):
    """Why an episode is no result, as words to put behind its name: mostly none."""
    return ("" if row is None or row["driven"] else ", not driven all along") + (", cut: the log ends in it" if kick.is_cut else "")


def places_of(file):
    """What a robot's camera told its bus: {time_ms: (x_mm, y_mm, heading_deg)} of the robot, {time_ms: (x_mm, y_mm)} of the
    ball."""
    known = messages("VisionPose", "VisionBall")
    pattern = re.compile(rb"\((\d+)\.(\d{3})\d*\) \S+ (" + "|".join(f"{number:03X}" for number in known).encode()
                         + rb")#(.*)")
    try:
        with gzip.open(file) as stream:
            text = stream.read()
    except (OSError, EOFError, zlib.error) as error:
        raise LogError(f"{file}: cannot be read ({error}); give the directory of a match") from error
    robot, ball = {}, {}
    for seconds, milliseconds, number, data in pattern.findall(text):
        frame, stamp = known[int(number, 16)], f"{int(seconds)}.{milliseconds.decode()} s"
        if not HEXADECIMAL.fullmatch(data):
            raise LogError(f"{file}: {stamp}: '{data.decode(errors='replace')[:20]}' is no data; record the run again")
        require_size(frame, data.decode(), f"{file}: {stamp}")
        values = decoded(frame, data.decode())
        place = (values["x"], values["y"])
        time_ms = int(seconds) * 1000 + int(milliseconds)
        if frame.name == "VisionPose":
            robot[time_ms] = (*place, values["heading"])
        else:
            ball[time_ms] = place
    return robot, ball
