# SPDX-License-Identifier: Apache-2.0
"""A linked image: its function symbols, and the bytes that do not change while it runs."""

import re
import subprocess

from elftools.common.exceptions import ELFError
from elftools.elf.elffile import ELFFile

from .refusal import Refusal

DAMAGED = (ELFError, AttributeError, IndexError, KeyError, TypeError, ValueError)  # what pyelftools ends with
WRITABLE, ALLOCATED, PLAIN = 1, 2, "SHT_PROGBITS"
FUNCTION, OBJECT, UNTYPED = "STT_FUNC", "STT_OBJECT", "STT_NOTYPE"


def binutils(program, path, *options):
    """What a program of arm-none-eabi tells of an image."""
    try:
        done = subprocess.run([f"arm-none-eabi-{program}", *options, path], check=False, capture_output=True, text=True, errors="replace")
    except OSError as error:
        raise Refusal(f"arm-none-eabi-{program}: {error.strerror}: tools/setup installs it") from error
    if done.returncode:
        raise Refusal(f"{path}: {program} refuses it: {done.stderr.strip()}")
    return done.stdout


class Image:
    def __init__(self, path):
        self.path = path
        try:
            with open(path, "rb") as file:
                self._read(ELFFile(file))
        except (OSError, *DAMAGED) as error:
            raise Refusal(f"{path}: no ELF image that can be read: {error}") from error

    def _read(self, elf):
        if elf["e_machine"] != "EM_ARM":
            raise Refusal(f"{self.path}: not for an Arm processor: {elf['e_machine']}")
        if elf["e_type"] != "ET_EXEC" or not elf.little_endian:
            raise Refusal(f"{self.path}: {elf['e_type']}, {'little' if elf.little_endian else 'big'} endian: it takes a linked image, little endian")
        self.constants = [(s["sh_addr"], s.data()) for s in elf.iter_sections()
                          if s["sh_type"] == PLAIN and s["sh_flags"] & ALLOCATED and not s["sh_flags"] & WRITABLE]
        table = elf.get_section_by_name(".symtab")
        if table is None:
            raise Refusal(f"{self.path}: no symbols: link it without --strip-all")
        self.functions, self.labels, self.objects = [], [], []  # (mangled name, address, size), (name, address) of both others
        self.sized_objects = []  # (mangled name, address, size)
        self.all_symbols = []    # (mangled name, address)
        for symbol in table.iter_symbols():
            if symbol["st_shndx"] == "SHN_UNDEF":
                continue
            address = symbol["st_value"] & ~1
            self.all_symbols.append((symbol.name, address))
            if symbol["st_info"]["type"] == FUNCTION:
                self.functions.append((symbol.name, address, symbol["st_size"]))
            elif symbol["st_info"]["type"] == OBJECT:
                self.objects.append((symbol.name, symbol["st_value"]))
                self.sized_objects.append((symbol.name, symbol["st_value"], symbol["st_size"]))
            elif symbol["st_info"]["type"] == UNTYPED and symbol.name and not symbol.name.startswith("$"):
                self.labels.append((symbol.name, address))
        attributes = binutils("readelf", self.path, "-A")
        architecture = re.search(r"Tag_CPU_arch: (\S+)", attributes)
        self.architecture = architecture[1] if architecture else "none"
        self.is_armv8_1m = "v8.1-M" in self.architecture
        self.has_vectors = "-M" in self.architecture or "profile: Microcontroller" in attributes

    def object(self, mangled_pattern):
        """The address of the one object whose mangled name matches, or None."""
        found = {address for name, address in self.objects if re.search(mangled_pattern, name)}
        return found.pop() if len(found) == 1 else None

    def bytes_at(self, address, size):
        """Constant bytes, or None where the image may write."""
        for start, data in self.constants:
            if start <= address and address + size <= start + len(data):
                return data[address - start:address - start + size]
        return None

    def constant(self, address, size=4, signed=False):
        data = self.bytes_at(address, size)
        return None if data is None else int.from_bytes(data, "little", signed=signed) & 0xFFFFFFFF
