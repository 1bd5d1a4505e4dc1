#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The kernel's instruction count on the host, by callgrind, over five sets of inputs: all the same.
# With a limit, not more than that for 6-64-64-3; for other networks in proportion, and a quarter more.
# Usage: kernel_instructions_test.sh KERNEL_PROBE [LIMIT]
set -euo pipefail

first=
for set in random zero high low mixed; do
  output=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=counted_inference "$1" "$set" 2>&1)
  count=$(sed -n 's/.*Collected *: *\([0-9]*\).*/\1/p' <<<"$output")
  echo "$set: $((count / 200)) instructions an inference"
  [[ $count -gt 20000 ]] || { echo "nothing was counted: $output" >&2; exit 1; }
  first=${first:-$count}
  [[ $count == "$first" ]] || { echo "$set: $count instructions, but random: $first" >&2; exit 1; }
done
if [[ $# -gt 1 ]]; then
  macs=$("$1" macs)
  limit=$2
  [[ $macs == 4672 ]] || limit=$((limit * macs * 5 / (4672 * 4)))
  [[ $((first / 200)) -le $limit ]] || { echo "$((first / 200)) instructions, but the limit is $limit" >&2; exit 1; }
fi
