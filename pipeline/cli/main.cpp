// SPDX-License-Identifier: Apache-2.0
//
// The program: reads the command line, runs the command, and turns whatever goes wrong into one line and an
// exit code.

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>

#include "pipeline/cli/check.h"
#include "pipeline/cli/export.h"
#include "pipeline/cli/plan.h"
#include "pipeline/cli/probe.h"
#include "pipeline/cli/render.h"
#include "pipeline/cli/study.h"
#include "pipeline/cli/warp.h"
#include "pipeline/image/failure.h"

namespace {

// A signal handler can reach nothing else. The only global variable of the project.
std::atomic<bool> interrupt_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "or a signal handler must not touch it");

/// The first signal lets what is in the making finish; the second ends the program at once.
extern "C" void request_interrupt(int signal) {
  interrupt_requested = true;
  std::signal(signal, SIG_DFL);
}

void take_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, request_interrupt);
}

void run(const lensplane::Options& options) {
  switch (options.command) {
    case lensplane::Command::Check:
      return lensplane::run_check(options);
    case lensplane::Command::Plan:
      return lensplane::run_plan(options);
    case lensplane::Command::Probe:
      return lensplane::run_probe(options);
    case lensplane::Command::Export:
      return lensplane::run_export(options);
    case lensplane::Command::Warp:
      return lensplane::run_warp(options);
    case lensplane::Command::Study:
      take_interrupts();
      return lensplane::run_study_command(options, [] { return interrupt_requested.load(); });
    case lensplane::Command::Render:
    case lensplane::Command::Map:
    case lensplane::Command::Comp:
      take_interrupts();
      return lensplane::run_render(options, [] { return interrupt_requested.load(); });
  }
}

/// Where even this cannot be written there is no one left to tell.
int fail(lensplane::ExitCode code, const std::string& line) {
  std::fputs((lensplane::one_line(line) + "\n").c_str(), stderr);
  return static_cast<int>(code);
}

/// Done, unless what was printed got lost. A reader who went away has seen enough.
int finish() {
  if (std::fflush(stdout) == 0 || errno == EPIPE || errno == EBADF)
    return static_cast<int>(lensplane::ExitCode::Done);
  return fail(lensplane::ExitCode::BadOutput,
              fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
}

}  // namespace

int main(int argc, char** argv) {
  // Errors of writing are told by what is written, not by signals that end the program.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const lensplane::ParsedCommandLine command_line = lensplane::parse_command_line(argc, argv);
    if (command_line.text) {
      std::fputs(command_line.text->c_str(), stdout);
      return finish();
    }
    run(command_line.options);
    return finish();
  } catch (const lensplane::Failure& failure) {
    return fail(failure.code(), failure.what());
  } catch (const std::bad_alloc&) {
    return fail(lensplane::ExitCode::TryAgain, "lensplane: out of memory; try fewer --threads or a --proxy");
  } catch (const std::exception& error) {
    return fail(lensplane::ExitCode::BadInput, fmt::format("lensplane: {}", error.what()));
  }
}
