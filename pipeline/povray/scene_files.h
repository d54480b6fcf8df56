// SPDX-License-Identifier: Apache-2.0
//
// What can be known of a POV-Ray scene without rendering it: the files that it is made of, and whether it is
// written so that its picture can be used.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lensplane {

/// A scene's text and files, as far as they are named.
struct SceneFiles {
  std::vector<std::filesystem::path> files;  // the scene, what it includes, and images beside it; sorted
  std::string code;  // of the scene and what it includes, without comments and without the texts in quotes
  bool complete = true;  // false: it includes files whose names it makes up itself

  /// Does the scene say this word anywhere?
  bool says(const std::string& word) const;
};

/// Reads a scene and, beside it, what it includes; files that POV-Ray brings itself are left out. Throws
/// Failure (BadInput) when the scene is missing, does not say `#version 3.7` and `assumed_gamma 1.0`, without
/// which its numbers are not light, or does not use `lensplane_camera`.
SceneFiles read_scene_files(const std::filesystem::path& scene);

/// A POV-Ray source text without comments, and the texts in quotes apart from it.
struct SceneText {
  struct Quote {
    std::string text;
    bool included;  // it follows #include
  };
  std::string code;
  std::vector<Quote> quotes;
  bool complete = true;  // every #include is followed by a text in quotes
};
SceneText parse_scene_text(const std::string& source);

}  // namespace lensplane
