#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A policy header that was altered, or that could overflow, does not compile, and the compiler says why.
# Usage: altered_header_test.sh SOURCE_DIRECTORY POLICY_HEADER
set -euo pipefail

source_dir=$1
policy=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The name that an exported header gives its policy.
policy_name() { sed -nE 's/^inline constexpr Policy[13]?<[^>]*> ([a-z_0-9]+) = .*/\1/p' "$1"; }

compile() {
  g++ -std=c++20 -fsyntax-only -I "$source_dir" "-DSTRIKER_POLICY_HEADER=\"$1\"" "-DSTRIKER_POLICY_NAME=$(policy_name "$1")" \
    "$source_dir/firmware/loop/built_in_node.cpp" 2>&1
}

# expect_refusal NAME SED_SCRIPT MESSAGE
expect_refusal() {
  local header=$work/$1.hpp output
  sed -E "$2" "$policy" >"$header"
  if cmp -s "$policy" "$header"; then
    echo "$1: the alteration changed nothing" >&2
    exit 1
  fi
  if output=$(compile "$header"); then
    echo "$1: the altered header compiled" >&2
    exit 1
  fi
  if ! grep -q "STRIKER POLICY: $3" <<<"$output"; then
    echo "$1: no readable reason in: $output" >&2
    exit 1
  fi
  echo "$1: refused"
}

compile "$policy" || { echo "the policy itself does not compile" >&2; exit 1; }
altered="the header was altered after its export"
expect_refusal identity 's/(\.identity = 0x)(.)/\1F\2/; s/(\.identity = 0x..)[0-9A-F]{7}U/\1000000U/' "$altered"
expect_refusal one_weight '0,/\.output/!{0,/\{\{(-?[0-9]+), /s//{{1, /}' "$altered"
expect_refusal set_point 's/2550/2500/' "$altered"
expect_refusal too_fast 's/2550/2551/' "an action goes beyond the robot's top speed"
expect_refusal overflow '0,/\.biases = \{\{[^0-9-]*-?[0-9]+/s//.biases = {{2147483647/' "a 32-bit sum could overflow"
expect_refusal period 's/(decision_period_ms = )50/\1100/' "trained at another decision period"
expect_refusal golden_vector '/golden_vectors/,$s/(\.sums = \{\{-?)/\11/' "$altered"
expect_refusal shift '/input_scales/,/layer1/s/\.shift = [0-9]+/.shift = 0/' "a shift, a multiplier or the period is out of range"
