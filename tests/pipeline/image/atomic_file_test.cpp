// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <sstream>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::size_t files_in(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator files(folder);
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

TEST(AtomicFile, WritesAndReplacesAndMakesFolders) {
  const TemporaryFolder folder;
  write_atomically(folder / "a/b/file.txt", std::string("first"));
  write_atomically(folder / "a/b/file.txt", std::string("second"));
  EXPECT_EQ(contents(folder / "a/b/file.txt"), "second");
  EXPECT_EQ(files_in(folder / "a/b"), 1U);
}

TEST(AtomicFile, RefusesPlacesWhereNothingCanBeWritten) {
  const TemporaryFolder folder;
  folder.write("file", "x");
  const Refusal below_a_file =
      refusal_of([&] { write_atomically(folder / "file/below.txt", std::string("y")); });
  EXPECT_EQ(below_a_file.code, ExitCode::BadOutput);
  EXPECT_THAT(below_a_file.line,
              testing::HasSubstr((folder / "file/below.txt").string() + ": cannot be written: "));
  std::filesystem::create_directory(folder / "folder");
  EXPECT_EQ(refusal_of([&] { write_atomically(folder / "folder", std::string("y")); }).code,
            ExitCode::BadOutput);
  EXPECT_EQ(files_in(folder.path()), 2U);  // nothing half-written beside them
}

TEST(AtomicFile, FollowsLinksAndLeavesDevicesAlone) {
  const TemporaryFolder folder;
  folder.write("real", "old");
  std::filesystem::create_symlink("real", folder / "link");
  write_atomically(folder / "link", std::string("new"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(contents(folder / "real"), "new");
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  EXPECT_EQ(refusal_of([&] { write_atomically(folder / "fifo", std::string("x")); }).line,
            (folder / "fifo").string() + ": cannot be written: it is not a file");
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "fifo"));
}

TEST(AtomicFile, PiecesAppearOnlyWhenTheyAreCommitted) {
  const TemporaryFolder folder;
  write_atomically(folder / "file", std::string("old"));
  {
    AtomicFile file(folder / "file");
    file.write(std::string("given up"));
  }
  EXPECT_EQ(contents(folder / "file"), "old");
  EXPECT_EQ(files_in(folder.path()), 1U);
  AtomicFile file(folder / "file");
  file.write(std::string("one two"));
  file.seek(4);
  file.write(std::string("2"));
  EXPECT_EQ(file.position(), 5U);
  EXPECT_EQ(contents(folder / "file"), "old");
  EXPECT_EQ(file.commit(), 7U);
  EXPECT_EQ(contents(folder / "file"), "one 2wo");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

/// The size that files may have while the test runs: it stands for a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit before_{};
  void (*old_handler_)(int);
};

TEST(AtomicFile, WriteThatFailedIsNotForgotten) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "file");
  Refusal first, last;
  {
    const FileSizeLimit limit(1000);
    first = refusal_of([&] { file.write(std::string(100000, 'x')); });
  }
  last = refusal_of([&] { file.commit(); });
  EXPECT_EQ(first.code, ExitCode::BadOutput);
  EXPECT_EQ(last.line, first.line);
  EXPECT_FALSE(std::filesystem::exists(folder / "file"));
}

TEST(AtomicFile, FullDiskLeavesTheOldFileAndNoOther) {
  const TemporaryFolder folder;
  write_atomically(folder / "file", std::string("old"));
  const FileSizeLimit limit(1000);
  const Refusal refusal = refusal_of([&] { write_atomically(folder / "file", std::string(100000, 'x')); });
  EXPECT_EQ(refusal.code, ExitCode::BadOutput);
  EXPECT_EQ(contents(folder / "file"), "old");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

}  // namespace
}  // namespace lensplane
