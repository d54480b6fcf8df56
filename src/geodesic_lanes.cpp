// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic_lanes.h"

#include <utility>

#include "src/batch.h"
#include "src/inlining.h"

namespace lensplane {
namespace {

template <class N>
using LaneStages = std::array<LaneMedia<N>, kNystromStages>;

template <int i, class N>
void stage_offsets(const LaneSteps<N>& steps, const LaneStages<N>& stages, LaneVectors<N>& offsets) {
#pragma GCC ivdep  // the arrays are all different ones
  for (int lane = 0; lane < kLanes; ++lane) {
    Vector<N> bend(N(0.0));
    [&]<int... j>(std::integer_sequence<int, j...>) {
      ((bend += times(stages[j].force.get(lane), kNystromMatrix[i][j])), ...);
    }
    (std::make_integer_sequence<int, i>());
    offsets.set(lane, stage_offset(steps.from.place.offset.get(lane), steps.from.p.get(lane),
                                   steps.h.get(lane), i, bend));
  }
}

template <class N>
struct LaneMassSums {
  LaneNumbers<N> sum;
  LaneVectors<N> fall;
  LaneNumbers<double> closeness2;
};

template <class N>
void lane_media(std::span<const PointMass> masses, const LaneVectors<double>& anchors,
                const LaneVectors<N>& offsets, LaneMedia<N>& media) {
  LaneMassSums<N> sums;
  for (const PointMass& mass : masses) {
#pragma GCC ivdep
    for (int lane = 0; lane < kLanes; ++lane) {
      MassSums<N> s{sums.sum.get(lane), sums.fall.get(lane), sums.closeness2.get(lane)};
      add_mass(mass, Place<N>{anchors.get(lane), offsets.get(lane)}, s);
      sums.sum.set(lane, s.sum);
      sums.fall.set(lane, s.fall);
      sums.closeness2.set(lane, s.closeness2);
    }
  }
#pragma GCC ivdep
  for (int lane = 0; lane < kLanes; ++lane) {
    media.set(lane, medium_of<N>({sums.sum.get(lane), sums.fall.get(lane), sums.closeness2.get(lane)}));
  }
}

template <class N>
void end_steps(const LaneStages<N>& stages, LaneSteps<N>& steps) {
#pragma GCC ivdep
  for (int lane = 0; lane < kLanes; ++lane) {
    StageSums<N> sums;
    [&]<int... i>(std::integer_sequence<int, i...>) {
      (add_stage(i, stages[i].force.get(lane), stages[i].excess.get(lane), stages[i].sum.get(lane), sums),
       ...);
    }
    (std::make_integer_sequence<int, kNystromStages>());
    const RayStep<N> step = step_of(steps.launch.get(lane), steps.from.get(lane), steps.h.get(lane), sums,
                                    stages.back().get(lane));
    steps.end.set(lane, step.end);
    steps.error_root.set(lane, step.error_root);
    steps.derivatives_root.set(lane, step.derivatives_root);
    steps.time_error.set(lane, step.time_error);
    steps.largest_force.set(lane, step.largest_force);
    steps.largest_sum.set(lane, step.largest_sum);
  }
}

template <class N>
void all_stages(std::span<const PointMass> masses, LaneSteps<N>& steps) {
  LaneStages<N> stages;
  LaneVectors<N> offsets;
  stages[0] = steps.from.medium;
  [&]<int... i>(std::integer_sequence<int, i...>) {
    ((stage_offsets<i + 1>(steps, stages, offsets),
      lane_media(masses, steps.from.place.anchor, offsets, stages[i + 1])),
     ...);
  }
  (std::make_integer_sequence<int, kNystromStages - 1>());
  end_steps(stages, steps);
}

}  // namespace

LENSPLANE_KERNEL LENSPLANE_FLATTEN void take_steps(std::span<const PointMass> masses,
                                                   LaneSteps<double>& steps) {
  all_stages(masses, steps);
}

LENSPLANE_KERNEL LENSPLANE_FLATTEN void take_steps(std::span<const PointMass> masses,
                                                   LaneSteps<Dual>& steps) {
  all_stages(masses, steps);
}

}  // namespace lensplane
