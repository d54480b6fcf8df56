// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic_batch.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "src/geodesic_flight.h"
#include "src/geodesic_lanes.h"

namespace lensplane {
namespace {

/// The rays under way, one a lane.
template <class N>
class Lanes {
 public:
  Lanes(const GeodesicScene& scene, const Vector<N>& start, std::span<const Vector<N>> directions,
        std::span<GeodesicRay<N>> rays)
      : scene_(scene), start_(start), directions_(directions), rays_(rays) {}

  /// Gives every free lane the next ray. False when all rays have ended.
  bool launch() {
    bool flies = false;
    for (int lane = 0; lane < kLanes; ++lane) {
      std::optional<GeodesicFlight<N>>& flight = flights_[lane];
      while (!flight && next_ < directions_.size()) {
        flight.emplace(scene_, start_, directions_[next_]);
        steps_.launch.set(lane, flight->launch());
        ray_[lane] = next_++;
        land_if_ended(lane);
      }
      flies |= flight.has_value();
    }
    return flies;
  }

  /// A step of every lane.
  void go_on() {
    for (int lane = 0; lane < kLanes; ++lane) {
      if (!flights_[lane]) continue;
      steps_.from.set(lane, flights_[lane]->at());
      steps_.h.set(lane, flights_[lane]->step_length());
    }
    take_steps(scene_.masses, steps_);
    for (int lane = 0; lane < kLanes; ++lane) {
      if (!flights_[lane]) continue;
      flights_[lane]->go_on(steps_.get(lane));
      land_if_ended(lane);
    }
  }

 private:
  void land_if_ended(int lane) {
    if (flights_[lane]->flies()) return;
    rays_[ray_[lane]] = flights_[lane]->ray();
    flights_[lane].reset();
  }

  GeodesicScene scene_;
  Vector<N> start_;
  std::span<const Vector<N>> directions_;
  std::span<GeodesicRay<N>> rays_;
  std::size_t next_ = 0;
  std::array<std::optional<GeodesicFlight<N>>, kLanes> flights_;
  std::array<std::size_t, kLanes> ray_{};  // which ray flies there
  LaneSteps<N> steps_;
};

}  // namespace

template <class N>
std::vector<GeodesicRay<N>> trace_geodesics(std::span<const PointMass> masses, const Vector<N>& start,
                                            std::span<const Vector<N>> directions, double tolerance,
                                            const Bodies& bodies, const RayNeeds& needs) {
  const std::vector<PointMass> heavy = without_zeros(masses);
  std::vector<GeodesicRay<N>> rays(directions.size());
  if (heavy.empty()) {
    std::ranges::transform(directions, rays.begin(), [&](const Vector<N>& direction) {
      return trace_geodesic<N>({}, start, direction, tolerance, bodies, needs);
    });
    return rays;
  }
  const GeodesicScene scene{heavy, bodies, std::max(kFinestTolerance, tolerance), needs};
  const auto lanes = std::make_unique<Lanes<N>>(scene, start, directions, rays);
  while (lanes->launch()) lanes->go_on();
  return rays;
}

template std::vector<GeodesicRay<double>> trace_geodesics(std::span<const PointMass>, const Vec3&,
                                                          std::span<const Vec3>, double, const Bodies&,
                                                          const RayNeeds&);
template std::vector<GeodesicRay<Dual>> trace_geodesics(std::span<const PointMass>, const DualVec3&,
                                                        std::span<const DualVec3>, double, const Bodies&,
                                                        const RayNeeds&);

}  // namespace lensplane
