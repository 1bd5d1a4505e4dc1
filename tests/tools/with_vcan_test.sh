#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# tools/with-vcan: whatever the kernel has, a command runs as if called directly, with a vcan0, and nothing is left.
# Exits with 0 if all holds, else names what does not.
set -euo pipefail

with_vcan=$(realpath "${BASH_SOURCE[0]%/*}/../../tools/with-vcan")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/tmp" "$work/home" "$work/a folder"
failures=0

# A temporary folder, a home and a mark of its own show what a run leaves.
run=(env MARK="$work" TMPDIR="$work/tmp" HOME="$work/home" "$with_vcan" --quiet)

# check NAME COMMAND...: the command must succeed.
check() {
  local name=$1
  shift
  if "$@"; then
    echo "ok      $name"
  else
    echo "FAILED  $name"
    failures=$((failures + 1))
  fi
}

# Runs a command, keeps what it prints in the files out and err, and prints its status.
status_of() {
  local status=0
  "$@" >"$work/out" 2>"$work/err" || status=$?
  echo "$status"
}

marked_processes() { grep -lzxs "MARK=$work" /proc/[1-9]*/environ || true; }
nothing_left() { [[ -z $(ls -A "$work/tmp") && -z $(ls -A "$work/home") && -z $(marked_processes) ]]; }

check "status 0" test "$(status_of "${run[@]}" true)" = 0
check "status 7" test "$(status_of "${run[@]}" bash -c 'exit 7')" = 7
check "status of a command that does not exist" test "$(status_of "${run[@]}" no-such-command)" = 127
check "status of wrong use" test "$(status_of "${run[@]}" --memory little true)" = 2

head -c 3000000 /dev/urandom | base64 >"$work/text"
head -c 3000000 /dev/urandom >"$work/bytes"
status_of "${run[@]}" bash -c 'cat "$1" & cat "$2" >&2; wait' - "$work/text" "$work/bytes" >"$work/status"
check "standard output to the byte" cmp "$work/out" "$work/text"
check "standard error to the byte" cmp "$work/err" "$work/bytes"

words=(plain 'two words' "it's" '"quoted"' $'new\nline' '' '$HOME' 'a=b' 'back\slash' '*')
check "arguments" cmp <("${run[@]}" printf '<%s>' "${words[@]}") <(printf '<%s>' "${words[@]}")

export STRIKER_TEST=$'a "value"\n of two lines '
say() { printf '%s' "$1"; }
export -f say
cd "$work/a folder"
"${run[@]}" bash -c 'pwd; say "$STRIKER_TEST"; echo hello >file; ip -brief link show up dev vcan0 >link' >../out
check "directory and environment" cmp ../out <(pwd && say "$STRIKER_TEST")
check "files it writes are there" test "$(<file)" = hello
check "vcan0 is up" grep -q vcan0 link

"${run[@]}" bash -c 'trap "echo caught; exit 9" TERM; : >started; while true; do sleep 0.1; done' >../out 2>../err &
until [[ -e started ]]; do sleep 0.1; done
check "processes are found by their mark" test -n "$(marked_processes)"
kill -s TERM $!
wait $! && status=0 || status=$?
check "SIGTERM is passed on" test "$status $(<../out)" = "9 caught"

# A socket whose other end gives everything back.
with_line() {
  /usr/bin/python3 -c '
import os, socket, subprocess, sys, threading
here, there = socket.socketpair()
os.dup2(there.fileno(), 21)
def give_back():
    while letters := here.recv(4096):
        here.sendall(letters)
threading.Thread(target=give_back, daemon=True).start()
sys.exit(subprocess.run(sys.argv[1:], pass_fds=[21]).returncode)' "$@"
}
# All bytes, those that a terminal might take for itself too.
printf '%b' "$(printf '\\x%02x' {0..255})" >letters
for _ in {1..40}; do cat letters; done >sent
check "a serial line leads out and back" cmp sent <(with_line "${run[@]}" --line 21 bash -c 'cat sent >&21 & head -c 10240 <&21')
check "a line that is not open is wrong use" test "$(status_of "${run[@]}" --line 77 true)" = 2
check "a line of the guest's own is wrong use" test "$(status_of "${run[@]}" --line 1 true)" = 2

check "SIGTERM before the command starts" test "$(status_of timeout 0.3 "${run[@]}" sleep 60)" = 124
check "a reader that goes away ends it" test "$("${run[@]}" yes | head -n 1)" = y
check "inside itself" test "$(status_of "${run[@]}" "$with_vcan" bash -c 'exit 7')" = 7
check "nothing is left" nothing_left

echo "$failures failed"
((failures == 0))
