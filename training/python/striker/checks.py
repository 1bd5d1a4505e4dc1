# SPDX-License-Identifier: Apache-2.0
"""What is wrong with an argument, said with its name, its value and what it may be."""

import math
import operator

import numpy

GREATEST_SEED = 2**64 - 1


def whole(name, value, least, greatest):
    """`value` as an int, NumPy's whole numbers too; a TypeError or ValueError otherwise."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} {shown(value)}: it must be a whole number, {least} to {greatest}") from None
    if not least <= number <= greatest:
        raise ValueError(f"{name} {number}: it may be {least} to {greatest}")
    return number


def number(name, value, least, greatest):
    """`value` as a float."""
    if not hasattr(value, "__float__"):
        raise TypeError(f"{name} {shown(value)}: it must be a number, {least} to {greatest}")
    if not least <= float(value) <= greatest:
        raise ValueError(f"{name} {value}: it may be {least} to {greatest}")
    return float(value)


def one_of(name, value, choices):
    if not any(value is choice or (isinstance(value, str) and value == choice) for choice in choices):
        raise ValueError(f"{name} {shown(value)}: it may be {' or '.join(map(str, choices))}")
    return value


def function(name, value):
    """A callable or None."""
    if value is not None and not callable(value):
        raise TypeError(f"{name} {shown(value)}: it must be a function of one record, or None")
    return value


def reward(value):
    """What a reward_function returned, as a float: a forgotten return is no reward."""
    if not hasattr(value, "__float__") or isinstance(value, str):
        raise TypeError(f"reward_function returned {shown(value)}: a reward is a number")
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"reward_function returned {number}: a reward is finite")
    return number


def rewards(values, worlds):
    """What a reward_function of many worlds returned, as an array."""
    array = numpy.asarray(values)
    if array.dtype.kind not in "fiub" or array.shape != (worlds,):
        raise TypeError(f"reward_function returned {array.dtype} {array.shape}: rewards are numbers ({worlds},)")
    if not numpy.isfinite(array).all():
        raise ValueError(f"reward_function returned {shown(array[~numpy.isfinite(array)][0])} for world "
                         f"{numpy.flatnonzero(~numpy.isfinite(array))[0]}: a reward is finite")
    return array


def episode_of(options, otherwise, greatest):
    """options["episode"], the one option that a reset has."""
    options = {} if options is None else options
    if not isinstance(options, dict) or not set(options) <= {"episode"}:
        raise ValueError(f"options {shown(options)}: it may be a dictionary that holds 'episode'")
    return whole("options['episode']", options.get("episode", otherwise), 0, greatest)


def shown(value):
    """Not longer than one reads."""
    text = repr(value)
    return text if len(text) <= 80 else text[:77] + "..."
