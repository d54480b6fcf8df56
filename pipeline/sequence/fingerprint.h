// SPDX-License-Identifier: Apache-2.0
//
// Fingerprints: a hash of everything that determines the pixels of an output, so that a second run can tell
// what is done and right from what has to be made again. Independent of the machine, of paths and of dates.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/plan.h"

namespace lensplane {

/// Collects what determines an output. Values go in with all their bits.
class Fingerprint {
 public:
  Fingerprint& add(const std::string& text);
  Fingerprint& add(double value);
  Fingerprint& add(const Vec3& value) { return add(value.x).add(value.y).add(value.z); }
  Fingerprint& add(const Basis& axes) { return add(axes.x).add(axes.y).add(axes.z); }
  /// The contents of a file. Throws Failure (BadInput) when it cannot be read.
  Fingerprint& add_file(const std::filesystem::path& path);

  /// Forty hexadecimal digits.
  std::string digest() const;

 private:
  std::string text_;
};

/// What determines the traced light: camera, lenses, surfaces, the plan without its effects, and lensplane's
/// version.
Fingerprint fingerprint_of_trace(const Scene& scene, const Plan& plan);

}  // namespace lensplane
