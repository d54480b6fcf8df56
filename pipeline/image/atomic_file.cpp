// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "pipeline/image/failure.h"

namespace lensplane {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Failure(ExitCode::BadOutput, fmt::format("{}: cannot be written: {}", path.string(), reason));
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& path) : wanted_(path), file_(nullptr, std::fclose) {
  std::error_code error;
  // A link is followed: the file that it leads to is replaced, not the link.
  const bool is_link = std::filesystem::is_symlink(wanted_, error);
  path_ = is_link ? std::filesystem::weakly_canonical(wanted_, error) : wanted_;
  const auto status = std::filesystem::status(path_, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    refuse(wanted_, "it is not a file");
  const std::filesystem::path folder = path_.parent_path().empty() ? "." : path_.parent_path();
  std::filesystem::create_directories(folder, error);
  if (error) refuse(wanted_, error.message());
  temporary_ = folder / fmt::format(".{}.{}.part", path_.filename().string(), ::getpid());
  file_.reset(std::fopen(temporary_.c_str(), "wbe"));  // e: not for programs that are started meanwhile
  if (!file_) refuse(wanted_, std::strerror(errno));
}

AtomicFile::~AtomicFile() {
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::fail() {
  if (error_ == 0) error_ = errno;
  refuse(wanted_, std::strerror(error_));
}

void AtomicFile::write(std::span<const char> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail();
}

std::uint64_t AtomicFile::position() {
  const off_t position = ::ftello(file_.get());
  if (position < 0) fail();
  return static_cast<std::uint64_t>(position);
}

void AtomicFile::seek(std::uint64_t position) {
  if (::fseeko(file_.get(), static_cast<off_t>(position), SEEK_SET) != 0) fail();
}

std::size_t AtomicFile::commit() {
  if (error_ != 0 || std::fflush(file_.get()) != 0) fail();
  if (::fsync(::fileno(file_.get())) != 0 && errno != EINVAL && errno != ENOTSUP) fail();
  if (::fseeko(file_.get(), 0, SEEK_END) != 0) fail();
  const std::uint64_t size = position();
  if (std::fclose(file_.release()) != 0) fail();
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail();
  committed_ = true;
  return size;
}

void write_atomically(const std::filesystem::path& path, std::span<const char> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace lensplane
