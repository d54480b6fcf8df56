// SPDX-License-Identifier: Apache-2.0
//
// The program: reads the command line, runs the command, and turns whatever goes wrong into one line and an
// exit code.

#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <exception>
#include <new>
#include <string>

#include "pipeline/cli/check.h"
#include "pipeline/cli/render.h"
#include "pipeline/image/failure.h"

namespace {

// A signal handler can reach nothing else. The only global variable of the project.
std::atomic<bool> interrupt_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "or a signal handler must not touch it");

/// The first signal lets the frames in the making finish; the second ends the program at once.
extern "C" void request_interrupt(int signal) {
  interrupt_requested = true;
  std::signal(signal, SIG_DFL);
}

void run(const lensplane::Options& options) {
  switch (options.command) {
    case lensplane::Command::Check:
      return lensplane::run_check(options);
    case lensplane::Command::Render:
    case lensplane::Command::Map:
      std::signal(SIGINT, request_interrupt);
      std::signal(SIGTERM, request_interrupt);
      return lensplane::run_render(options, [] { return interrupt_requested.load(); });
  }
}

int fail(lensplane::ExitCode code, const std::string& line) {
  fmt::print(stderr, "{}\n", lensplane::one_line(line));
  return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
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
