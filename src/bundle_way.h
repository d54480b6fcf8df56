// SPDX-License-Identifier: Apache-2.0
//
// The way of a bundle of rays past the masses: its middle ray by `planes`, how far the others are from it at
// most, and how errors of one bend grow through those behind it.

#pragma once

#include <vector>

#include "src/deflectors.h"

namespace lensplane {

/// A straight stretch of a bundle.
struct BundleStretch {
  Vec3 start, direction;  // of its middle ray; metres, unit vector
  double length;          // metres; may be infinite
  double across, spread;  // how far the others are from it: metres at the start, radians
};

/// A mass as a bundle passes it.
struct BundlePass {
  const Deflector* deflector;
  double least_b, most_b;  // metres
};

/// One plane as a bundle passes it.
struct BundlePlane {
  double way = 0;          // from the last plane, metres
  double growth = 0;       // of its bends per metre across, at most
  std::size_t begin, end;  // its masses among the passes
};

struct BundleWay {
  std::vector<BundleStretch> stretches;
  std::vector<BundlePass> passes;   // of all masses; where nothing is known of the rays, at any distance
  std::vector<BundlePlane> planes;  // those that it passes before it is lost
  // After its last stretch the rays may be anywhere: near a mass, captured, or turned back.
  bool lost = false;
  const Deflector* captor = nullptr;  // or else this mass captures them all
};

/// The bundle of the rays that leave within `spread` radians of `direction`. Nearer to a mass than it would
/// be seen under `unseen_angle` none counts.
BundleWay follow_bundle(const Deflectors& everything, const Vec3& direction, double spread,
                        double unseen_angle);

/// Largest |d alpha/db| and alpha/b of the exact law from b on.
double growth_at(double m, double b);

}  // namespace lensplane
