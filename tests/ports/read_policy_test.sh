#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A run of the simulator with a policy that it read from its header, and the same policy compiled: frame by frame alike.
# Usage: read_policy_test.sh STRIKER_SIL RECORD_RUN HEADER COMPILED_CHECK
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" kick --bus inproc --policy "$3" --episodes 3 --seed 5 --pose anywhere --log "$work/run.log" >/dev/null
"$2" "$work/run.log" "$work/run.rec"
"$4" recording "$work/run.rec"
# It is able to differ: another policy's run is not this one's.
"$1" kick --bus inproc --episodes 3 --seed 5 --pose anywhere --log "$work/other.log" >/dev/null
"$2" "$work/other.log" "$work/other.rec"
if "$4" recording "$work/other.rec" >/dev/null; then
  echo "the built-in policy's run passed for this one's" >&2
  exit 1
fi
