// SPDX-License-Identifier: Apache-2.0
//
// Running another program, without a shell, and reading what it says while it works.

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lensplane {

/// What the caller makes of a running program.
enum class Watch { GoOn, Kill };

/// A program, its arguments, and where it runs.
struct Command {
  std::vector<std::string>
      words;                     // the program's path or name, which $PATH is searched for, and its arguments
  std::filesystem::path folder;  // its working directory
};

/// How a program ended.
struct ProcessEnd {
  bool started = true;  // false: there is no such program, or it may not be run
  bool killed = false;  // by the watcher
  int exit_code = 0;    // -1 when a signal ended it
  int signal = 0;       // that signal, or 0
};

/// Runs the program to its end. Its standard error is handed to `say` line by line (carriage returns end
/// lines, too); `watch` is asked several times a second whether it is to go on, and the program, with all
/// that it has started, is killed when it is not. Standard output and input are empty. Throws Failure
/// (TryAgain) when the system has no room for another process.
ProcessEnd run_process(const Command& command, const std::function<void(const std::string& line)>& say,
                       const std::function<Watch()>& watch);

}  // namespace lensplane
