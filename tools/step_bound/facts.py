# SPDX-License-Identifier: Apache-2.0
"""Flow facts: what the machine code alone does not show, by name, each with the test that proves it.

    [one-inference]                       # a name that reports and tests use
    calls = ["infer"]                     # chains of calls, all of them together (one that stands here twice counts double): "A > B": B called by A; "A >> B": B somewhere
                                          # below A; "f<*T*>" with a template's arguments
    at_most = 1                           # in one call of the root; a number, or a parameter such as "frames"
    because = "..."
    proved_by = "StepFacts.OneInference"  # a test; "trace", `because` and every traced step; "argument", `because` alone; or "assumed",
                                          # of a device: told with the bound

`plus`, chains too, lets there be one more for each call of them (two where one stands twice). With `contexts` the number is for each calling
context by itself, and the image has to have exactly so many of them. Instead of `calls`: `loop`, a function whose loop the analysis could not count runs its body at most so often for one entry into it;
with `loops` so many loops of that function, each (one, unless told: a loop of another function that the compiler put there would get its number, and is refused);
`turns`, all loops of a function that the analysis could not count go back at most so often in one call, together; `back`, each irreducible part of a function goes back at most so often in one call (a list: one number for each part); `word`, a function, `offset` bytes behind whose first argument a
word has the value `at_most`, all the time. `when` names a parameter: the fact is left out where that is 0. `image_with` names a function, as chains do: it is left out where the
root never calls that. With `more` each call of `plus` allows so many more.
"""

import fnmatch
import re
import tomllib
from dataclasses import dataclass

from .functions import plain_name, short_name
from .refusal import Refusal

KINDS = ("calls", "loop", "turns", "back", "word")
FIELDS = {"at_most", "because", "proved_by"}
OPTIONAL = {"plus", "more", "offset", "when", "contexts", "image_with", "loops"}
NUMBERS = {"offset": 0, "contexts": 0, "more": 1, "loops": 1}  # that may be left out
CHAIN = re.compile(r"\S[^>]*( >>? \S[^>]*)*|.*<.*")


@dataclass(eq=False)
class Fact:
    name: str
    kind: str
    chains: list   # of patterns
    at_most: int   # or one for each irreducible part
    plus: list     # of patterns
    because: str
    proved_by: str
    offset: int = 0
    contexts: int = 0  # each by itself
    more: int = 1
    image_with: str = ""
    loops: int = 1     # of one function, for `loop`

    def covers(self, chain):
        """How often a chain of functions' names, from the root, is among those meant: each counts."""
        return sum(matches(pattern, chain) for pattern in self.chains)

    def back_of(self, part, parts):
        """How often an irreducible part, of so many, goes back at most."""
        if isinstance(self.at_most, int):
            return self.at_most
        if len(self.at_most) != parts:
            raise Refusal(f"the fact [{self.name}] is for {len(self.at_most)} irreducible parts, but there are {parts}")
        return self.at_most[part]

    def allows_more(self, chain):
        """How many more a call of such a chain allows: each pattern one, or `more`."""
        return self.more * sum(matches(pattern, chain) for pattern in self.plus)


def matches(pattern, chain):
    """`pattern`: (name, whether the function before it calls it itself), from the first to the last."""
    name, direct = pattern[-1]
    if not chain or not is_named(chain[-1], name):
        return False
    if len(pattern) == 1:
        return True
    return matches(pattern[:-1], chain[:-1]) or not direct and any(
        matches(pattern[:-1], chain[:end]) for end in range(1, len(chain) - 1))


def is_named(function, pattern):
    return fnmatch.fnmatchcase(plain_name(function), pattern) if "<" in pattern else short_name(function) == pattern


def parse_chains(value):
    return [parse_chain(chain) for chain in ([value] if isinstance(value, str) else value)]


def parse_chain(text):
    names, pattern = re.split(r"\s+(>>?)\s+", text.strip()), []
    for at in range(0, len(names), 2):
        pattern.append((names[at], at > 0 and names[at - 1] == ">"))
    return pattern


def read_facts(path, parameters):
    """Of a TOML file; `parameters` are numbers by name."""
    try:
        with open(path, "rb") as file:
            table = tomllib.load(file)
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise Refusal(f"{path}: {error}") from error
    facts = [_fact(path, name, fields, parameters) for name, fields in table.items()]
    return [fact for fact, fields in zip(facts, table.values()) if parameters.get(fields.get("when"), 1)]


def _fact(path, name, fields, parameters):
    kinds = [kind for kind in KINDS if kind in fields]
    unknown = set(fields) - FIELDS - OPTIONAL - set(KINDS)
    if len(kinds) != 1 or unknown or FIELDS - set(fields):
        raise Refusal(f"{path}: [{name}]: one of {', '.join(KINDS)}, and {', '.join(sorted(FIELDS))}, but not "
                      f"{', '.join(sorted(unknown)) or 'less'}")
    at_most = fields["at_most"]
    if isinstance(at_most, str):
        if at_most not in parameters:
            raise Refusal(f"{path}: [{name}]: at_most = '{at_most}' is no number, and none of {', '.join(parameters)}")
        at_most = parameters[at_most]
    _require_values(path, name, kinds[0], {**NUMBERS, **fields, "at_most": at_most})
    if fields.get("when", "frames") not in parameters:
        raise Refusal(f"{path}: [{name}]: when = '{fields['when']}' is none of {', '.join(parameters)}")
    return Fact(name, kinds[0], parse_chains(fields[kinds[0]]), at_most, parse_chains(fields.get("plus", [])),
                fields["because"], fields["proved_by"], image_with=fields.get("image_with", ""),
                **{field: fields.get(field, number) for field, number in NUMBERS.items()})


def _require_values(path, name, kind, fields):
    """Each of its type: a number that is negative or no whole one would make a bound of anything."""
    for field in ("at_most", *NUMBERS):
        values = fields[field] if isinstance(fields[field], list) and field == "at_most" and kind == "back" else [fields[field]]
        if not all(type(value) is int and 0 <= value <= 0xFFFFFFFF for value in values):
            raise Refusal(f"{path}: [{name}]: {field} = {fields[field]} is no whole number from 0 to 2^32 - 1")
    for field in (kind, "plus"):
        chains = fields.get(field, [])
        chains = [chains] if isinstance(chains, str) else chains
        if not isinstance(chains, list) or not all(isinstance(chain, str) and CHAIN.fullmatch(chain) for chain in chains):
            raise Refusal(f"{path}: [{name}]: {field} = {chains} is no chain of functions")
