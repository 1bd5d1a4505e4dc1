#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws kicks from the bus they were played on, as SVG and PNG.

Usage: striker-plot-kick BUS.log [--json KICK.json] [--episode N] -o DIR

Reads a candump log as 'striker-sil kick --log' writes it, by the messages of striker.dbc, and writes into DIR:
  paths  where robot and ball went, an episode a panel: the first twelve, or with the rewards of --json the six best and
         the six worst
  kick   one episode (--episode, else the best or the first): the field from above, set-points beside measured rim
         speeds, torques, and at each decision the Q values of its action and of the next best one
Places are the camera's pictures. The same log gives the same bytes.
"""

import json
import logging
import math
import os
import re

logging.getLogger("canmatrix").setLevel(logging.ERROR)  # it warns of formats that nobody asked for
import canmatrix.formats  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
from striker_pictures import BLUE, GREEN, GREY, HERE, ORANGE, VERMILION, PlotError, parser_of, run, save  # noqa: E402

PROGRAM = "striker-plot-kick"
LINE = re.compile(r"\((\d+\.\d+)\) \S+ ([0-9A-F]{3})#([0-9A-F]*)$")
ACTIVE, DISARM = 3, 0  # of Status.state, of ModeCommand.mode
MOST_PANELS = 12
ROBOT_SIDE_M, BALL_RADIUS_M = 0.15, 0.05


class Kick:
    """An episode: from one arming to the next disarming. Times in s since arming; SI units."""

    def __init__(self, begin_s):
        self.begin_s = begin_s
        self.robot, self.ball, self.commands, self.wheels, self.decisions = [], [], [], [], []

    def take(self, name, time_s, value):
        time_s -= self.begin_s
        if name == "VisionPose":
            self.robot.append((time_s, value["x"] / 1e3, value["y"] / 1e3, math.radians(value["heading"])))
        elif name == "VisionBall":
            self.ball.append((time_s, value["x"] / 1e3, value["y"] / 1e3))
        elif name == "WheelCommand":
            self.commands.append((time_s, *(value[f"{side}_{what}"] for what in ("set_point", "torque")
                                            for side in ("left", "right"))))
        elif name == "WheelState":
            self.wheels.append((time_s, value["left_speed"] / 1e3, value["right_speed"] / 1e3))
        elif name == "Decision":
            self.decisions.append((time_s, value["action"], value["best_q"], value["next_q"]))


def messages():
    matrix, = canmatrix.formats.loadp(os.path.join(HERE, "striker.dbc")).values()
    wanted = ("Status", "ModeCommand", "VisionPose", "VisionBall", "WheelCommand", "WheelState", "Decision")
    return {frame.arbitration_id.id: frame for frame in matrix.frames if frame.name in wanted}


def kicks_of(log):
    known = messages()
    kicks, kick, last = [], None, {}
    for number, line in enumerate(log, 1):
        parts = LINE.match(line)
        if parts is None:
            raise PlotError(f"{log.name}: line {number} is no frame of a candump log")
        frame = known.get(int(parts[2], 16))
        if frame is None:
            continue
        values = {name: float(signal.phys_value) for name, signal in frame.decode(bytes.fromhex(parts[3])).items()}
        time_s = float(parts[1])
        if frame.name == "Status":
            if values["state"] == ACTIVE and kick is None:
                kick = Kick(time_s)
                for name, seen in last.items():  # what the first decision saw
                    kick.take(name, time_s, seen)
                kicks.append(kick)
            elif values["state"] != ACTIVE:
                kick = None
        elif frame.name == "ModeCommand":
            kick = None if values["mode"] == DISARM else kick  # pictures of the next episode may come in this tick
        elif kick is not None:
            kick.take(frame.name, time_s, values)
        elif frame.name.startswith("Vision"):
            last[frame.name] = values
    return [kick for kick in kicks if kick.robot and kick.ball]


def read_kicks(file):
    try:
        with open(file, encoding="ascii") as log:
            kicks = kicks_of(log)
    except OSError as error:
        raise PlotError(f"{file}: {error.strerror}; give a log of 'striker-sil kick --log'") from error
    except UnicodeDecodeError as error:
        raise PlotError(f"{file}: is no candump log") from error
    if not kicks:
        raise PlotError(f"{file}: has no kick: no controller was armed and saw robot and ball")
    return kicks


def read_rewards(file, count):
    if file is None:
        return None
    try:
        with open(file, encoding="utf-8") as stream:
            rewards = [row["reward"] for row in json.load(stream)["rows"]]
    except OSError as error:
        raise PlotError(f"{file}: {error.strerror}; give what 'striker-sil kick --json' wrote") from error
    except (ValueError, KeyError, TypeError) as error:
        raise PlotError(f"{file}: is no summary of kicks ({error})") from error
    if len(rewards) != count:
        raise PlotError(f"{file}: has {len(rewards)} episodes, the log has {count}; give those of one run")
    return rewards


def draw_paths(axes, kick):
    axes.plot([x for _, x, _, _ in kick.robot], [y for _, _, y, _ in kick.robot], color=BLUE, label="robot")
    axes.plot([x for _, x, _ in kick.ball], [y for _, _, y in kick.ball], color=ORANGE, label="ball")
    _, x_m, y_m, heading_rad = kick.robot[0]
    corners = [(x_m + ROBOT_SIDE_M / math.sqrt(2) * math.cos(heading_rad + angle),
                y_m + ROBOT_SIDE_M / math.sqrt(2) * math.sin(heading_rad + angle))
               for angle in (math.pi / 4 + turn * math.pi / 2 for turn in range(4))]
    axes.add_patch(plt.Polygon(corners, fill=False, edgecolor=BLUE))
    axes.add_patch(plt.Circle(kick.ball[0][1:], BALL_RADIUS_M, fill=False, edgecolor=ORANGE))
    axes.set_aspect("equal", adjustable="datalim")


def panels_of(count, rewards):
    if rewards is None:
        return list(range(min(count, MOST_PANELS)))
    by_reward = sorted(range(count), key=lambda episode: -rewards[episode])
    if count <= MOST_PANELS:
        return by_reward
    return by_reward[:MOST_PANELS // 2] + by_reward[-(MOST_PANELS // 2):]


def paths(kicks, rewards, directory, command):
    chosen = panels_of(len(kicks), rewards)
    columns = min(4, len(chosen))
    rows = math.ceil(len(chosen) / columns)
    figure, panels = plt.subplots(rows, columns, figsize=(3.2 * columns, 2.9 * rows + 0.3), squeeze=False,
                                  layout="constrained")
    for axes, episode in zip(panels.flat, chosen):
        draw_paths(axes, kicks[episode])
        axes.set_title(f"episode {episode}" + (f": reward {rewards[episode]:.2f}" if rewards else ""))
        axes.set_xlabel("x, m")
        axes.set_ylabel("y, m")
    for axes in list(panels.flat)[len(chosen):]:
        axes.set_visible(False)
    panels[0][0].legend()
    save(figure, directory, "paths", command)


def plot_wheels(axes, rows, column, colour, style, label):
    axes.plot([row[0] for row in rows], [row[column] for row in rows], color=colour, linestyle=style, label=label,
              linewidth=1.0)


def one_kick(kick, title, directory, command):
    figure = plt.figure(figsize=(11, 7.5), layout="constrained")
    field, speed, torque, values = (figure.add_subplot(2, 2, place) for place in range(1, 5))
    draw_paths(field, kick)
    field.set_xlabel("x, m")
    field.set_ylabel("y, m")
    field.legend()
    set_points = [(time_s, left / 1e3, right / 1e3) for time_s, left, right, _, _ in kick.commands]
    torques = [(time_s, left, right) for time_s, _, _, left, right in kick.commands]
    for side, colour in ((1, BLUE), (2, VERMILION)):
        name = ("left", "right")[side - 1]
        plot_wheels(speed, set_points, side, colour, ":", f"{name}, set-point")
        plot_wheels(speed, kick.wheels, side, colour, "-", f"{name}, measured")
        plot_wheels(torque, torques, side, colour, "-", name)
    speed.set_ylabel("rim speed, m/s")
    torque.set_ylabel("torque, mNm")
    times_s = [row[0] for row in kick.decisions]
    values.plot(times_s, [row[2] for row in kick.decisions], "o-", color=GREEN, markersize=3, label="Q of the action")
    values.plot(times_s, [row[3] for row in kick.decisions], ".:", color=GREY, label="Q of the next best")
    values.set_ylabel("Q, in units of reward")
    for axes in (speed, torque, values):
        axes.set_xlabel("time since arming, s")
        axes.legend()
    figure.suptitle(title)
    save(figure, directory, "kick", command)


def draw(options, directory, command):
    kicks = read_kicks(options.log)
    rewards = read_rewards(options.json, len(kicks))
    episode = options.episode
    if episode is None:
        episode = 0 if rewards is None else max(range(len(kicks)), key=lambda place: rewards[place])
    if not 0 <= episode < len(kicks):
        raise PlotError(f"--episode {episode}: the log has the episodes 0 to {len(kicks) - 1}")
    title = f"episode {episode}" + (f", reward {rewards[episode]:.2f}" if rewards else "")
    paths(kicks, rewards, directory, command)
    one_kick(kicks[episode], title, directory, command)


def main():
    parser = parser_of(PROGRAM, __doc__)
    parser.add_argument("log", metavar="BUS.log", help="a candump log of kicks")
    parser.add_argument("--json", metavar="KICK.json", help="what striker-sil kick --json wrote of the same run")
    parser.add_argument("--episode", type=int, metavar="N", help="the one to draw in detail")
    run(PROGRAM, draw, parser.parse_args())


if __name__ == "__main__":
    main()
