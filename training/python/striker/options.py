# SPDX-License-Identifier: Apache-2.0
"""Keywords as the lines of TOML that a training configuration is changed by: its own reader checks them."""

import json
import os

from striker import _native

# Of [task] in training/configs/paper.toml, which says what each means, and its default.
TASK_KEYS = ("kind", "world", "pose", "velocities", "equations", "inputs", "dummies", "mirrored", "actions")
# Tables that have a keyword of their own, which takes a dictionary.
TABLES = ("ball", "reward", "robot")


def toml_value(value):
    """`value` as TOML writes it: what is neither truth, number, text nor a list of those is refused."""
    if hasattr(value, "tolist"):
        value = value.tolist()  # NumPy's
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(element) for element in value) + "]"
    if isinstance(value, (bool, int, float, str)):
        return json.dumps(value) if not isinstance(value, float) else repr(value)
    raise TypeError(f"{value!r}: an option is a bool, a number, a str, or a list of those")


def tasks_of(config=None, **options):
    """The tasks that a configuration file (or the defaults) and these options describe."""
    changes, text, path, robot = [], "", config, None
    if not isinstance(config, (str, os.PathLike, type(None))):
        raise TypeError(f"config {config!r}: it must be the path or the text of a training configuration")
    if isinstance(config, str) and "\n" in config:
        text, path = config, None
    for name, value in options.items():
        if value is None:
            continue
        if name in TASK_KEYS:
            changes.append(f"task.{name}={toml_value(value)}")
        elif name == "robot" and isinstance(value, (str, os.PathLike)):
            robot = os.fspath(value)
        elif name in TABLES:
            if not isinstance(value, dict):
                raise TypeError(f"{name} {value!r}: it must be a dictionary{' or a path' if name == 'robot' else ''}")
            changes += [f"{name}.{key}={toml_value(inner)}" for key, inner in value.items()]
        else:
            raise TypeError(f"{name} is no option of a kick: {', '.join(TASK_KEYS + TABLES)} and config are")
    return _native.Tasks(path, text, robot, changes)
