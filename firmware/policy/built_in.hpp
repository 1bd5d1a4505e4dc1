// SPDX-License-Identifier: Apache-2.0
// The policy that this build puts into the controller's programs and images.
//
// The build chooses it: STRIKER_POLICY_HEADER is the path of an exported header, as a string, and
// STRIKER_POLICY_NAME the name of the policy in it. Code that is given its policy as a parameter
// (Pilot<policy>, infer<policy>) does not need this header.
#pragma once

#include STRIKER_POLICY_HEADER

namespace striker::policy {

inline constexpr const auto& built_in = STRIKER_POLICY_NAME;

}  // namespace striker::policy
