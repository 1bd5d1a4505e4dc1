#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws kicks from the bus they were played on, as SVG and PNG.

Usage: striker-plot-kick BUS.log [--json KICK.json] [--episode N] -o DIR

Reads a candump log as 'striker-sil kick --log' writes it, by the messages of striker.dbc, and writes into DIR:
  paths  where robot and ball went, an episode a panel: the first twelve, or with the rewards of --json the six best and
         the six worst; named by the numbers of --json, else by their place in the log, from 0
  kick   one episode (--episode, else the best or the first): the field from above, set-points beside measured rim
         speeds, torques, and at each decision the Q values of its action and of the next best one
Places are the camera's pictures. The same log gives the same bytes.
"""

import math

import matplotlib.pyplot as plt
from striker_field import ball_patch, robot_patch
from striker_logs import doubts_of, kicks_of, rows_of
from striker_pictures import BLUE, GREEN, GREY, ORANGE, VERMILION, PlotError, parser_of, run, save

PROGRAM = "striker-plot-kick"
MOST_PANELS = 12


def draw_paths(axes, kick):
    axes.plot([x for _, x, _, _ in kick.robot], [y for _, _, y, _ in kick.robot], color=BLUE, label="robot")
    axes.plot([x for _, x, _ in kick.ball], [y for _, _, y in kick.ball], color=ORANGE, label="ball")
    _, x_m, y_m, heading_rad = kick.robot[0]
    axes.add_patch(robot_patch(x_m, y_m, heading_rad, fill=False, edgecolor=BLUE))
    axes.add_patch(ball_patch(*kick.ball[0][1:], fill=False, edgecolor=ORANGE))
    axes.set_aspect("equal", adjustable="datalim")


def panels_of(count, rows):
    if rows is None:
        return list(range(min(count, MOST_PANELS)))
    by_reward = sorted(range(count), key=lambda place: -rows[place]["reward"])
    if count <= MOST_PANELS:
        return by_reward
    return by_reward[:MOST_PANELS // 2] + by_reward[-(MOST_PANELS // 2):]


def title_of(place, kicks, rows, between):
    row = None if rows is None else rows[place]
    known = f"kick {place} of the log" if row is None else f"episode {row['episode']}{between} reward {row['reward']:.2f}"
    return known + doubts_of(row, kicks[place])


def paths(kicks, rows, directory, command):
    chosen = panels_of(len(kicks), rows)
    columns = min(4, len(chosen))
    lines = math.ceil(len(chosen) / columns)
    figure, panels = plt.subplots(lines, columns, figsize=(3.2 * columns, 2.9 * lines + 0.3), squeeze=False,
                                  layout="constrained")
    for axes, place in zip(panels.flat, chosen):
        draw_paths(axes, kicks[place])
        axes.set_title(title_of(place, kicks, rows, ":").replace(", ", ",\n"))
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
    if not kick.commands and not kick.wheels:
        speed.set_title("drives of another make: their frames are not drawn")
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


def place_of(options, count, rows):
    """The kick to draw in detail."""
    numbers = list(range(count)) if rows is None else [row["episode"] for row in rows]
    if options.episode is None:
        return 0 if rows is None else max(range(count), key=lambda place: rows[place]["reward"])
    if options.episode not in numbers:
        raise PlotError(f"--episode {options.episode}: the log has the episodes {numbers[0]} to {numbers[-1]}")
    return numbers.index(options.episode)


def draw(options, directory, command):
    kicks = kicks_of(options.log)
    rows = None if options.json is None else rows_of(options.json, len(kicks))
    place = place_of(options, len(kicks), rows)
    paths(kicks, rows, directory, command)
    one_kick(kicks[place], title_of(place, kicks, rows, ","), directory, command)


def main():
    parser = parser_of(PROGRAM, __doc__)
    parser.add_argument("log", metavar="BUS.log", help="a candump log of kicks")
    parser.add_argument("--json", metavar="KICK.json", help="what striker-sil kick --json wrote of the same run")
    parser.add_argument("--episode", type=int, metavar="N", help="the one to draw in detail: its number in --json, else its place in the log")
    run(PROGRAM, draw, parser.parse_args())


if __name__ == "__main__":
    main()
