// SPDX-License-Identifier: Apache-2.0
// The policy that this build puts into the controller's programs and images.
//
// The build chooses it: STRIKER_POLICY_HEADER is the path of an exported header, as a string, and
// STRIKER_POLICY_NAME the name of the policy in it, which other policies may have too: identities tell them apart.
// Code that is given its policy as a parameter (Pilot<policy>, infer<policy>) does not need this header.
#pragma once

#include STRIKER_POLICY_HEADER

namespace striker::policy {

inline constexpr const auto& built_in = STRIKER_POLICY_NAME;

#define STRIKER_TEXT_OF(name) #name
#define STRIKER_TEXT_OF_VALUE(name) STRIKER_TEXT_OF(name)
inline constexpr const char* built_in_name = STRIKER_TEXT_OF_VALUE(STRIKER_POLICY_NAME);
#undef STRIKER_TEXT_OF_VALUE
#undef STRIKER_TEXT_OF

}  // namespace striker::policy
