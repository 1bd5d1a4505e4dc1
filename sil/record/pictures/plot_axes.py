#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the axes and signs that bus, worlds and networks share, as SVG and PNG.

Usage: striker-plot-axes -o DIR

Writes axes.svg and axes.png into DIR: the field's frame with a robot's heading and theta of the contact, and the robot's
frame with its wheels and what the network reads of the ball. The words for it are in firmware/can/README.md ("Axes and
signs"), sil/task/kick_task.hpp (theta) and training/task/state.cpp (the relative state). The same bytes each time.
"""

import math

import matplotlib.pyplot as plt
from matplotlib.patches import Arc, Rectangle
from striker_field import BALL_RADIUS_M, ROBOT_SIDE_M, ball_patch, draw_field, robot_patch
from striker_pictures import BLUE, GREEN, GREY, ORANGE, PURPLE, VERMILION, parser_of, run, save

PROGRAM = "striker-plot-axes"
LARGER = 4  # on the field's panel


def arrow(axes, begin, end, colour, width=1.6):
    axes.annotate("", xy=end, xytext=begin, arrowprops={"arrowstyle": "-|>", "color": colour, "lw": width, "shrinkA": 0,
                                                        "shrinkB": 0})


def polar(origin, length, angle_deg):
    return (origin[0] + length * math.cos(math.radians(angle_deg)), origin[1] + length * math.sin(math.radians(angle_deg)))


def angle(axes, middle, radius, begin_deg, end_deg, colour, text, text_radius):
    """An arc, with an arrow where it ends if it is turned anticlockwise."""
    axes.add_patch(Arc(middle, 2 * radius, 2 * radius, theta1=begin_deg, theta2=end_deg, color=colour, linewidth=1.4))
    arrow(axes, polar(middle, radius, end_deg - 3), polar(middle, radius, end_deg), colour, 1.0)
    axes.text(*polar(middle, text_radius, (begin_deg + end_deg) / 2), text, color=colour, ha="left", va="center", fontsize=9)


def field(axes):
    draw_field(axes)
    axes.grid(False)
    arrow(axes, (0, 0), (1.3, 0), "black")
    arrow(axes, (0, 0), (0, 1.3), "black")
    axes.text(1.35, -0.25, "x: to the\nopponent's goal", fontsize=9, va="center")
    axes.text(0.08, 1.3, "y: to the left", fontsize=9)
    axes.text(-0.06, -0.06, "(0, 0)", fontsize=8, ha="right", va="top")
    robot, heading_deg = (-3.0, -1.6), 35
    axes.add_patch(robot_patch(*robot, math.radians(heading_deg), LARGER * ROBOT_SIDE_M, facecolor=BLUE, alpha=0.35))
    axes.plot([robot[0], robot[0] + 1.5], [robot[1]] * 2, color=GREY, linestyle=":")
    arrow(axes, robot, polar(robot, 1.2, heading_deg), BLUE)
    angle(axes, robot, 0.9, 0, heading_deg, BLUE, "heading > 0:\nanticlockwise from +x", 1.0)
    contact = (0.7, -1.6)
    axes.add_patch(robot_patch(*contact, 0.0, LARGER * ROBOT_SIDE_M, facecolor=BLUE, alpha=0.35))
    ball = polar(contact, LARGER * (ROBOT_SIDE_M / 2 + BALL_RADIUS_M) * 1.11, 25)
    axes.add_patch(ball_patch(*ball, LARGER * BALL_RADIUS_M, facecolor=ORANGE))
    axes.plot([contact[0], ball[0]], [contact[1], ball[1]], color=VERMILION, linewidth=1.4)
    arrow(axes, contact, (2.6, contact[1]), GREEN)
    axes.text(2.62, contact[1] - 0.05, "target: the heading\nat the start", color=GREEN, fontsize=8, va="center")
    axes.add_patch(Arc(contact, 1.5, 1.5, theta1=0, theta2=25, color=VERMILION, linewidth=1.4))
    axes.plot(*zip(ball, polar(contact, 1.0, 25)), color=VERMILION, linewidth=1.0)
    axes.text(*polar(contact, 1.05, 30), "theta > 0 at the contact", color=VERMILION, fontsize=9, va="bottom")
    axes.set_title("The field's frame, in m (robot and ball four times as large)")


def wheels(axes):
    half = ROBOT_SIDE_M / 2
    for side, name in ((1, "left"), (-1, "right")):
        axes.add_patch(Rectangle((-0.035, side * half - 0.0125), 0.07, 0.025, facecolor="0.25"))
        arrow(axes, (0, side * (half + 0.028)), (0.06, side * (half + 0.028)), PURPLE)
        axes.text(-0.01, side * (half + 0.028), f"{name} wheel: rim speed, set-point\nand torque > 0 roll it forward", color="0.2",
                  fontsize=8, ha="right", va="center")


def robot(axes):
    axes.add_patch(robot_patch(0, 0, 0, facecolor=BLUE, alpha=0.35))
    wheels(axes)
    arrow(axes, (0, 0), (0.2, 0), BLUE)
    arrow(axes, (0, 0), (0, 0.19), BLUE)
    axes.text(0.2, -0.012, "x: along the heading,\nwhere speed > 0", color=BLUE, fontsize=8, va="top")
    axes.text(0.006, 0.19, "y: to the left", color=BLUE, fontsize=8)
    ball = (0.27, 0.13)
    axes.add_patch(ball_patch(*ball, facecolor=ORANGE, alpha=0.8))
    axes.plot([ball[0], ball[0], 0], [0, ball[1], ball[1]], color=GREY, linestyle=":")
    axes.text(ball[0] + 0.006, 0.045, "ball_y > 0", fontsize=8)
    axes.text(0.11, ball[1] + 0.006, "ball_x > 0", fontsize=8)
    arrow(axes, ball, polar(ball, 0.12, 130), VERMILION)
    axes.plot([ball[0], ball[0] + 0.1], [ball[1]] * 2, color=VERMILION, linestyle=":")
    angle(axes, ball, 0.075, 0, 130, VERMILION, "ball_angle > 0", 0.085)
    axes.text(*polar(ball, 0.125, 130), "ball_vx < 0, ball_vy > 0", color=VERMILION, fontsize=8, ha="right", va="bottom")
    axes.set_xlim(-0.25, 0.46)
    axes.set_ylim(-0.17, 0.31)
    axes.set_aspect("equal")
    axes.set_xlabel("x in the robot's frame, m")
    axes.set_ylabel("y in the robot's frame, m")
    axes.grid(False)
    axes.set_title("The robot's frame: wheels, and what the network reads")


def draw(_, directory, command):
    figure, panels = plt.subplots(1, 2, figsize=(14, 4.7), layout="constrained", width_ratios=(1.2, 1))
    field(panels[0])
    robot(panels[1])
    save(figure, directory, "axes", command)


def main():
    run(PROGRAM, draw, parser_of(PROGRAM, __doc__).parse_args())


if __name__ == "__main__":
    main()
