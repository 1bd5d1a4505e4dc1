# SPDX-License-Identifier: Apache-2.0
"""Kicks and pictures out of Striker's bus logs (candump -L, gzipped or not), decoded by striker.dbc beside this file."""

import gzip
import json
import logging
import math
import os
import re

logging.getLogger("canmatrix").setLevel(logging.ERROR)  # it warns of formats that nobody asked for
import canmatrix.formats  # noqa: E402

HERE = os.path.dirname(os.path.realpath(__file__))
LINE = re.compile(r"\((\d+\.\d+)\) \S+ ([0-9A-F]{3})#([0-9A-F]*)$")
ACTIVE, DISARM = 3, 0  # of Status.state, of ModeCommand.mode
EACH_TICK = ("WheelCommand", "WheelState")


class LogError(Exception):
    """What cannot be read, in one line."""


class Kick:
    """An episode: from one arming to the next disarming. Times in s since arming; SI units."""

    def __init__(self, begin_s):
        self.begin_s = begin_s
        self.robot, self.ball, self.commands, self.wheels, self.decisions = [], [], [], [], []
        self.lines = []  # of the log, where each of `robot` stands

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
    matrix, = canmatrix.formats.loadp(os.path.join(HERE, "striker.dbc")).values()
    return {frame.arbitration_id.id: frame for frame in matrix.frames if frame.name in wanted}


def decoded(frame, data):
    return {name: float(signal.phys_value) for name, signal in frame.decode(bytes.fromhex(data)).items()}


def kicks_in(log, at_pictures):
    known = messages("Status", "ModeCommand", "VisionPose", "VisionBall", "WheelCommand", "WheelState", "Decision")
    kicks, kick, last, waiting = [], None, {}, {}
    for number, line in enumerate(log, 1):
        parts = LINE.match(line)
        if parts is None:
            raise LogError(f"{log.name}: line {number} is no frame of a candump log")
        frame = known.get(int(parts[2], 16))
        if frame is None:
            continue
        if at_pictures and frame.name in EACH_TICK:
            waiting[frame] = (float(parts[1]), parts[3])
            continue
        values, time_s = decoded(frame, parts[3]), float(parts[1])
        if frame.name == "Status":
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
    return [kick for kick in kicks if kick.robot and kick.ball]


def kicks_of(file, at_pictures=False):
    """`at_pictures`: of what comes each tick only the last before each picture, which takes a tenth of the time."""
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
    try:
        with open(file, encoding="utf-8") as stream:
            summary = json.load(stream)
        _ = [row["reward"] for row in summary["rows"]]
        return summary
    except OSError as error:
        raise LogError(f"{file}: {error.strerror}; give what 'striker-sil kick --json' wrote") from error
    except (ValueError, KeyError, TypeError) as error:
        raise LogError(f"{file}: is no summary of kicks ({error})") from error


def rows_of(file, count):
    """What is known of each of so many episodes."""
    rows = summary_of(file)["rows"]
    if len(rows) != count:
        raise LogError(f"{file}: has {len(rows)} episodes, the log has {count}; give those of one run")
    return rows


def rewards_of(file, count):
    return [row["reward"] for row in rows_of(file, count)]


def places_of(file):
    """What a robot's camera told its bus: {time_ms: (x_mm, y_mm, heading_deg)} of the robot, {time_ms: (x_mm, y_mm)} of the
    ball."""
    known = messages("VisionPose", "VisionBall")
    pattern = re.compile(rb"\((\d+)\.(\d{3})\d*\) \S+ (" + "|".join(f"{number:03X}" for number in known).encode()
                         + rb")#([0-9A-F]+)")
    try:
        with gzip.open(file) as stream:
            text = stream.read()
    except (OSError, EOFError) as error:
        raise LogError(f"{file}: cannot be read ({error}); give the directory of a match") from error
    robot, ball = {}, {}
    for seconds, milliseconds, number, data in pattern.findall(text):
        frame = known[int(number, 16)]
        values = decoded(frame, data.decode())
        place = (values["x"], values["y"])
        time_ms = int(seconds) * 1000 + int(milliseconds)
        if frame.name == "VisionPose":
            robot[time_ms] = (*place, values["heading"])
        else:
            ball[time_ms] = place
    return robot, ball
