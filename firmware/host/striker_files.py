# SPDX-License-Identifier: Apache-2.0
"""Result files of Python programs, with the promises of atomic_file.hpp: there whole or not at all, and what is no
regular file (/dev/null, a FIFO) is written into as it is."""

import errno
import os
import stat

HEAD_BYTES = 512


def write_whole(file, content, mark=b""):
    """Makes FILE of these bytes, or OSError: written as FILE.part beside it, and renamed. What was there keeps its owner
    and mode; a symbolic link stays one, and the file that it points to is replaced.

    mark: stands early in every file of this kind. A FILE that is there, not empty and without it, is something else's,
    as the input of this very program, and stays as it is.
    """
    if os.path.exists(file) and not os.path.isfile(file):
        with open(file, "wb") as stream:
            stream.write(content)
        return
    target = os.path.realpath(file)
    before = require_own(target, mark)
    part = f"{target}.part"
    try:
        with open(part, "wb") as stream:
            if before is not None:
                keep_owner_and_mode(stream.fileno(), before)
            stream.write(content)
        os.replace(part, target)
    except OSError:
        if os.path.isfile(part):
            os.remove(part)
        raise


def require_own(file, mark):
    """Its os.stat_result, None if there is no such file; OSError for one that is not empty and has no mark."""
    if not os.path.exists(file):
        return None
    with open(file, "rb") as stream:
        head = stream.read(HEAD_BYTES)
        if head and mark not in head:
            raise OSError(errno.EEXIST, "is there and is no earlier result of this kind", file)
        return os.fstat(stream.fileno())


def keep_owner_and_mode(handle, before):
    """Only who may give files away can keep the owner; the others' new file is their own, as every file of theirs."""
    try:
        os.fchown(handle, before.st_uid, before.st_gid)
    except PermissionError:
        pass
    os.fchmod(handle, stat.S_IMODE(before.st_mode))
