// SPDX-License-Identifier: Apache-2.0
//
// A curved ray on its way: which steps it asks for, and what becomes of it.

#pragma once

#include <span>

#include "src/geodesic.h"
#include "src/geodesic_step.h"

namespace lensplane {

/// What rays fly through.
struct GeodesicScene {
  std::span<const PointMass> masses;  // all > 0
  Bodies bodies;
  double tolerance;
  RayNeeds needs;
};

/// The way from a point to infinity, to first order in the masses (time: to second order).
template <class N>
struct Outlook {
  Vector<N> bend{N(0.0)};   // of the direction
  Vector<N> shift{N(0.0)};  // of the straight line approached, metres
  N delay = 0.0;            // metres; see GeodesicRay::delay
};

template <class N>
class GeodesicFlight {
 public:
  GeodesicFlight(const GeodesicScene& scene, const Vector<N>& start, const Vector<N>& direction);

  bool flies() const { return flies_; }
  const Launch<N>& launch() const { return launch_; }
  const RayPoint<N>& at() const { return at_; }
  double step_length() const { return h_; }  // of the step to try next, in t

  /// Goes on by that step, or asks for a shorter one.
  void go_on(const RayStep<N>& step);

  /// What became of it.
  const GeodesicRay<N>& ray() const { return ray_; }

 private:
  enum class Heading { Towards, Away, Captured };  // towards any mass, away from all
  Heading heading() const;
  void tighten_for_delay();
  bool hides_body(const PointMass& mass) const;  // not yet met, inside the photon sphere
  bool may_meet_bodies(double bend) const;
  bool may_meet_bodies_within(double way, double bend) const;
  bool is_far() const;
  double longest_leap() const;
  bool leap();
  void go_far();
  Outlook<N> outlook(const Vector<N>& direction) const;
  void meet_bodies(const RayStep<N>& step);
  void arrive();
  void end_captured();
  void give_up();

  GeodesicScene scene_;
  double tolerance_;                                      // of the direction, radians
  double derivatives_tolerance_;                          // relative
  double tolerance_root_ = 0.0, derivatives_root_ = 0.0;  // their eighth roots
  double time_tolerance_ = 0.0;                           // of a step, metres
  double thin_for_times_ = 0.0;                           // over m; see tighten_for_delay()
  Launch<N> launch_;
  RayPoint<N> at_;
  double h_ = 0.0;
  int steps_ = 0;
  bool flies_ = true;
  std::vector<DiscPassage> passages_;  // through the discs
  GeodesicRay<N> ray_;
};

}  // namespace lensplane
