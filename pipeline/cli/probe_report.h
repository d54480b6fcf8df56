// SPDX-License-Identifier: Apache-2.0
//
// A probe as people and as programs read it.

#pragma once

#include <string>

#include "pipeline/shot/shot.h"
#include "src/probe.h"

namespace lensplane {

struct ProbedFrame {
  int frame;
  Camera camera;
  Plan plan;
  Probe probe;
};

std::string text_from_probe(const Shot& shot, const ProbedFrame& probed);

/// The keys stand in docs/shot-format.md. Numbers come back bit for bit; infinite ones are null.
std::string json_from_probe(const Shot& shot, const ProbedFrame& probed);

}  // namespace lensplane
