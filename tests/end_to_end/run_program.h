// SPDX-License-Identifier: Apache-2.0
//
// Running programs as a user would, without a shell.

#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/pipeline/temporary_folder.h"

namespace lensplane {

struct ProgramResult {
  int exit_code = -1;
  std::string out;
  std::string err;
};

inline std::string contents_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Starts `words` with output into the folder's files out and err; the process.
inline pid_t start_program(const std::vector<std::string>& words, const TemporaryFolder& folder,
                           const std::vector<std::string>& environment = {}) {
  std::vector<char*> arguments, variables;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  // Of two values of a variable the first counts.
  for (const std::string& variable : environment) variables.push_back(const_cast<char*>(variable.c_str()));
  for (char** variable = environ; *variable; ++variable) variables.push_back(*variable);
  arguments.push_back(nullptr);
  variables.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  const std::string out = (folder / "out").string(), err = (folder / "err").string();
  posix_spawn_file_actions_addopen(&files, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addopen(&files, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  pid_t process = -1;
  posix_spawnp(&process, arguments[0], &files, nullptr, arguments.data(), variables.data());
  posix_spawn_file_actions_destroy(&files);
  return process;
}

inline int exit_code_of(pid_t process) {
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

inline ProgramResult wait_for(pid_t process, const TemporaryFolder& folder) {
  const int exit_code = exit_code_of(process);
  return {exit_code, contents_of(folder / "out"), contents_of(folder / "err")};
}

inline ProgramResult run_program(const std::vector<std::string>& words,
                                 const std::vector<std::string>& environment = {}) {
  const TemporaryFolder folder;
  return wait_for(start_program(words, folder, environment), folder);
}

inline ProgramResult lensplane(std::vector<std::string> words,
                               const std::vector<std::string>& environment = {}) {
  words.insert(words.begin(), LENSPLANE_PROGRAM);
  return run_program(words, environment);
}

}  // namespace lensplane
