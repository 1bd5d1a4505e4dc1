#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Compiles the firmware's parts (policy, core, can, safety, loop) freestanding, for x86-64 and Cortex-M0+, and reads the objects' undefined
# symbols: none of an allocator, of floating point, of libm or of exceptions.
# Usage: freestanding_test.sh SOURCE_DIRECTORY POLICY_HEADER
set -euo pipefail

source_dir=$1
policy=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The name that an exported header gives its policy.
policy_name() { sed -nE 's/^inline constexpr Policy[13]?<[^>]*> ([a-z_0-9]+) = .*/\1/p' "$1"; }

flags=(-std=c++20 -O2 -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -Wall -Wextra -Werror
  -I "$source_dir" "-DSTRIKER_POLICY_HEADER=\"$policy\"" "-DSTRIKER_POLICY_NAME=$(policy_name "$policy")")

# malloc and its family, operator new and delete, exceptions, soft-float helpers, libm.
forbidden='^(malloc|calloc|realloc|free|_Zn[wa].*|_Zd[la].*|__cxa_.*|_Unwind_.*|__gxx_personality.*'
forbidden+='|__aeabi_[cfd](f|d|add|sub|mul|div|cmp|2|r).*|__aeabi_(u?[il]2[fd]|f2.*|d2.*)|__(add|sub|mul|div|float|fix|ext|trunc).*[sdt]f.*'
forbidden+='|(sin|cos|tan|atan2?|sqrt|pow|exp|log|floor|ceil|l?l?round|fmod|hypot)[fl]?)$'

check() {
  local name=$1 nm=$2
  shift 2
  mkdir "$work/$name"
  local file object
  while IFS= read -r file; do
    object=$work/$name/$(basename "$file" .cpp).o
    "$@" "${flags[@]}" -c "$file" -o "$object"
  done < <(find "$source_dir"/firmware/{policy,core,can,safety,loop} -name '*.cpp')
  local found
  found=$("$nm" -u "$work/$name"/*.o | awk '/ U /{print $2}' | sort -u | grep -E "$forbidden" || true)
  if [[ -n $found ]]; then
    echo "$name: forbidden symbols: $found" >&2
    return 1
  fi
  echo "$name: $(find "$work/$name" -name '*.o' | wc -l) objects, no forbidden symbol"
}

# The check must be able to see what it looks for.
echo 'float f(float a, float b) { return a * b; } int* g() { return new int(3); }' >"$work/probe.cpp"
arm-none-eabi-g++ -mcpu=cortex-m0plus -mthumb -O2 -c "$work/probe.cpp" -o "$work/probe.o"
seen=$(arm-none-eabi-nm -u "$work/probe.o" | awk '/ U /{print $2}' | grep -cE "$forbidden")
[[ $seen == 2 ]] || { echo "the check saw $seen of 2 forbidden symbols in its probe" >&2; exit 1; }

check x86-64 nm g++
check cortex-m0plus arm-none-eabi-nm arm-none-eabi-g++ -mcpu=cortex-m0plus -mthumb
