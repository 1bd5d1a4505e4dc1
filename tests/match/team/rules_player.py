#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A player program of AI Soccer 2020 that plays as the team `rules` does, to the last bit: the same operations on the
same doubles in the same order (sil/match/team/{go_to,plane}.cpp, sil/match/team/rules/*.cpp say why it does what).

    rules_player.py HOST PORT KEY DATAPATH"""

import json
import math
import socket
import sys

HALF_LENGTH, HALF_WIDTH, GOAL_HALF_WIDTH = 3.9, 2.325, 0.5
AREA_LINE, AREA_HALF_WIDTH = 3.9 - 0.9, 0.9
SIDE, BALL_RADIUS = 0.15, 0.04
TOP_SPEEDS = (1.8, 2.1, 2.1, 2.55, 2.55)
OPEN_PLAY, KICKOFF, GOAL_KICK, CORNER, PENALTY = range(5)
GAME_END = 4


def radians(degrees):
    return degrees * math.pi / 180.0


def distance(a, b):
    x, y = b[0] - a[0], b[1] - a[1]
    return math.sqrt(x * x + y * y)


def bearing(here, there):
    x, y = there[0] - here[0], there[1] - here[1]
    return math.pi / 2.0 if x == 0.0 and y == 0.0 else math.atan2(y, x)


def wrapped(angle):
    return math.remainder(angle, 2.0 * math.pi)


def clamp(value, most):
    return min(max(value, -most), most)


def folded(angle):
    if angle > radians(95.0):
        return angle - math.pi, -1.0
    if angle < -radians(95.0):
        return angle + math.pi, -1.0
    return angle, 1.0


def limited(left, right, top, full=False):
    faster = max(abs(left), abs(right))
    if faster > top or full:
        if faster == 0.0:
            return 0.0, 0.0
        scale = top / faster
        left, right = left * scale, right * scale
    return left, right


def turn_share(away, angle):
    if away < 5.0 and abs(angle) < radians(40.0):
        return 0.1
    for further_than, share in ((1.0, 17.0), (0.5, 19.0), (0.3, 21.0), (0.2, 23.0)):
        if away > further_than:
            return share / 90.0
    return 25.0 / 90.0


def go_to(robot, target, speed, reach, gain, full, top):
    away = distance(robot, target)
    angle, direction = folded(wrapped(bearing(robot, target) - robot[2]))
    if abs(angle) > radians(85.0):
        return limited(-gain * angle, gain * angle, top)
    turn = gain * (4.0 * turn_share(away, angle)) * angle
    ahead = reach * (1.0 / (1.0 + math.exp(-3.0 * away)) - 0.35)
    return limited(speed * (direction * ahead - turn), speed * (direction * ahead + turn), top, full)


def turn_to(robot, heading, top):
    angle, _ = folded(wrapped(heading - robot[2]))
    return limited(-0.4 * angle, 0.4 * angle, top)


def in_own_area(spot):
    return spot[0] < -AREA_LINE and abs(spot[1]) <= AREA_HALF_WIDTH


def has_shoot_chance(robot, ball):
    x, y = ball[0] - robot[0], ball[1] - robot[1]
    return x > 0.0 and abs((HALF_LENGTH - ball[0]) * y / x + robot[1]) < GOAL_HALF_WIDTH


def to_middle(y):
    return y + 0.2 if y < 0.0 else y - 0.2


class Rules:
    def __init__(self):
        self.wheels = [(0.0, 0.0)] * 5
        self.robots = self.ball = self.before = None

    def play(self, frame):
        own, _, ball = frame["coordinates"]
        self.robots = [(robot[0], robot[1], robot[3]) for robot in own]
        self.ball = (ball[0], ball[1])
        if frame["reset_reason"] != 0 or self.before is None:
            self.before = self.ball
        state = frame["game_state"]
        if state in (OPEN_PLAY, CORNER):
            self.keep_goal()
            nearest = [min(pair, key=lambda i: (distance(self.robots[i], self.ball), i)) for pair in ((1, 2), (3, 4))]
            for i in (1, 2):
                self.defend(i, i == nearest[0])
            for i in (3, 4):
                self.attack(i, i == nearest[1])
        elif frame["ball_ownership"]:
            if state == KICKOFF:
                self.go(4, (0.0, 0.0), 1.4, 3.0, 0.4)
            else:
                robot = 0 if state == GOAL_KICK else 4
                self.wheels[robot] = (TOP_SPEEDS[robot], TOP_SPEEDS[robot])
        self.before = self.ball
        return self.wheels

    def go(self, i, target, speed, reach, gain, full=False):
        self.wheels[i] = go_to(self.robots[i], target, speed, reach, gain, full, TOP_SPEEDS[i])

    def turn(self, i, heading):
        self.wheels[i] = turn_to(self.robots[i], heading, TOP_SPEEDS[i])

    def keep_goal(self):
        (x, y, heading), ball = self.robots[0], self.ball
        line = -HALF_LENGTH + SIDE / 2.0 + 0.05
        home = (line, clamp(ball[1], GOAL_HALF_WIDTH - SIDE / 2.0))
        if x < -HALF_LENGTH:
            self.go(0, (line, to_middle(y)), 1.4, 5.0, 0.4)
        elif not in_own_area((x, y)):
            self.go(0, home, 1.4, 5.0, 0.4, True)
        elif in_own_area(ball):
            if ball[0] < x:
                if abs(ball[1] - y) > 0.3:
                    self.go(0, (ball[0] - 0.15, y), 1.4, 5.0, 0.4)
                else:
                    self.turn(0, math.pi / 2.0)
            elif wrapped(bearing((x, y), ball) - heading) > radians(60.0):
                self.go(0, home, 1.4, 5.0, 0.4)
            else:
                self.go(0, ball, 1.4, 3.0, 0.8, True)
        elif (ball[0] < -HALF_LENGTH + 1.5 * (HALF_LENGTH - AREA_LINE) and abs(ball[1]) < 1.5 * AREA_HALF_WIDTH
              and abs(ball[1] - y) < 0.2):
            self.turn(0, bearing((x, y), ball))
        else:
            self.go(0, home, 1.4, 5.0, 0.4, True)

    def defend(self, i, is_nearest):
        (x, y, _), ball = self.robots[i], self.ball
        waiting, last, most = -0.7 * HALF_LENGTH, -HALF_LENGTH + SIDE / 2.0, HALF_WIDTH - SIDE / 2.0
        if x < -HALF_LENGTH:
            self.go(i, (waiting, to_middle(y)), 1.4, 3.5, 0.6)
        elif is_nearest and has_shoot_chance((x, y), ball) and ball[0] < 0.3 * HALF_LENGTH:
            self.go(i, ball, 1.4, 5.0, 0.4, True)
        elif is_nearest and ball[0] < 0.0:
            if x < ball[0] - BALL_RADIUS:
                self.go(i, ball, 1.4, 5.0, 0.4, True)
            else:
                self.go(i, (max(ball[0] - 0.5, last), ball[1] if abs(ball[1] - y) > 0.3 else y), 1.4, 3.5, 0.6)
        elif is_nearest:
            self.go(i, (waiting, ball[1]), 1.4, 3.5, 0.4)
        elif ball[0] < 0.0:
            self.go(i, (max(ball[0] - 0.5, last + 0.1), clamp(ball[1], GOAL_HALF_WIDTH + 0.15)), 1.4, 3.5, 0.4)
        else:
            self.go(i, (waiting, min(ball[1] + 0.5, most) if ball[1] < 0.0 else max(ball[1] - 0.5, -most)), 1.4, 3.5,
                    0.4)

    def attack(self, i, is_nearest):
        (x, y, _), ball, before = self.robots[i], self.ball, self.before
        zone, waiting, most = 0.3 * HALF_LENGTH, -0.1 * HALF_LENGTH, HALF_WIDTH - SIDE / 2.0
        if abs(ball[0]) < zone and x > ball[0] + 0.1 and abs(y - ball[1]) < 0.3:
            self.go(i, (x - 0.25, ball[1] + 0.75 if ball[1] < 0.0 else ball[1] - 0.75), 1.4, 3.0, 0.8)
        elif is_nearest and has_shoot_chance((x, y), ball):
            soon = (ball[0] + 2.0 * (ball[0] - before[0]), ball[1] + 2.0 * (ball[1] - before[1]))
            self.go(i, soon, 1.4, 5.0, 0.4, True)
        elif is_nearest and self.will_cross(x, y):
            self.turn(i, bearing((x, y), (HALF_LENGTH, 0.0)))
        elif is_nearest and ball[0] > -zone:
            if x < ball[0] - BALL_RADIUS:
                self.go(i, ball, 1.4, 5.0, 0.4, True)
            else:
                self.go(i, (ball[0] - 0.2, ball[1] if abs(ball[1] - y) > 0.3 else y), 1.4, 3.5, 0.6)
        elif is_nearest:
            self.go(i, (waiting, ball[1]), 1.4, 3.5, 0.4)
        elif ball[0] > -zone:
            self.go(i, (ball[0] - 0.25, GOAL_HALF_WIDTH if ball[1] < 0.0 else -GOAL_HALF_WIDTH), 1.4, 3.5, 0.4)
        else:
            self.go(i, (waiting, min(-ball[1] - 0.5, most) if ball[1] < 0.0 else max(-ball[1] + 0.5, -most)), 1.4, 3.5,
                    0.4)

    def will_cross(self, x, y):
        ball, before = self.ball, self.before
        move = (ball[0] - before[0], ball[1] - before[1])
        comes = abs(x - ball[0]) < abs(x - before[0]) and abs(y - ball[1]) < abs(y - before[1])
        if not comes or move[1] == 0.0:
            return False
        ahead = (y - ball[1]) * move[0] / move[1] + ball[0] - x
        return 0.1 < ahead < 0.3 and (y - ball[1]) / move[1] < 10.0


def frames_of(connection):
    decoder, text = json.JSONDecoder(), ""
    while data := connection.recv(4096):
        text += data.decode()
        while text:
            try:
                frame, end = decoder.raw_decode(text)
            except ValueError:
                break  # the rest has not come yet
            text = text[end:]
            yield frame


def main():
    host, port, key = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    with socket.create_connection((host, port)) as connection:
        def say(name, numbers=()):
            arguments = "".join(f", {number!r}" for number in numbers)
            connection.sendall(f'aiwc.{name}("{key}"{arguments})'.encode())

        frames = frames_of(connection)
        say("get_info")
        info = next(frames)
        assert tuple(info["max_linear_velocity"]) == TOP_SPEEDS, info
        say("ready")
        rules = Rules()
        for frame in frames:
            if frame["reset_reason"] == GAME_END:
                break
            say("set_speeds", [number for left, right in rules.play(frame) for number in (left, right, 0, 0)])


if __name__ == "__main__":
    main()
