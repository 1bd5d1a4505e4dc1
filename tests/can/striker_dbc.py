# SPDX-License-Identifier: Apache-2.0
"""The message table as firmware/can/striker.dbc tells it, so that no test types an identifier or a state by hand."""

import functools
import os

import canmatrix.formats

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MATRIX = canmatrix.formats.loadp_flat(os.path.join(ROOT, "firmware", "can", "striker.dbc"))


def identifier(message):
    return MATRIX.frame_by_name(message).arbitration_id.id


def messages():
    """The names of all messages."""
    return [frame.name for frame in MATRIX.frames]


def length(message):
    """Bytes of data."""
    return MATRIX.frame_by_name(message).size


def sent_by(node):
    """The identifiers of the messages that a node sends."""
    return {frame.arbitration_id.id for frame in MATRIX.frames if node in frame.transmitters}


@functools.cache
def _signal(message, signal):
    return MATRIX.frame_by_name(message).signal_by_name(signal)


def raw(message, signal, payload):
    """A signal's count in a message's payload. Fast: a board's image does not wait for who answers it."""
    place = _signal(message, signal)
    assert place.is_little_endian
    count = int.from_bytes(payload, "little") >> place.get_startbit() & (1 << place.size) - 1
    return count - (1 << place.size) if place.is_signed and count >> (place.size - 1) else count


def named(message, signal, payload):
    """The name of a signal's value in a message's payload, as "active" of a Status' state."""
    return _signal(message, signal).values[raw(message, signal, payload)]


def value(message, signal, name):
    """The count that a signal's named value stands for."""
    values = _signal(message, signal).values
    return next(count for count, known in values.items() if known == name)


def attribute(message, name):
    """A message's attribute, or its default."""
    return MATRIX.frame_by_name(message).attribute(name, db=MATRIX)
