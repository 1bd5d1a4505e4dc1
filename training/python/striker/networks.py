# SPDX-License-Identifier: Apache-2.0
"""Networks to and from the files that Striker's programs read."""

import json
import os
import struct

import numpy

from striker import _native, checks


class Network:
    """A float network from a file, with the trainer's own arithmetic: the choices are striker-evaluate's, to the bit.

    network(observation) is an action, network(observations [n, inputs]) an array of them. Cost: some microseconds each.
    `network` names one of several in the file.
    """

    def __init__(self, path, network=""):
        self._native = _native.Network(_path(path), str(network))
        self.inputs, self.actions = self._native.inputs, self._native.actions
        self.identity, self.metadata = self._native.identity, self._native.metadata

    @property
    def configuration(self):
        """The text of the configuration that it was trained with, for KickEnv(config=...); None if it holds none."""
        return self.metadata.get("configuration")

    def __call__(self, observation):
        observation = self._checked(observation, (1, 2))
        return self._native.choose_all(observation) if observation.ndim == 2 else self._native.choose(observation)

    def values(self, observation):
        """The Q value of each action."""
        return self._native.values(self._checked(observation, (1,)))

    def _checked(self, observation, dimensions):
        given = numpy.asarray(observation)
        if given.dtype.kind not in "fiu" or given.ndim not in dimensions or given.shape[-1] != self.inputs:
            raise ValueError(f"observation: {given.dtype} {given.shape}, not numbers ({self.inputs},)"
                             + (f" or (n, {self.inputs})" if 2 in dimensions else ""))
        with numpy.errstate(over="ignore"):
            values = numpy.ascontiguousarray(given, numpy.float32)
        if not numpy.isfinite(values).all():
            raise ValueError("observation: it holds NaN, or more than float32 does")
        return values


def export(state_dict, path, *, env=None, network=""):
    """Writes a PyTorch state dictionary, or any dictionary of arrays with such names ("0.weight" [64, 6], "0.bias" [64],
    "2.weight", ...), as the safetensors file that striker-evaluate, striker-export and striker-train --init read.

    Tensors become float32. Names say nothing of what is between the layers, which has to be ReLU (a policy of Stable-Baselines3's
    PPO has Tanh, if not told otherwise); an ONNX file says it, and is refused. env: the KickEnv or VectorKickEnv that it was trained in: its configuration goes into the
    file, so that no program need be told. network: which of several, as for the programs.

    What they would refuse is a RuntimeError that says what they take, and nothing is written; a link is followed, and what is
    no ordinary file stays what it is.
    """
    path = os.path.realpath(_path(path))
    if os.path.lexists(path) and not os.path.isfile(path):
        raise ValueError(f"{path}: a model is written into a file, and this is none")
    if not hasattr(state_dict, "items"):
        raise TypeError(f"state_dict {checks.shown(state_dict)}: it must be a dictionary of arrays")
    env = getattr(env, "unwrapped", env)
    if env is not None and not hasattr(env, "configuration"):
        raise TypeError(f"env {checks.shown(env)}: it must be a KickEnv or VectorKickEnv")
    metadata = {} if env is None else {"configuration": env.configuration}
    content = safetensors({str(name): _array(name, tensor) for name, tensor in state_dict.items()}, metadata)
    part = f"{path}.part"
    try:
        with open(part, "wb") as stream:
            stream.write(content)
        try:
            written = _native.Network(part, str(network))
        except RuntimeError as error:
            raise RuntimeError(str(error).replace(part, path)) from None
        if env is not None and (written.inputs, written.actions) != (env.inputs, len(env.set_points)):
            raise RuntimeError(f"{path}: the network has {written.inputs} inputs and {written.actions} actions, but its "
                               f"environment {env.inputs} and {len(env.set_points)}")
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


def _array(name, tensor):
    if hasattr(tensor, "detach"):
        try:
            tensor = tensor.detach().cpu()
            tensor = (tensor.float() if tensor.is_floating_point() else tensor).numpy()  # NumPy has no bfloat16
        except (RuntimeError, TypeError) as error:  # a sparse or quantised one, or one of another device
            raise TypeError(f"tensor {checks.shown(name)}: {error}") from None
    array = numpy.asarray(tensor)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"tensor {checks.shown(name)}: {array.dtype}, not real numbers")
    with numpy.errstate(over="ignore"):  # what becomes infinite is refused by its name
        return numpy.ascontiguousarray(array, numpy.float32).reshape(array.shape)


def _path(path):
    text = os.fsdecode(path)
    if "\0" in text:
        raise ValueError(f"path {checks.shown(text)}: no file has such a name")
    return text
