#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""DBC files of all kinds, made here: striker-bus-budget reads each as canmatrix does, or refuses it and says where and
why. Usage: dbc_corpus_test.py BIN_DIRECTORY"""

import contextlib
import io
import json
import logging
import os
import random
import subprocess
import sys
import unittest

import canmatrix.formats

import files_case

BIN = sys.argv.pop(1)

HEAD = """VERSION "1.0"

NS_ :
\tNS_DESC_
\tCM_
\tBA_DEF_
\tBA_
\tVAL_
\tCAT_DEF_
\tCAT_
\tFILTER
\tBA_DEF_DEF_
\tSG_MUL_VAL_

BS_:

BU_: Motor Brake Gateway

"""
TWO = """BO_ 256 Speed: 8 Motor
 SG_ speed : 0|16@1+ (0.1,-40) [0|6513.5] "km/h" Brake,Gateway

BO_ 512 Pressure: 4 Brake
 SG_ pressure : 7|16@0- (1,0) [-32768|32767] "bar" Motor

"""
CYCLES = """BA_DEF_ BO_ "GenMsgCycleTime" INT 0 65535;
BA_DEF_DEF_ "GenMsgCycleTime" 1000;
BA_ "GenMsgCycleTime" BO_ 256 10;
"""
EVERYTHING = (HEAD + 'VAL_TABLE_ Switch 1 "on" 0 "off" ;\n' + TWO + """BO_ 768 Multiplexed: 8 Gateway
 SG_ which M : 0|8@1+ (1,0) [0|0] "" Motor
 SG_ one m0 : 8|8@1+ (1,0) [0|0] "" Motor
 SG_ two m1 : 8|8@1+ (1,0) [0|0] "" Motor

BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX
 SG_ lost : 0|8@1+ (1,0) [0|0] "" Vector__XXX

BO_TX_BU_ 768 : Gateway,Motor;
EV_ Key: 0 [0|1] "" 0 1 DUMMY_NODE_VECTOR0 Motor;
ENVVAR_DATA_ Key: 10;
CM_ "the file";
CM_ BU_ Motor "a node";
CM_ BO_ 256 "a message";
CM_ SG_ 256 speed "a signal";
BA_DEF_ "BusType" STRING ;
BA_DEF_ BU_ "Address" HEX 0 255;
BA_DEF_ SG_ "GenSigStartValue" FLOAT 0 100000;
BA_DEF_ EV_ "Kind" INT 0 1;
BA_DEF_REL_ BU_SG_REL_ "Timeout" INT 0 1000;
BA_DEF_DEF_ "BusType" "CAN";
BA_DEF_DEF_ "Address" 0;
BA_DEF_DEF_ "GenSigStartValue" 0;
BA_DEF_DEF_ "Kind" 0;
BA_DEF_DEF_REL_ "Timeout" 0;
BA_ "BusType" "CAN FD";
BA_ "Address" BU_ Motor 17;
BA_ "GenSigStartValue" SG_ 256 speed 3;
BA_ "Kind" EV_ Key 1;
BA_REL_ "Timeout" BU_SG_REL_ Brake SG_ 256 speed 100;
""" + CYCLES + """VAL_ 512 pressure 1 "high; BO_ 9 X: 8 Y" 0 "low" ;
SIG_GROUP_ 256 Group 1 : speed;
SIG_VALTYPE_ 512 pressure : 0;
SG_MUL_VAL_ 768 one which 0-0;
""")
COMMENTS = HEAD + TWO + CYCLES + r"""CM_ BO_ 256 "In place of the message of the cars of 2019:
BO_ 900 OldSpeed: 8 Motor
BO_ 256 Speed: 6 Motor
BA_ \"GenMsgCycleTime\" BO_ 256 1;
";
CM_ SG_ 512 pressure "// no comment; not \"this\"
either";
"""
EXTENDED = HEAD + """BO_ 2364540158 EEC1: 8 Motor
 SG_ torque : 0|8@1+ (1,-125) [-125|125] "%" Brake

BO_ 2566834942 DM1: 8 Brake

BO_ 291 Short: 1 Gateway

BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN","ExtendedCAN","reserved","J1939PG";
BA_DEF_ BO_ "GenMsgCycleTime" FLOAT 0 1E+5;
BA_DEF_DEF_ "VFrameFormat" "StandardCAN";
BA_DEF_DEF_ "GenMsgCycleTime" 0;
BA_ "VFrameFormat" BO_ 2364540158 3;
BA_ "VFrameFormat" BO_ 2566834942 1;
BA_ "GenMsgCycleTime" BO_ 2364540158 2.5;
BA_ "GenMsgCycleTime" BO_ 2566834942 1E+3;
BA_ "GenMsgCycleTime" BO_ 291 0.5;
"""
FD = HEAD + """BO_ 256 Fast: 64 Motor

BO_ 257 Short: 8 Motor

BO_ 2147483905 Long: 12 Brake

BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN","ExtendedCAN",""" + '"reserved",' * 12 + """"StandardCAN_FD",\
"ExtendedCAN_FD";
BA_DEF_ BO_ "GenMsgCycleTime" INT 0 65535;
BA_DEF_DEF_ "VFrameFormat" "StandardCAN_FD";
BA_DEF_DEF_ "GenMsgCycleTime" 20;
BA_ "VFrameFormat" BO_ 256 14;
BA_ "VFrameFormat" BO_ 257 0;
BA_ "VFrameFormat" BO_ 2147483905 15;
"""
SEND_TYPES = HEAD + TWO + """BO_ 768 OnChange: 2 Gateway

BA_DEF_ BO_ "GenMsgSendType" ENUM "Cyclic","OnChange","NoMsgSendType";
BA_DEF_ BO_ "GenMsgDelayTime" INT 0 65535;
BA_DEF_DEF_ "GenMsgSendType" "Cyclic";
BA_DEF_DEF_ "GenMsgDelayTime" 0;
BA_ "GenMsgSendType" BO_ 768 1;
BA_ "GenMsgDelayTime" BO_ 768 50;
BA_ "GenMsgSendType" BO_ 256 2;
""" + CYCLES
FOREIGN = (HEAD + TWO + CYCLES).replace("Pressure", "制动").replace("Brake", "刹车")
ACCENTS = (HEAD + TWO + CYCLES).replace("Pressure", "Pressão").replace("Gateway", "Brücke")

CONTENTS = {"everything": EVERYTHING, "comments": COMMENTS, "extended": EXTENDED, "fd": FD, "send_types": SEND_TYPES,
            "foreign": FOREIGN, "accents": ACCENTS}
OPTIONS = ["--default-distance-ms", "7", "--data-bitrate", "2000000"]


def outside_texts(text, change):
    """The text with `change` made to every part that is in no quotes."""
    parts = text.replace('\\"', "\0").split('"')
    parts[::2] = [change(part) for part in parts[::2]]
    return '"'.join(parts).replace("\0", '\\"')


def shuffled(text):
    """The statements in another order: blocks of lines, which no text breaks."""
    marked = outside_texts(text, lambda part: part.replace("\nBO_", "\1BO_").replace(";\n", ";\1"))
    head, *rest = marked.split("\1")
    random.Random(1).shuffle(rest)
    return "\n".join([head, *rest]) + "\n"


LAYOUTS = {
    "lf": lambda text: text,
    "crlf": lambda text: text.replace("\n", "\r\n"),
    "cr": lambda text: text.replace("\n", "\r"),
    "mixed": lambda text: text.replace("\n\n", "\r\n\n").replace(";\n", ";\r\n"),
    "one_line": lambda text: outside_texts(text, lambda part: part.replace("\n", " ")),
    "word_a_line": lambda text: text[:text.index("BS_")] + outside_texts(
        text[text.index("BS_"):], lambda part: part.replace(" ", "\n")),
    "indented": lambda text: text.replace("\n", "\n\t  "),
    "no_last_end": lambda text: text.rstrip("\n"),
    "shuffled": shuffled,
    "commented": lambda text: text.replace("\n\nBO_", "\n// BO_ 5 Ghost: 8 Motor\n\nBO_"),
}

LINE = {"foreign": {"gbk": "gbk", "utf8": "utf-8", "bom": "utf-8-sig"},
        "accents": {"latin1": "iso-8859-1", "utf8": "utf-8"}}


def corpus():
    """Name, bytes, and the text that canmatrix reads in their place, in UTF-8."""
    for content, text in CONTENTS.items():
        for encoding_name, encoding in LINE.get(content, {"utf8": "utf-8"}).items():
            for layout, change in LAYOUTS.items():
                yield f"{content}_{encoding_name}_{layout}", change(text).encode(encoding), text
    for seed in range(10):
        text = written_by_canmatrix(seed)
        yield f"canmatrix_{seed}", text.encode(), text


def written_by_canmatrix(seed):
    """Drawn messages, as another tool writes them."""
    draw = random.Random(seed)
    matrix = canmatrix.CanMatrix()
    matrix.add_ecu(canmatrix.Ecu("One"))
    matrix.add_ecu(canmatrix.Ecu("Two"))
    matrix.add_frame_defines("GenMsgCycleTime", "INT 0 65535")
    matrix.add_define_default("GenMsgCycleTime", "0")
    for number in range(draw.randint(1, 40)):
        extended = draw.random() < 0.5
        frame = canmatrix.Frame(
            f"Message{number}", size=draw.randint(0, 8), transmitters=[draw.choice(["One", "Two"])],
            arbitration_id=canmatrix.ArbitrationId(draw.randrange(1 << (29 if extended else 11)), extended))
        if frame.size > 0:
            frame.add_signal(canmatrix.Signal("signal", start_bit=0, size=8, unit=draw.choice(["", "°", "m/s"])))
        frame.add_comment(draw.choice(['say "BO_ 1 X: 8 One"', 'two\nBO_ 2 Y: 8 Two\nlines;', "", "a; b"]))
        frame.cycle_time = draw.randint(1, 1000)
        frame.add_attribute("GenMsgCycleTime", str(frame.cycle_time))
        if all(frame.arbitration_id != other.arbitration_id for other in matrix.frames):
            matrix.add_frame(frame)
    out = io.BytesIO()
    canmatrix.formats.dump(matrix, out, "dbc", dbcExportEncoding="utf-8", dbcExportCommentEncoding="utf-8")
    return out.getvalue().decode()


def messages_by_canmatrix(text):
    """(identifier, extended) to (name, bytes, sender, FD, period in ms); the test fails if canmatrix complains."""
    logging.disable(logging.WARNING)
    told = io.StringIO()
    with contextlib.redirect_stdout(told):
        matrix = canmatrix.formats.loads_flat(text.encode(), "dbc", dbcImportEncoding="utf-8")
    assert told.getvalue() == "", told.getvalue()
    messages = {}
    for frame in matrix.frames:
        if frame.name == "VECTOR__INDEPENDENT_SIG_MSG":
            continue
        cycle = frame.attributes.get("GenMsgCycleTime")
        if cycle is None and frame.attribute("GenMsgSendType", db=matrix) in (None, "Cyclic"):
            cycle = frame.attribute("GenMsgCycleTime", db=matrix)
        period = float(cycle or 0) or float(frame.attribute("GenMsgDelayTime", db=matrix) or 0)
        messages[frame.arbitration_id.id, bool(frame.arbitration_id.extended)] = (
            frame.name, frame.size, frame.transmitters[0], frame.is_fd or frame.size > 8, period)
    return messages


TWO_IN_TIME = TWO + CYCLES
REFUSED = {  # text, where in it the line of the refusal begins, and words of the refusal
    "no_sender": (HEAD + TWO.replace("8 Motor", "8"), "BO_ 256", "Vector__XXX"),
    "no_length": (HEAD + TWO.replace(": 8 Motor", ": Motor"), "BO_ 256", "'Motor' is no number"),
    "no_colon": (HEAD + TWO.replace("Speed:", "Speed"), "BO_ 256", "needs ':'"),
    "not_closed": (HEAD + TWO + 'CM_ "a\nb;\n', 'CM_ "', "no end"),
    "no_semicolon": (HEAD + TWO + 'CM_ "a"\n' + CYCLES, "BA_DEF_ BO_", "needs ';'"),
    "unknown": (HEAD + TWO + "BO_ID_ 5;\n", "BO_ID_", "'BO_ID_' begins no DBC statement"),
    "unknown_symbol": (HEAD.replace("CAT_\n", "DOG_\n") + TWO, "\tDOG_", "'DOG_' begins no DBC statement"),
    "typed_twice": (HEAD + TWO + TWO.replace("Speed", "Again"), "BO_ 256 Again", "identifier 256 is there twice"),
    "no_such_message": (HEAD + TWO_IN_TIME + 'BA_ "GenMsgCycleTime" BO_ 5 1;\n', 'BA_ "GenMsgCycleTime" BO_ 5 ',
                        "message 5"),
    "comma": (HEAD + TWO_IN_TIME.replace(" 10;", " 0,5;"), 'BA_ "', "needs ';'"),
    "no_number": (HEAD + TWO_IN_TIME.replace(" 10;", " fast;"), 'BA_ "', "'fast' is no number"),
    "infinite": (HEAD + TWO_IN_TIME.replace(" 10;", " inf;"), 'BA_ "', "'inf' is no number"),
    "two_values": (HEAD + TWO_IN_TIME + 'BA_ "GenMsgCycleTime" BO_ 256 20;\n', 'BA_ "GenMsgCycleTime" BO_ 256 20',
                   "otherwise than in line"),
    "no_choice": (SEND_TYPES.replace("BO_ 768 1", "BO_ 768 3"), 'BA_ "GenMsgSendType" BO_ 768', "of the 3 values"),
    "event_alone": (SEND_TYPES.replace("BO_ 768 50", "BO_ 768 0"), "BO_ 768", "--default-distance-ms"),
    "no_period": (HEAD + TWO, "BO_ 256", "--default-distance-ms"),
    "twelve_bits": (HEAD + TWO_IN_TIME.replace("512", "4096"), "BO_ 4096", "add 2147483648"),
    "thirty_bits": (HEAD + TWO_IN_TIME.replace("512", "3000000000"), "BO_ 3000000000", "29 bits"),
    "too_long": (HEAD + TWO_IN_TIME.replace(": 4", ": 65"), "BO_ 512", "0 to 64 bytes"),
    "transported": (EXTENDED.replace("EEC1: 8", "EEC1: 39"), "BO_ 2364540158", "TP.DT"),
    "fd_alone": (FD, "BO_ 256", "--data-bitrate"),
    "binary": ("BO_ 1 M: 8 A\n\0\1", "\0", "byte 0x00"),
    "control": (HEAD + TWO.replace("Speed", "\x1b[31mSpeed"), "BO_ 256", "byte 0x1B"),
}


class DbcCorpus(files_case.FilesCase):
    def budget(self, content, *options):
        path = self.file("a.dbc")
        with open(path, "wb") as stream:
            stream.write(content)
        return subprocess.run([os.path.join(BIN, "striker-bus-budget"), "--dbc", path, "--json", self.file("a.json"),
                               *options], capture_output=True)

    def test_what_is_read_is_what_canmatrix_reads(self):
        count = 0
        for name, content, plain in corpus():
            with self.subTest(name):
                result = self.budget(content, *OPTIONS)
                self.assertIn(result.returncode, (0, 1), result.stderr)
                with open(self.file("a.json"), encoding="utf-8") as stream:
                    messages = json.load(stream)["messages"]
                expected = messages_by_canmatrix(plain)
                self.assertEqual(len(messages), len(expected))
                for message in messages:
                    extended = message["format"].startswith("Extended")
                    title, size, sender, fd, period = expected[message["id"], extended]
                    self.assertEqual((message["bytes"], message["format"].endswith("_FD")), (size, fd), message)
                    self.assertEqual(message["period_us"], 1000 * (period or 7), message)
                    if "gbk" not in name and "latin1" not in name:
                        self.assertEqual((message["name"], message["sender"]), (title, sender))
                count += 1
        print(f"{count} files", file=sys.stderr)
        self.assertGreaterEqual(count, 50)

    def test_names_in_other_encodings_are_shown_as_they_are_and_replaced_in_json(self):
        result = self.budget(FOREIGN.encode("gbk"), *OPTIONS)
        self.assertIn("制动".encode("gbk"), result.stdout)
        with open(self.file("a.json"), encoding="utf-8") as stream:
            names = [message["name"] for message in json.load(stream)["messages"]]
        self.assertEqual(names[0], "Speed")
        self.assertIn("\ufffd", names[1])

    def test_what_is_refused_is_named_with_file_line_and_way_out(self):
        for name, (text, place, words) in REFUSED.items():
            with self.subTest(name):
                line = text[:text.index(place)].count("\n") + 1
                result = self.budget(text.encode())
                self.assertEqual(result.returncode, 2, result.stdout)
                message = result.stderr.decode()
                self.assertIn(f"a.dbc: line {line}: ", message)
                self.assertIn(words, message)
                self.assertEqual(message.count("\n"), 1, message)
                self.assertEqual(result.stdout, b"")
                self.assertFalse(os.path.exists(self.file("a.json")))


if __name__ == "__main__":
    unittest.main(verbosity=2)
