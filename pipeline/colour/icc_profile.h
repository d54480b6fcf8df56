// SPDX-License-Identifier: Apache-2.0
//
// ICC profiles: what the numbers of a picture for a display mean, for programs that know nothing else.

#pragma once

#include <string>
#include <vector>

namespace lensplane {

/// The profile (version 4, three primaries and one curve) of the colour space with this colorInteropID; empty
/// where there is none that we know, it is linear, or its curve cannot be said so (PQ).
std::vector<unsigned char> icc_profile(const std::string& interop_id);

}  // namespace lensplane
