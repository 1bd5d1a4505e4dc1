# SPDX-License-Identifier: Apache-2.0
"""A kick from above, drawn with matplotlib."""

import math

import numpy

HALF_SIDE_M = 0.075  # of AI Soccer's robots
BALL_RADIUS_M = 0.05
VIEW_M = 2.4  # to each side of where the robot started
INCHES, DOTS_AN_INCH = 4, 100


class KickPicture:
    def __init__(self, in_window):
        if in_window:
            from matplotlib import pyplot
            self._pyplot = pyplot
            self._figure = pyplot.figure(figsize=(INCHES, INCHES), dpi=DOTS_AN_INCH)
        else:
            from matplotlib.backends.backend_agg import FigureCanvasAgg
            from matplotlib.figure import Figure
            self._pyplot = None
            self._figure = Figure(figsize=(INCHES, INCHES), dpi=DOTS_AN_INCH)
            FigureCanvasAgg(self._figure)
        self._axes = self._figure.add_axes([0, 0, 1, 1])
        self._centre = (math.inf, math.inf)

    def draw(self, places, pause_s):
        x, y, heading, ball_x, ball_y = places
        if max(abs(x - self._centre[0]), abs(y - self._centre[1])) > VIEW_M:
            self._centre = (x, y)
        self._axes.clear()
        self._axes.set(xlim=(self._centre[0] - VIEW_M, self._centre[0] + VIEW_M),
                       ylim=(self._centre[1] - VIEW_M, self._centre[1] + VIEW_M), facecolor="#2e7d32")
        ahead = numpy.array([math.cos(heading), math.sin(heading)])
        left = numpy.array([-ahead[1], ahead[0]])
        corners = [HALF_SIDE_M * (a * ahead + b * left) + (x, y) for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
        self._axes.fill(*zip(*corners), color="#c62828")
        self._axes.plot(*zip(corners[0], corners[1]), color="white", linewidth=2)  # the front face
        self._axes.add_patch(_circle(ball_x, ball_y))
        self._figure.canvas.draw()
        if self._pyplot is not None:
            self._pyplot.pause(pause_s)
            return None
        return numpy.array(self._figure.canvas.buffer_rgba())[:, :, :3]

    def close(self):
        if self._pyplot is not None:
            self._pyplot.close(self._figure)


def _circle(x, y):
    from matplotlib.patches import Circle
    return Circle((x, y), BALL_RADIUS_M, color="#ffa000")
