#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Animates three kicks and a scene of a match, as a GIF in real time.

Usage: striker-animate KICKS MATCH -o DIR

KICKS is a directory with bus.log and kick.json, as tools/demo leaves it in out/demo; MATCH is one of 'striker-sil match'.
Writes striker.gif into DIR: the best kick, the middle one and the worst by reward, and below them the last seconds before the
match's first goal that was no own goal, or before its end. Places are what the cameras told the buses, a picture each
50 ms. The same runs give the same bytes.
"""

import io
import json
import os

import matplotlib.pyplot as plt
import numpy
from PIL import Image
from striker_field import BALL_RADIUS_M, ROBOT_SIDE_M, ball_patch, draw_field, robot_patch
from striker_files import write_whole
from striker_logs import LogError, doubts_of, kicks_of, places_of, rows_of
from striker_pictures import BLUE, ORANGE, TEAMS, PlotError, parser_of, run

PROGRAM = "striker-animate"
FRAME_MS = 50
SCENE_FRAMES, HELD_FRAMES = 110, 20  # of the last picture
TRAIL_FRAMES = 12
AFTER_CONTACT_FRAMES = 14
WIDTH_IN, HEIGHT_IN, DPI = 9.0, 7.6, 80
COLOURS = 63  # one more says "as before"
LARGER = 1.6  # robots and balls are drawn so much larger than they are, which is 11 pixels


def paths_of_kick(kick):
    """(x, y, heading) of the robot and (x, y) of the ball, a picture each; the last known where one was lost."""
    ball, balls = kick.ball[0][1:], {round(1e3 * time_s): place for time_s, *place in kick.ball}
    paths = []
    for time_s, *pose in kick.robot:
        ball = balls.get(round(1e3 * time_s), ball)
        paths.append((pose, ball))
    return paths


def chosen_kicks(directory):
    """(title, a path) of three; one with a contact ends AFTER_CONTACT_FRAMES later."""
    log = os.path.join(directory, "bus.log")
    kicks = kicks_of(log)
    rows = rows_of(os.path.join(directory, "kick.json"), len(kicks))
    if len(kicks) < 3:
        raise PlotError(f"{log}: has {len(kicks)} kicks; give a run of at least 3")
    by_reward = sorted(range(len(kicks)), key=lambda episode: -rows[episode]["reward"])
    chosen = []
    for name, episode in (("best", by_reward[0]), ("middle", by_reward[len(kicks) // 2]), ("worst", by_reward[-1])):
        path, contact = paths_of_kick(kicks[episode]), rows[episode].get("contact_decision")
        end = len(path) if contact is None else contact + AFTER_CONTACT_FRAMES
        doubts = doubts_of(rows[episode], kicks[episode])
        chosen.append((f"{name} of {len(kicks)} kicks: reward {rows[episode]['reward']:.1f}{doubts}", path[:end]))
    return chosen


def scene_of(directory):
    """(title, a list of (ten poses or None, ball) a picture), lengths in m."""
    file = os.path.join(directory, "events.jsonl")
    try:
        with open(file, encoding="utf-8") as stream:
            begin, *events = [json.loads(line) for line in stream]
        goals = [event for event in events if event["event"] == "goal" and event["cause"] == "scored"]
        names = begin["teams"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise PlotError(f"{file}: cannot be read ({error}); give the directory of a match") from error
    seen = [places_of(os.path.join(directory, "bus", f"vcan{robot}.log.gz")) for robot in range(10)]
    balls = {time_ms: ball for _, of_a_robot in seen for time_ms, ball in of_a_robot.items()}
    end_ms = goals[0]["t_sim_ns"] // 1_000_000 if goals else max(balls)
    times = [time_ms for time_ms in sorted(balls) if time_ms <= end_ms][-SCENE_FRAMES:]
    scored = f": {goals[0]['team']} scores" if goals else ""
    return f"AI Soccer, {names[0]} (red) and {names[1]} (blue), {times[0] / 1e3:.1f} to {end_ms / 1e3:.1f} s{scored}", [
        ([places[time_ms] if time_ms in places else None for places, _ in seen], balls[time_ms]) for time_ms in times]


def middle_and_half(path):
    """Of the square that shows a path."""
    sides = [[place[axis] for pair in path for place in pair] for axis in (0, 1)]
    return [(max(side) + min(side)) / 2 for side in sides], max(max(side) - min(side) for side in sides) / 2 + 0.3


class KickPanel:
    def __init__(self, axes, title, paths, half_m):
        self.axes, self.paths = axes, paths
        (x_m, y_m), _ = middle_and_half(paths)
        axes.set_xlim(x_m - half_m, x_m + half_m)
        axes.set_ylim(y_m - half_m, y_m + half_m)
        axes.set_aspect("equal")
        axes.set_xlabel("x, m", labelpad=0)
        axes.set_ylabel("y, m", labelpad=0)
        axes.set_title(title, fontsize=9)

    def artists(self, frame):
        until = self.paths[:frame + 1]
        (x_m, y_m, heading_rad), ball = until[-1]
        for colour, place in ((BLUE, 0), (ORANGE, 1)):
            yield plt.Line2D([pair[place][0] for pair in until], [pair[place][1] for pair in until], color=colour, linewidth=1)
        yield from robot_artists(x_m, y_m, heading_rad, BLUE, LARGER * ROBOT_SIDE_M)
        yield ball_patch(*ball, LARGER * BALL_RADIUS_M, facecolor=ORANGE, edgecolor="black", linewidth=0.5)


class ScenePanel:
    def __init__(self, axes, title, pictures):
        self.axes, self.pictures = axes, pictures
        draw_field(axes)
        axes.grid(False)
        axes.set_title(title, fontsize=9)

    def artists(self, frame):
        place = min(frame, len(self.pictures) - 1)
        trail = [ball for _, ball in self.pictures[max(0, place - TRAIL_FRAMES):place + 1]]
        yield plt.Line2D([x / 1e3 for x, _ in trail], [y / 1e3 for _, y in trail], color=ORANGE, linewidth=2)
        robots, ball = self.pictures[place]
        for robot, pose in enumerate(robots):
            if pose is not None:
                x_mm, y_mm, heading_deg = pose
                yield from robot_artists(x_mm / 1e3, y_mm / 1e3, numpy.radians(heading_deg), TEAMS["red" if robot < 5 else "blue"],
                                         LARGER * ROBOT_SIDE_M)
        yield ball_patch(ball[0] / 1e3, ball[1] / 1e3, LARGER * BALL_RADIUS_M, facecolor=ORANGE, edgecolor="black", linewidth=0.5)


def robot_artists(x_m, y_m, heading_rad, colour, side_m):
    yield robot_patch(x_m, y_m, heading_rad, side_m, facecolor=colour, edgecolor="none")
    tip = (x_m + side_m / 2 * numpy.cos(heading_rad), y_m + side_m / 2 * numpy.sin(heading_rad))
    yield plt.Line2D([x_m, tip[0]], [y_m, tip[1]], color="white", linewidth=1.5)


def drawn(kicks, scene):
    """A picture each 50 ms: the background once, and what moves on it."""
    figure = plt.figure(figsize=(WIDTH_IN, HEIGHT_IN), dpi=DPI)
    half_m = max(middle_and_half(path)[1] for _, path in kicks)
    panels = [KickPanel(figure.add_axes((0.06 + 0.33 * place, 0.655, 0.26, 0.31)), *kick, half_m)
              for place, kick in enumerate(kicks)]
    panels.append(ScenePanel(figure.add_axes((0.06, 0.055, 0.92, 0.52)), *scene))
    canvas = figure.canvas
    canvas.draw()
    background = canvas.copy_from_bbox(figure.bbox)
    frames = len(scene[1]) + HELD_FRAMES
    for frame in range(frames):
        canvas.restore_region(background)
        for panel in panels:
            for artist in panel.artists(frame):
                panel.axes.add_artist(artist)
                panel.axes.draw_artist(artist)
                artist.remove()
        yield Image.fromarray(numpy.asarray(canvas.buffer_rgba())[:, :, :3].copy())
    plt.close(figure)


def differences(pictures):
    """Pictures of one palette, whose pixels are COLOURS where nothing has changed."""
    palette = pictures[len(pictures) // 2].quantize(COLOURS)
    before, delta = None, []
    for picture in pictures:
        indices = numpy.asarray(picture.quantize(palette=palette, dither=Image.Dither.NONE))
        delta.append(indices if before is None else numpy.where(indices == before, COLOURS, indices).astype(numpy.uint8))
        before = indices
    colours = palette.getpalette()[:3 * COLOURS]
    for indices in delta:
        image = Image.fromarray(indices, "P")
        image.putpalette(colours + [0, 0, 0])
        yield image


def draw(options, directory, command):
    try:
        pictures = list(drawn(chosen_kicks(options.kicks), scene_of(options.match)))
    except LogError as error:
        raise PlotError(error) from error
    first, *others = differences(pictures)
    os.makedirs(directory, exist_ok=True)
    target, animation = os.path.join(directory, "striker.gif"), io.BytesIO()
    first.save(animation, format="GIF", save_all=True, append_images=others, duration=FRAME_MS, loop=0, disposal=1,
               transparency=COLOURS, optimize=False, comment=command.encode())
    write_whole(target, animation.getvalue(), b"GIF8")
    print(target)


def main():
    parser = parser_of(PROGRAM, __doc__)
    parser.add_argument("kicks", metavar="KICKS", help="the directory of a run of kicks")
    parser.add_argument("match", metavar="MATCH", help="the directory of a match")
    run(PROGRAM, draw, parser.parse_args())


if __name__ == "__main__":
    main()
