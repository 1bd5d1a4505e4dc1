#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The source that tells a program's version: written when the commit changes, left alone when nothing does, and without
# a hash where the repository is somebody else's.
# Usage: version_test.sh WRITE_VERSION_CMAKE
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=test GIT_AUTHOR_EMAIL=test@test GIT_COMMITTER_NAME=test \
  GIT_COMMITTER_EMAIL=test@test

# write SOURCES: the hash that the written source tells.
write() {
  cmake -D SOURCES="$1" -D VERSION=1.2.3 -D BUILD_TYPE=Release -D OUTPUT="$work/version.cpp" -P "$script"
  grep -q 'return "1.2.3";' "$work/version.cpp"
  grep -q 'return "Release";' "$work/version.cpp"
  sed -n '/git_hash/,/}/s/.*return "\(.*\)";/\1/p' "$work/version.cpp"
}

expect() { [[ $1 == "$2" ]] || { echo "$3: '$1', but expected '$2'" >&2; exit 1; }; }

script=$1
sources=$work/sources
mkdir -p "$sources/vendored"
expect "$(write "$sources")" unknown "no repository"

git -C "$sources" init -q
echo 1 >"$sources/file"
git -C "$sources" add file
git -C "$sources" commit -q -m one
git -C "$sources" tag v1
hash=$(git -C "$sources" rev-parse --short=12 HEAD)
expect "$(write "$sources")" "$hash" "a clean commit"
touch --date=2020-01-01 "$work/version.cpp"
write "$sources" >/dev/null
expect "$(stat --format=%Y "$work/version.cpp")" "$(date --date=2020-01-01 +%s)" "nothing changed: the file's time"
echo 2 >"$sources/file"
expect "$(write "$sources")" "$hash-dirty" "a changed file"
expect "$(write "$sources/vendored")" unknown "a folder of somebody else's repository"
