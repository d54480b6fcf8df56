// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "pipeline/image/failure.h"

namespace lensplane {
namespace {

constexpr int kWatchEvery_ms = 100;

/// A file descriptor that is closed when it is done with.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

[[noreturn]] void no_room(const std::string& program, int error) {
  throw Failure(ExitCode::TryAgain, fmt::format("{}: cannot be started: {}", program, std::strerror(error)));
}

/// Cuts text that comes in pieces into lines.
class Lines {
 public:
  explicit Lines(const std::function<void(const std::string&)>& say) : say_(say) {}
  void add(std::string_view text) {
    for (const char c : text) {
      if (c == '\n' || c == '\r') {
        end();
      } else {
        line_ += c;
      }
    }
  }
  void end() {
    if (!line_.empty()) say_(line_);
    line_.clear();
  }

 private:
  const std::function<void(const std::string&)>& say_;
  std::string line_;
};

/// Starts the program with `errors` as its standard error. 0, or why it could not be started.
int spawn(const Command& command, int errors, pid_t& process) {
  std::vector<char*> words;
  for (const std::string& word : command.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&files, command.folder.c_str());
  // A group of its own: it is killed with all that it has started, and by us alone. Signals as programs
  // expect them: without its reader, when that was killed, it ends at the next line that it writes.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  const int error = ::posix_spawnp(&process, words.front(), &files, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

/// Reads what the program says until it closes its standard error, or has to be killed. True when killed.
bool read_all(int errors, pid_t process, Lines& lines, const std::function<Watch()>& watch) {
  std::array<char, 4096> block;
  for (;;) {
    pollfd ready{errors, POLLIN, 0};
    const int count = ::poll(&ready, 1, kWatchEvery_ms);
    if (watch() == Watch::Kill) {
      ::kill(-process, SIGKILL);
      return true;
    }
    if (count <= 0) continue;
    const ssize_t size = ::read(errors, block.data(), block.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return false;
    lines.add({block.data(), static_cast<std::size_t>(size)});
  }
}

}  // namespace

ProcessEnd run_process(const Command& command, const std::function<void(const std::string& line)>& say,
                       const std::function<Watch()>& watch) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) no_room(command.words.front(), errno);
  Descriptor reading(ends[0]), writing(ends[1]);
  pid_t process = -1;
  const int error = spawn(command, writing.number(), process);
  if (error == EAGAIN || error == ENOMEM) no_room(command.words.front(), error);
  ProcessEnd end;
  end.started = error == 0;
  if (!end.started) return end;
  writing.close();
  Lines lines(say);
  end.killed = read_all(reading.number(), process, lines, watch);
  lines.end();
  // It may have closed its standard error and go on all the same.
  int status = 0;
  while (::waitpid(process, &status, end.killed ? 0 : WNOHANG) != process) {
    if (!end.killed && watch() == Watch::Kill) {
      ::kill(-process, SIGKILL);
      end.killed = true;
    }
    ::poll(nullptr, 0, end.killed ? 0 : kWatchEvery_ms);
  }
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return end;
}

}  // namespace lensplane
