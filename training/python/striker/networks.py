# SPDX-License-Identifier: Apache-2.0
"""Networks to and from the files that Striker's programs read."""

import json
import os
import struct
import tempfile

import numpy

from striker import _native


class Network:
    """A float network from a file, with the trainer's own arithmetic: the choices are striker-evaluate's, to the bit.

    network(observation) is an action, network(observations [n, inputs]) an array of them. Cost: some microseconds each.
    `network` names one of several in the file.
    """

    def __init__(self, path, network=""):
        self._native = _native.Network(os.fspath(path), network)
        self.inputs, self.actions = self._native.inputs, self._native.actions
        self.identity, self.metadata = self._native.identity, self._native.metadata

    @property
    def configuration(self):
        """The text of the configuration that it was trained with, for KickEnv(config=...); None if it holds none."""
        return self.metadata.get("configuration")

    def __call__(self, observation):
        observation = numpy.ascontiguousarray(observation, numpy.float32)
        return self._native.choose_all(observation) if observation.ndim == 2 else self._native.choose(observation)

    def values(self, observation):
        """The Q value of each action."""
        return self._native.values(numpy.ascontiguousarray(observation, numpy.float32))


def export(state_dict, path, *, env=None, network=""):
    """Writes a PyTorch state dictionary, or any dictionary of arrays with such names ("0.weight" [64, 6], "0.bias" [64],
    "2.weight", ...), as the safetensors file that striker-evaluate, striker-export and striker-train --init read.

    Tensors become float32. env: the KickEnv or VectorKickEnv that it was trained in: its configuration goes into the
    file, so that no program need be told. network: which of several, as for the programs.

    What they would refuse is a RuntimeError that says what they take, and nothing is written.
    """
    path = os.fspath(path)
    metadata = {} if env is None else {"configuration": env.configuration}
    content = safetensors({name: _array(tensor) for name, tensor in state_dict.items()}, metadata)
    with tempfile.NamedTemporaryFile(suffix=".safetensors") as checked:
        checked.write(content)
        checked.flush()
        try:
            _native.Network(checked.name, network)
        except RuntimeError as error:
            raise RuntimeError(str(error).replace(checked.name, path)) from None
    _write_whole(path, content)


def _write_whole(path, content):
    """A symbolic link stays one, and what is no regular file is written into as it is."""
    if os.path.exists(path) and not os.path.isfile(path):
        with open(path, "wb") as stream:
            stream.write(content)
        return
    path = os.path.realpath(path)
    part = f"{path}.part"
    try:
        with open(part, "wb") as stream:
            stream.write(content)
        os.replace(part, path)
    finally:
        if os.path.isfile(part):
            os.remove(part)


def safetensors(tensors, metadata):
    """The bytes of a safetensors file, of float32 arrays and a dictionary of text."""
    header, data = {"__metadata__": metadata}, b""
    for name, tensor in tensors.items():
        raw = tensor.astype("<f4").tobytes()
        header[name] = {"dtype": "F32", "shape": list(tensor.shape), "data_offsets": [len(data), len(data) + len(raw)]}
        data += raw
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 8)
    return struct.pack("<Q", len(text)) + text + data


def _array(tensor):
    if hasattr(tensor, "detach"):
        tensor = tensor.detach().cpu().numpy()
    return numpy.ascontiguousarray(tensor, numpy.float32)
