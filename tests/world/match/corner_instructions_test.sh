#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Instructions a step of ten robots that press into one corner. 1.4 million of them took 0.16 ms, 60 times real time
# at 10 ms; the exact solver takes 70 million. The limit keeps a factor of 10 in hand on any core that runs 3 a
# nanosecond, and of 3 on one that runs 1.
# Usage: corner_instructions_test.sh CORNER_PROBE LIMIT
set -euo pipefail

output=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=counted_corner "$1" 2>&1)
count=$(sed -n 's/.*Collected *: *\([0-9]*\).*/\1/p' <<<"$output")
echo "$((count / 100)) instructions a step"
[[ $count -gt 1000000 ]] || { echo "nothing was counted: $output" >&2; exit 1; }
[[ $((count / 100)) -le $2 ]] || { echo "the limit is $2" >&2; exit 1; }
