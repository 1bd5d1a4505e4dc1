#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""match.log.gz as somebody else reads it: the container by its published layout, every message with protoc and the .proto
files, and what they say against the other records of the same match.

Usage: ssl_log_test.py RECORDER PROTO_DIRECTORY
"""

import csv
import gzip
import json
import os
import struct
import subprocess
import sys
import tempfile

REFEREE, VISION, TRACKER, INDEX = 3, 4, 5, 6
MESSAGES = {REFEREE: ("Referee", "ssl_referee.proto"), VISION: ("SSL_WrapperPacket", "ssl_vision.proto"),
            TRACKER: ("TrackerWrapperPacket", "ssl_tracker.proto")}


def expect(what, found, wanted):
    if found != wanted:
        sys.exit(f"{what}: {found!r}, not {wanted!r}")


def records_of(file):
    """(offset, time in ns, type, payload) of each record."""
    with open(file, "rb") as stream:
        head = stream.read(10)
    expect("gzip: flags and time", head[3:8], bytes(5))
    with gzip.open(file) as stream:
        log = stream.read()
    expect("mark", log[:12], b"SSL_LOG_FILE")
    expect("version", struct.unpack(">i", log[12:16]), (1,))
    offset, records = 16, []
    while offset < len(log):
        time_ns, kind, size = struct.unpack(">qii", log[offset:offset + 16])
        records.append((offset, time_ns, kind, log[offset + 16:offset + 16 + size]))
        offset += 16 + size
    expect("end of the last record", offset, len(log))
    return records


def check_index(records):
    offset, time_ns, kind, payload = records[-1]
    expect("type of the last record", kind, INDEX)
    expect("time of the index", time_ns, 0)
    expect("mark of the index", payload[-7:], b"INDEXED")
    *offsets, distance = struct.unpack(f">{len(payload[:-7]) // 8}q", payload[:-7])
    expect("offsets", offsets, [record[0] for record in records[:-1]])
    expect("distance to the index", offset + distance, offset + 16 + len(payload))


def varint(value):
    encoded = bytearray()
    while value >= 0x80:
        encoded.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes(encoded) + bytes([value])


def parsed(lines):
    """protoc's text as a dictionary of lists."""
    fields = {}
    for line in lines:
        line = line.strip()
        if line == "}":
            break
        if line.endswith(" {"):
            fields.setdefault(line[:-2], []).append(parsed(lines))
        elif line:
            name, value = line.split(": ", 1)
            fields.setdefault(name, []).append(value)
    return fields


def decoded(messages, kind, protos):
    """All of one type in one go: as the fields of a message that holds them."""
    name, proto = MESSAGES[kind]
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "all.proto"), "w", encoding="utf-8") as file:
            file.write(f'syntax = "proto2";\nimport "{proto}";\nmessage All {{ repeated striker.ssl.{name} one = 1; }}\n')
        done = subprocess.run(["protoc", f"-I{folder}", f"-I{protos}", "--decode=All", "all.proto"], check=False,
                              input=b"".join(b"\x0a" + varint(len(one)) + one for one in messages), capture_output=True)
    expect(f"protoc on {name}", (done.returncode, done.stderr), (0, b""))
    text = done.stdout.decode()
    unknown = [line for line in text.splitlines() if line.strip().split(":")[0].split(" ")[0].isdigit()]
    expect(f"fields of {name} that the .proto file does not know", unknown, [])
    return parsed(iter(text.splitlines()))["one"]


def check_vision(vision, report, rows):
    expect("vision records", len(vision), report["flow"]["frames"])
    for number, packet in enumerate(vision):
        frame = packet["detection"][0]
        expect("frame_number", int(frame["frame_number"][0]), number)
        expect("t_capture", float(frame["t_capture"][0]), number * 50 / 1000)
        expect("robots", (len(frame["robots_yellow"]), len(frame["robots_blue"])), (5, 5))
        expect("geometry", "geometry" in packet, number % 20 == 0)
    size = vision[0]["geometry"][0]["field"][0]
    expect("geometry", [int(size[name][0]) for name in ("field_length", "field_width", "goal_width", "goal_depth",
                                                        "penalty_area_depth", "penalty_area_width",
                                                        "center_circle_radius")],
           [7800, 4650, 1000, 450, 900, 1800, 500])
    expect("lines", len(size["field_lines"]), 12)
    for row in rows:
        frame = vision[int(row["frame"])]["detection"][0]
        half = 1 if row["half"] == 1 else -1  # red's own frame is the field's, or turned
        for key, column in (("x", "ball_pos_0"), ("y", "ball_pos_1")):
            expect(f"ball {key} of frame {row['frame']}", abs(float(frame["balls"][0][key][0]) / 1e3 * half -
                                                              float(row[column])) < 2e-6, True)
        for robot in range(5):
            found = float(frame["robots_blue"][robot]["x"][0]) / 1e3 * half
            expect("blue's x", abs(found - float(row[f"robot_{robot}_cur_pos_opp_0"])) < 2e-6, True)


def check_tracker(tracker, vision):
    expect("tracker records", len(tracker), len(vision))
    for packet, seen in zip(tracker, vision):
        frame = packet["tracked_frame"][0]
        expect("frame number", frame["frame_number"], seen["detection"][0]["frame_number"])
        expect("robots", [(robot["robot_id"][0]["team"][0], int(robot["robot_id"][0]["id"][0]))
                          for robot in frame["robots"]],
               [(team, robot) for team in ("YELLOW", "BLUE") for robot in range(5)])
    expect("a ball that rolls", any(float(packet["tracked_frame"][0]["balls"][0]["vel"][0]["x"][0]) == 2.0
                                    for packet in tracker), True)


def commands_of(events):
    """By the table of ssl_referee.hpp, from our own record of the same match."""
    team = {"red": "YELLOW", "blue": "BLUE"}
    free = {"kickoff": "PREPARE_KICKOFF_", "penalty": "PREPARE_PENALTY_"}
    for event in events:
        piece, owner = event["set_piece"], team.get(event["owner"])
        if event["event"] in ("goal", "ball_out", "crowding", "deadlock", "half_over", "match_over"):
            yield "HALT"
        elif event["event"] == "restart":
            yield free[piece] + owner if piece in free else "STOP"
        elif event["event"] == "resumed":
            yield "NORMAL_START" if piece in free else f"DIRECT_FREE_{owner}" if piece else "FORCE_START"


def check_referee(referee, report, events):
    commands, last = [], 0
    for message in referee:
        if int(message["command_counter"][0]) != last:
            expect("command_counter", int(message["command_counter"][0]), last + 1)
            last += 1
            commands.append(message["command"][0])
        expect("sides", message["blue_team_on_positive_half"][0], "true" if half_of(message) == 1 else "false")
    expect("commands", commands, list(commands_of(events)))
    stages = [message["stage"][0] for message in referee]
    expect("stages", list(dict.fromkeys(stages)), ["NORMAL_FIRST_HALF_PRE", "NORMAL_FIRST_HALF", "NORMAL_HALF_TIME",
                                                   "NORMAL_SECOND_HALF_PRE", "NORMAL_SECOND_HALF", "POST_GAME"])
    end = referee[-1]
    expect("score", [int(end[colour][0]["score"][0]) for colour in ("yellow", "blue")], report["result"]["score"])
    expect("names", [json.loads(end[colour][0]["name"][0]) for colour in ("yellow", "blue")], report["teams"])
    told = {(event["type"][0], int(event["created_timestamp"][0])) for message in referee
            for event in message.get("game_events", [])}
    names = {"goal": "GOAL", "deadlock": "NO_PROGRESS_IN_GAME", "sent_out": "BOT_TIPPED_OVER"}
    lines = {"side_line": "BALL_LEFT_FIELD_TOUCH_LINE", "end_line": "BALL_LEFT_FIELD_GOAL_LINE"}
    expect("game events", told, {(names.get(event["event"]) or lines[event["cause"]], event["t_sim_ns"] // 1000)
                                 for event in events if event["event"] in (*names, "ball_out")})


def half_of(message):
    return 2 if message["stage"][0] in ("NORMAL_SECOND_HALF_PRE", "NORMAL_SECOND_HALF", "POST_GAME") else 1


def rows_of(file, events):
    """Rows with their half."""
    second_ns = next(event["t_sim_ns"] for event in events if event["event"] == "half_over")
    with open(file, encoding="utf-8", newline="") as stream:
        return [dict(row, half=1 if int(row["frame"]) * 50_000_000 <= second_ns else 2) for row in csv.DictReader(stream)]


def main():
    recorder, protos = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([recorder, folder], check=True)
        records = records_of(os.path.join(folder, "match.log.gz"))
        with open(os.path.join(folder, "match.json"), encoding="utf-8") as stream:
            report = json.load(stream)
        with open(os.path.join(folder, "events.jsonl"), encoding="utf-8") as stream:
            events = [json.loads(line) for line in stream][1:]
        rows = rows_of(os.path.join(folder, "frames.csv"), events)
    check_index(records)
    times = [record[1] for record in records[:-1]]
    expect("times", times, sorted(times))
    vision, tracker, referee = ([record[3] for record in records if record[2] == kind]
                                for kind in (VISION, TRACKER, REFEREE))
    expect("records of other types", len(records), len(vision) + len(tracker) + len(referee) + 1)
    vision, tracker = decoded(vision, VISION, protos), decoded(tracker, TRACKER, protos)
    check_vision(vision, report, rows)
    check_tracker(tracker, vision)
    check_referee(decoded(referee, REFEREE, protos), report, events)
    print(f"{len(records) - 1} records of {len(events)} events decoded")


if __name__ == "__main__":
    main()
