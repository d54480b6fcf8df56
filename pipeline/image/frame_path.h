// SPDX-License-Identifier: Apache-2.0
//
// Names of files in numbered sequences: `bg.####.exr` or `bg.%04d.exr`.

#pragma once

#include <string>
#include <vector>

namespace lensplane {

/// Whether the pattern stands for a numbered sequence.
bool is_sequence(const std::string& pattern);

/// The file of one frame. In the file's own name the last run of # (padding: their number) or the %0Nd is
/// replaced; a pattern with neither comes back as it is. Numbers longer than the padding are written in full.
std::string path_of_frame(const std::string& pattern, int frame);

/// The frames of a sequence that there are, ascending; none when its folder cannot be read.
std::vector<int> frames_on_disk(const std::string& pattern);

}  // namespace lensplane
