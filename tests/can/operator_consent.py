# SPDX-License-Identifier: Apache-2.0
"""An operator's side of consent in two steps, and AUTOSAR E2E Profile 2 as another library would have it: written
from the message table's manual (firmware/can/e2e.hpp), not from its code."""

import striker_dbc

DATA_ID_BASE = (0x00, 0x06, 0x09, 0x0F, 0x18, 0x1E, 0x11, 0x17, 0x21, 0x27, 0x28, 0x2E, 0x39, 0x3F, 0x30, 0x36)
MODE_COMMAND, CHALLENGE, STATUS = map(striker_dbc.identifier, ("ModeCommand", "Challenge", "Status"))


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


class Operator:
    """The operator of a recorded run, in front of another controller: asks to arm from the tick on in which the recorded
    one does, confirms every challenge, and goes on until the controller is active. Who only repeats the recorded frames
    arms nothing, and who asks once arms nothing where a host's stall has made the pictures old in that very tick."""

    ASK_EVERY_TICKS = 10

    def __init__(self):
        self._arming = False
        self._challenge = None
        self._counter = 0
        self._pause_ticks = 0

    def hear(self, identifier, payload):
        """Takes note of a frame of the controller's, and hands it on."""
        if identifier == CHALLENGE:
            self._challenge = challenge_in(payload)
        elif identifier == STATUS and striker_dbc.named("Status", "state", payload) == "active":
            self._arming = False
        return identifier, payload

    def lines(self, frames):
        """What to send for a tick's slcan lines: the operator's own in place of the recorded one's."""
        lines = []
        for line in frames.split(b"\r")[:-1]:
            arms = int(line[1:4], 16) == MODE_COMMAND and striker_dbc.named(
                "ModeCommand", "mode", bytes.fromhex(line[5:].decode())) == "arm"
            self._arming |= arms
            if not arms:
                lines.append(line)
        self._pause_ticks -= 1
        if self._arming and self._challenge:
            lines.append(self._line(*self._challenge))
            self._challenge = None
        elif self._arming and self._pause_ticks < 0:
            lines.append(self._line("arm", 0))
            self._pause_ticks = self.ASK_EVERY_TICKS
        return b"".join(line + b"\r" for line in lines)

    def _line(self, mode, challenge):
        self._counter = (self._counter + 1) % 16
        payload = mode_command(mode, challenge, self._counter)
        return f"t{MODE_COMMAND:03X}{len(payload)}{payload.hex().upper()}".encode()
