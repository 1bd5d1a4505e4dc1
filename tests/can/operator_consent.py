# SPDX-License-Identifier: Apache-2.0
"""An operator's side of consent in two steps, and AUTOSAR E2E Profile 2 as another library would have it: written
from the message table's manual (firmware/can/e2e.hpp), not from its code."""

import striker_dbc

DATA_ID_BASE = (0x00, 0x06, 0x09, 0x0F, 0x18, 0x1E, 0x11, 0x17, 0x21, 0x27, 0x28, 0x2E, 0x39, 0x3F, 0x30, 0x36)
MODE_COMMAND, CHALLENGE = map(striker_dbc.identifier, ("ModeCommand", "Challenge"))


def crc8h2f(data):
    """CRC-8 with polynomial 0x2F, as AUTOSAR's Crc_CalculateCRC8H2F."""
    crc = 0xFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0x2F if crc & 0x80 else crc << 1) & 0xFF
    return crc ^ 0xFF


def protect(message, payload, counter):
    """The payload with its counter and CRC."""
    data_id = DATA_ID_BASE[counter] ^ int(striker_dbc.attribute(message, "E2EDataIdList"))
    body = bytes([payload[1] & 0xF0 | counter]) + bytes(payload[2:])
    return bytes([crc8h2f(body + bytes([data_id]))]) + body


def mode_command(mode, challenge=0, counter=0):
    """A ModeCommand's payload; `mode` by its name."""
    number = striker_dbc.value("ModeCommand", "mode", mode)
    return protect("ModeCommand", bytes([0, number << 4]) + challenge.to_bytes(4, "little"), counter)


def challenge_in(payload):
    """(mode, challenge) that a controller asks to confirm."""
    return (striker_dbc.named("Challenge", "mode", payload), striker_dbc.raw("Challenge", "challenge", payload))


class Confirming:
    """Puts a controller's own challenge into the confirmations of a recorded run, each once that has come."""

    def __init__(self):
        self._challenge = 0
        self._waiting = []

    def hear(self, identifier, payload):
        """Takes note of a frame of the controller's, and hands it on."""
        if identifier == CHALLENGE:
            self._challenge = challenge_in(payload)[1]
        return identifier, payload

    def lines(self, frames):
        """What to send for a tick's slcan lines."""
        lines = []
        for line in frames.split(b"\r")[:-1]:
            identifier, payload = int(line[1:4], 16), bytes.fromhex(line[5:].decode())
            confirms = identifier == MODE_COMMAND and striker_dbc.raw("ModeCommand", "challenge", payload)
            (self._waiting if confirms else lines).append(line)
        if self._challenge and self._waiting:
            line = self._waiting.pop(0)
            payload = bytes.fromhex(line[5:].decode())[:2] + self._challenge.to_bytes(4, "little")
            lines.append(line[:5] + protect("ModeCommand", payload, payload[1] & 0xF).hex().upper().encode())
            self._challenge = 0
        return b"".join(line + b"\r" for line in lines)
