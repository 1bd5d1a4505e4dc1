# SPDX-License-Identifier: Apache-2.0
"""JSON and CSV that programs of Striker wrote, read so that each value which is asked for is there and of its kind.

Otherwise LogError, one line with file, place, value and the way out:
  out/demo/kick.json: rows[3].reward = null is no number; make the run again
"""

import csv
import json

MOST = 1e300  # beyond it, as NaN is, a number is none to draw


class LogError(Exception):
    """What cannot be read, in one line."""


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= MOST


def is_whole(value):
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= MOST


def or_null(kind):
    holds, words = kind
    return lambda value: value is None or holds(value), f"{words}, and not null"


NUMBER = is_number, "no number"
WHOLE = is_whole, "no whole number from 0"
TEXT = lambda value: isinstance(value, str), "no text"  # noqa: E731
FLAG = lambda value: isinstance(value, bool), "neither true nor false"  # noqa: E731
NUMBER_OR_NULL, WHOLE_OR_NULL, TEXT_OR_NULL = or_null(NUMBER), or_null(WHOLE), or_null(TEXT)
TEXT_OR_NUMBER = lambda value: isinstance(value, str) or is_number(value), "neither text nor a number"  # noqa: E731
SCORE = lambda value: isinstance(value, list) and len(value) == 2 and all(map(is_whole, value)), "no score"  # noqa: E731
NAMES = (lambda value: isinstance(value, list) and len(value) == 2 and all(isinstance(name, str) for name in value),
         "no two names")
WHOLES = lambda value: isinstance(value, list) and all(map(is_whole, value)), "no list of whole numbers"  # noqa: E731
LIST = lambda value: isinstance(value, list), "no list"  # noqa: E731
OBJECT = lambda value: isinstance(value, dict), "no object"  # noqa: E731


class Record:
    """An object of a file; `place` is where it stands in it, as "rows[3]."."""

    def __init__(self, file, value, place=""):
        self.file, self.values, self.place = file, value, place
        if not isinstance(value, dict):
            self.fail(f"{place.rstrip('.') or 'the whole'} is no object")

    def fail(self, what):
        raise LogError(f"{self.file}: {what}; make the run again")

    def take(self, name, kind):
        """The value of a name; `kind` is one of the constants above."""
        holds, words = kind
        if name not in self.values:
            self.fail(f"{self.place}{name} is missing")
        value = self.values[name]
        if not holds(value):
            self.fail(f"{self.place}{name} = {json.dumps(value)[:40]} is {words}")
        return value

    def part(self, name):
        return Record(self.file, self.take(name, OBJECT), f"{self.place}{name}.")

    def parts(self, name):
        return [Record(self.file, value, f"{self.place}{name}[{number}].")
                for number, value in enumerate(self.take(name, LIST))]

    def names(self, kind):
        """Those whose values are of a kind."""
        return [name for name, value in self.values.items() if kind[0](value)]


def no_constant(text):
    raise ValueError(f"{text} is no number")


def parsed(file, text, place=""):
    try:
        return Record(file, json.loads(text, parse_constant=no_constant), place)
    except (ValueError, RecursionError) as error:
        raise LogError(f"{file}: {place}cannot be read ({error}); make the run again") from error


def text_of(file, way_out):
    try:
        with open(file, encoding="utf-8", newline="") as stream:
            return stream.read()
    except OSError as error:
        raise LogError(f"{file}: {error.strerror}; {way_out}") from error
    except UnicodeDecodeError as error:
        raise LogError(f"{file}: is no text in UTF-8; {way_out}") from error


def load(file, way_out):
    """A Record: the file's object."""
    return parsed(file, text_of(file, way_out))


def load_lines(file, way_out):
    """[Record]: an object a line, one at least."""
    *lines, rest = text_of(file, way_out).split("\n")
    if rest or not lines:
        raise LogError(f"{file}: " + (f"line {len(lines) + 1} is cut" if rest else "is empty") + "; make the run again")
    return [parsed(file, line, f"line {number}: ") for number, line in enumerate(lines, 1)]


def cell_of(text, kind):
    """A number where one is asked for and `text` is one, as JSON writes it."""
    try:
        return text if kind is TEXT else json.loads(text, parse_constant=no_constant)
    except (ValueError, RecursionError):
        return text


def load_table(file, way_out, kinds, least=1):
    """[{name: value}] of a CSV's rows, so many at least: the named columns, each of its kind."""
    text, rows = text_of(file, way_out), []
    if text and not text.endswith("\n"):
        raise LogError(f"{file}: its last line is cut; make the run again")
    try:
        reader = csv.DictReader(text.splitlines(), strict=True)
        absent = [name for name in kinds if name not in (reader.fieldnames or [])]
        if absent:
            raise LogError(f"{file}: has no column {absent[0]}; make the run again")
        for number, row in enumerate(reader, 2):
            record = Record(file, row, f"line {number}: ")
            if None in row or None in row.values():
                record.fail(f"line {number} has not as many values as the header")
            record.values = {name: cell_of(value, kinds.get(name, TEXT)) for name, value in row.items()}
            rows.append({name: record.take(name, kind) for name, kind in kinds.items()})
    except csv.Error as error:
        raise LogError(f"{file}: cannot be read ({error}); make the run again") from error
    if len(rows) < least:
        raise LogError(f"{file}: has no rows; make the run again")
    return rows
