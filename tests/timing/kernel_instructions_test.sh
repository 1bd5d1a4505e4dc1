#!/bin/bash
# The kernel's instruction count on the host, by callgrind, over five sets of inputs: all the same.
# Usage: kernel_instructions_test.sh KERNEL_PROBE
set -euo pipefail

first=
for set in random zero high low mixed; do
  output=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=counted_inference "$1" "$set" 2>&1)
  count=$(sed -n 's/.*Collected *: *\([0-9]*\).*/\1/p' <<<"$output")
  echo "$set: $((count / 200)) instructions an inference"
  [[ $count -gt 200000 ]] || { echo "nothing was counted: $output" >&2; exit 1; }
  first=${first:-$count}
  [[ $count == "$first" ]] || { echo "$set: $count instructions, but random: $first" >&2; exit 1; }
done
