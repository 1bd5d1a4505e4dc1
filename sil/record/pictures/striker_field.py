# SPDX-License-Identifier: Apache-2.0
"""The field, a robot and a ball from above, as all of Striker's plotters draw them. Lengths in m, headings in rad."""

import math

from matplotlib.patches import Circle, Polygon, Rectangle

HALF_LENGTH_M, HALF_WIDTH_M = 3.9, 2.325
ROBOT_SIDE_M, BALL_RADIUS_M = 0.15, 0.05


def draw_field(axes):
    style = {"fill": False, "edgecolor": "0.3", "linewidth": 0.8}
    axes.add_patch(Rectangle((-HALF_LENGTH_M, -HALF_WIDTH_M), 2 * HALF_LENGTH_M, 2 * HALF_WIDTH_M, **style))
    axes.add_patch(Circle((0, 0), 0.5, **style))
    axes.plot([0, 0], [-HALF_WIDTH_M, HALF_WIDTH_M], color="0.3", linewidth=0.8)
    for side in (-1, 1):
        for depth, half_width in ((-0.9, 0.9), (-0.4, 0.65), (0.45, 0.5)):
            corner = min(side * HALF_LENGTH_M, side * (HALF_LENGTH_M + depth))
            axes.add_patch(Rectangle((corner, -half_width), abs(depth), 2 * half_width, **style))
    axes.set_xlim(-4.5, 4.5)
    axes.set_ylim(-2.5, 2.5)
    axes.set_aspect("equal")
    axes.set_xlabel("x, m")
    axes.set_ylabel("y, m")


def robot_corners(x_m, y_m, heading_rad, side_m=ROBOT_SIDE_M):
    return [(x_m + side_m / math.sqrt(2) * math.cos(heading_rad + angle),
             y_m + side_m / math.sqrt(2) * math.sin(heading_rad + angle))
            for angle in (math.pi / 4 + turn * math.pi / 2 for turn in range(4))]


def robot_patch(x_m, y_m, heading_rad, side_m=ROBOT_SIDE_M, **style):
    return Polygon(robot_corners(x_m, y_m, heading_rad, side_m), **style)


def ball_patch(x_m, y_m, radius_m=BALL_RADIUS_M, **style):
    return Circle((x_m, y_m), radius_m, **style)
