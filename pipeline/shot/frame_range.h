// SPDX-License-Identifier: Apache-2.0
//
// Frame ranges: "1001-1048", "1001-1100x2", "1001,1005,1010-1020".

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lensplane {

inline constexpr int kMaxFrame = 9'999'999;
inline constexpr std::size_t kMaxFrames = 1'000'000;

/// The frames, ascending and each once, or what is wrong with the text.
struct ParsedFrames {
  std::vector<int> frames;
  std::string error;  // empty when the frames are good
};

ParsedFrames parse_frames(std::string_view text);

}  // namespace lensplane
