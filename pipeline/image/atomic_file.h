// SPDX-License-Identifier: Apache-2.0
//
// Files that appear whole or not at all.

#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>

namespace lensplane {

/// A file written piece by piece under a temporary name beside `path`, which it takes when it is committed;
/// gone when it is not. Folders that are missing are made, links are followed. All that fails throws Failure
/// (BadOutput) that names `path`, leaving whatever stood there before; so also when that is no regular file,
/// but a device, say.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const char> bytes);
  /// Where the next byte goes, from the file's beginning.
  std::uint64_t position();
  void seek(std::uint64_t position);

  /// Makes sure that everything is on the disk, and gives the file its name. Throws also when a write failed
  /// before, even if its Failure was lost on the way. Returns the file's size in bytes.
  std::size_t commit();

 private:
  /// Throws with the error of the operation that failed first.
  [[noreturn]] void fail();

  std::filesystem::path wanted_, path_, temporary_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  int error_ = 0;  // of the first operation that failed, an errno
  bool committed_ = false;
};

/// Writes `bytes` to an AtomicFile and commits.
void write_atomically(const std::filesystem::path& path, std::span<const char> bytes);

}  // namespace lensplane
