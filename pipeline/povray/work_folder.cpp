// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/work_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "pipeline/image/failure.h"

namespace lensplane {

WorkFolder::WorkFolder(const std::filesystem::path& parent, const std::string& name) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(parent, error);
  std::filesystem::create_directories(whole, error);
  std::string pattern = (whole / (name + ".XXXXXX")).string();
  if (!::mkdtemp(pattern.data())) {
    throw Failure(ExitCode::BadOutput, fmt::format("{}: no folder to work in can be made there: {}",
                                                   parent.string(), std::strerror(errno)));
  }
  path_ = pattern;
}

WorkFolder::~WorkFolder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

void WorkFolder::write(const std::string& name, const std::string& text) const {
  write(name, [&](std::ostream& to) { to << text; });
}

void WorkFolder::write(const std::string& name, const std::function<void(std::ostream& to)>& make) const {
  std::ofstream file(path_ / name, std::ios::binary);
  make(file);
  file.close();
  if (!file) throw Failure(ExitCode::BadOutput, (path_ / name).string() + ": cannot be written");
}

}  // namespace lensplane
