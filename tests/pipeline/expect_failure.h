// SPDX-License-Identifier: Apache-2.0
//
// Expecting the one line with which lensplane refuses something.

#pragma once

#include <gtest/gtest.h>

#include <string>

#include "pipeline/image/failure.h"

namespace lensplane {

/// The line and exit code of the Failure that `work` throws; an empty line when it throws none.
struct Refusal {
  ExitCode code = ExitCode::Done;
  std::string line;
};

template <class Work>
Refusal refusal_of(Work work) {
  try {
    work();
  } catch (const Failure& failure) {
    return {failure.code(), failure.what()};
  }
  return {};
}

}  // namespace lensplane
