# SPDX-License-Identifier: Apache-2.0
"""The message table as firmware/can/striker.dbc tells it, so that no test types an identifier or a state by hand."""

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


def raw(message, signal, payload):
    """A signal's count in a message's payload."""
    return MATRIX.frame_by_name(message).decode(payload)[signal].raw_value


def named(message, signal, payload):
    """The name of a signal's value in a message's payload, as "active" of a Status' state."""
    return MATRIX.frame_by_name(message).signal_by_name(signal).values[raw(message, signal, payload)]


def value(message, signal, name):
    """The count that a signal's named value stands for."""
    values = MATRIX.frame_by_name(message).signal_by_name(signal).values
    return next(count for count, known in values.items() if known == name)


def attribute(message, name):
    """A message's attribute, or its default."""
    return MATRIX.frame_by_name(message).attribute(name, db=MATRIX)
