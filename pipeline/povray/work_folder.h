// SPDX-License-Identifier: Apache-2.0
//
// Folders to work in, which are gone afterwards.

#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

namespace lensplane {

class WorkFolder {
 public:
  /// A new folder in `parent`, which is made if need be; its name begins with `name`. Throws Failure
  /// (BadOutput).
  WorkFolder(const std::filesystem::path& parent, const std::string& name);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a file in it. Throws Failure (BadOutput).
  void write(const std::string& name, const std::string& text) const;
  void write(const std::string& name, const std::function<void(std::ostream& to)>& make) const;

 private:
  std::filesystem::path path_;
};

}  // namespace lensplane
