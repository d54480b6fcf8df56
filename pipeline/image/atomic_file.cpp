// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "pipeline/image/failure.h"

namespace lensplane {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Failure(ExitCode::BadOutput, fmt::format("{}: cannot be written: {}", path.string(), reason));
}

/// Writes everything and closes; the errno of what went wrong, or 0.
int write_and_close(int file, std::span<const char> bytes) {
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  if (error == 0 && ::fsync(file) != 0 && errno != EINVAL && errno != ENOTSUP) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

void write_atomically(const std::filesystem::path& wanted, std::span<const char> bytes) {
  std::error_code error_code;
  // A link is followed: the file that it leads to is replaced, not the link.
  const bool is_link = std::filesystem::is_symlink(wanted, error_code);
  const std::filesystem::path path = is_link ? std::filesystem::weakly_canonical(wanted, error_code) : wanted;
  const auto status = std::filesystem::status(path, error_code);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    refuse(wanted, "it is not a file");
  const std::filesystem::path folder = path.parent_path().empty() ? "." : path.parent_path();
  std::filesystem::create_directories(folder, error_code);
  if (error_code) refuse(wanted, error_code.message());

  const std::filesystem::path temporary =
      folder / fmt::format(".{}.{}.part", path.filename().string(), ::getpid());
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) refuse(wanted, std::strerror(errno));
  int error = write_and_close(file, bytes);
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(temporary.c_str());
  refuse(wanted, std::strerror(error));
}

}  // namespace lensplane
