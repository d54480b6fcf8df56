// SPDX-License-Identifier: Apache-2.0
//
// The program: reads the command line, runs the command, and turns whatever goes wrong into one line and an
// exit code.

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <new>
#include <string>

#include "pipeline/cli/check.h"
#include "pipeline/cli/render.h"
#include "pipeline/image/failure.h"

namespace {

// A signal handler can reach nothing else. The only global variable of the project.
volatile std::sig_atomic_t interrupt_requested = 0;

/// The first signal lets the frames in the making finish; the second ends the program at once.
extern "C" void request_interrupt(int signal) {
  interrupt_requested = 1;
  std::signal(signal, SIG_DFL);
}

void run(const lensplane::Options& options) {
  switch (options.command) {
    case lensplane::Command::Check:
      return lensplane::run_check(options);
    case lensplane::Command::Render:
    case lensplane::Command::Map:
      return lensplane::run_render(options, [] { return interrupt_requested != 0; });
  }
}

int fail(lensplane::ExitCode code, std::string line) {
  std::replace(line.begin(), line.end(), '\n', ' ');
  fmt::print(stderr, "{}\n", line);
  return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, request_interrupt);
  std::signal(SIGTERM, request_interrupt);
  try {
    const lensplane::ParsedCommandLine command_line = lensplane::parse_command_line(argc, argv);
    if (command_line.text) {
      fmt::print("{}", *command_line.text);
      return 0;
    }
    run(command_line.options);
    return 0;
  } catch (const lensplane::Failure& failure) {
    return fail(failure.code(), failure.what());
  } catch (const std::bad_alloc&) {
    return fail(lensplane::ExitCode::TryAgain, "lensplane: out of memory; try fewer --threads or a --proxy");
  } catch (const std::exception& error) {
    return fail(lensplane::ExitCode::BadInput, fmt::format("lensplane: {}", error.what()));
  }
}
