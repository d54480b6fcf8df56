// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/trace_study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "pipeline/shot/shot_scene.h"
#include "tests/pipeline/study/study_shots.h"

namespace lensplane {
namespace {

Study traces_of(const Shot& shot, int frame, int rays = 400) {
  Study study;
  study_traces(shot, frame, little_effort(rays), {}, study);
  return study;
}

const TraceRow& row_named(const Study& study, const std::string& name) {
  for (const TraceRow& row : study.traces) {
    if (name_of(row.rung.settings) == name) return row;
  }
  throw std::runtime_error("no row " + name);
}

void expect_kept_bounds(const Study& study) {
  for (const TraceRow& row : study.traces) {
    EXPECT_FALSE(row.violated) << name_of(row.rung.settings) << ": " << row.left_out.most_px << " instead of "
                               << row.bound_px.value_or(0);
    EXPECT_EQ(row.errors.size(), static_cast<std::size_t>(study.reference.grid.count()));
  }
}

TEST(TraceStudy, TwentyRandomShotsKeepTheirBounds) {
  std::mt19937 random(6);
  int limited = 0, used = 0;
  for (int n = 0; n < 20; ++n) {
    const std::string text = random_shot(random);
    SCOPED_TRACE(text);
    const Study study = traces_of(shot_from(text), 1001, 120);
    expect_kept_bounds(study);
    for (const TraceRow& row : study.traces) {
      if (!row.bound_px || !std::isfinite(*row.bound_px)) continue;
      ++limited;
      used += row.left_out.most_px > 0;
    }
  }
  // It is not that nothing is ever left out, or no limit known.
  EXPECT_GT(limited, 150);
  EXPECT_GT(used, 40);
}

TEST(TraceStudy, ShippedScenesKeepTheirBounds) {
  std::set<std::string> studied;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(LENSPLANE_SOURCE_DIR) + "/scenes")) {
    if (entry.path().extension() != ".yaml") continue;
    SCOPED_TRACE(entry.path());
    const Shot full = read_shot(entry.path().string(), {});
    const Shot shot = proxy_of(full, std::max(1, full.camera.width / 64));
    expect_kept_bounds(traces_of(shot, shot.frames.front(), 60));
    studied.insert(shot.name);
  }
  EXPECT_GE(studied.size(), 10U);
}

TEST(TraceStudy, ABoundIsViolatedByMoreAndByOtherCapturedLight) {
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  ErrorSummary left_out;
  left_out.most_px = 0.2;
  EXPECT_FALSE(violates(0.2, left_out, 0));
  EXPECT_FALSE(violates(0.19, left_out, 0.02));
  EXPECT_TRUE(violates(0.19, left_out, 0.005));
  EXPECT_FALSE(violates(kNoLimit, left_out, 0));
  left_out.captured_differs = 1;
  EXPECT_TRUE(violates(0.2, left_out, 0));
  EXPECT_FALSE(violates(kNoLimit, left_out, 0));
}

TEST(TraceStudy, TheReferenceOfASingleMassIsSchwarzschilds) {
  // Its photon sphere fills a good part of the frame.
  const Study study = traces_of(shot_from(one_mass(3000)), 1001, 1536);
  ASSERT_TRUE(study.reference.closed_form);
  EXPECT_GT(study.reference.closed_form->compared, 1000U);
  EXPECT_EQ(study.reference.closed_form->share_validity_differs, 0);
  EXPECT_LT(study.reference.closed_form->p99_px, 1e-6);
  EXPECT_LT(study.reference.own.p99_px, 1e-5);
  EXPECT_TRUE(study.notes.empty());
  // The trace by planes comes as near as it is said to, the others less so.
  const TraceRow& exact = row_named(study, "planes, law exact, finite distance on");
  EXPECT_LT(exact.error.p99_px, 0.1);
  EXPECT_GT(row_named(study, "planes, law weak, finite distance on").error.p99_px, 10 * exact.error.p99_px);
  EXPECT_EQ(exact.left_out.most_px, 0);
  EXPECT_EQ(exact.bound_px, 0);
}

TEST(TraceStudy, MassesOfZeroAreNone) {
  std::string text = one_mass(1);
  text.replace(text.find("lenses: ["), 9,
               "lenses: [{name: none, mass: 0 kg, position: [0 m, 0 m, -2e9 m]}, ");
  const Study study = traces_of(shot_from(text), 1001, 100);
  EXPECT_EQ(study.masses, 1U);
  EXPECT_TRUE(study.reference.closed_form);
  EXPECT_TRUE(study.notes.empty());
  const Study without = traces_of(shot_from(text.replace(text.find("1 Msun"), 6, "0 Msun")), 1001, 100);
  EXPECT_EQ(without.masses, 0U);
  EXPECT_EQ(row_named(without, "kishi").error.most_px, 0);
}

TEST(TraceStudy, WithinThePhotonSphereThereIsNoClosedForm) {
  // m is 4e8 m, the camera 1e9 m away.
  const Study study = traces_of(shot_from(one_mass(2.8e5)), 1001, 100);
  EXPECT_FALSE(study.reference.closed_form);
}

TEST(TraceStudy, CurvedRaysComeNearerWithTheirTolerance) {
  const Study study = traces_of(shot_from(one_mass(300)), 1001, 2000);
  double before = std::numeric_limits<double>::infinity();
  for (const char* name :
       {"geodesic, 1 px", "geodesic, 0.01 px", "geodesic, 0.0001 px", "geodesic, 1e-06 px"}) {
    const TraceRow& row = row_named(study, name);
    EXPECT_LT(row.error.p99_px, 0.1 * before) << name;
    EXPECT_FALSE(row.bound_px);
    EXPECT_TRUE(row.trace.of_a_part);
    before = row.error.p99_px;
  }
  EXPECT_GT(before, study.reference.own.p99_px * 0.1);
}

TEST(TraceStudy, SeveralMassesAreSaidToHaveNoExactReference) {
  std::string text = one_mass(1);
  text.replace(text.find("lenses: ["), 9,
               "lenses: [{name: other, mass: 1 Msun, position: [0 m, 0 m, -2e9 m]}, ");
  const Study study = traces_of(shot_from(text), 1001, 100);
  EXPECT_FALSE(study.reference.closed_form);
  ASSERT_EQ(study.notes.size(), 1U);
  EXPECT_NE(study.notes[0].find("masses do together"), std::string::npos);
}

TEST(TraceStudy, RaysAreFewerWithManyMasses) {
  const StudyEffort effort;
  EXPECT_EQ(rays_of(effort, 1), effort.most_rays);
  EXPECT_EQ(rays_of(effort, 4), effort.most_rays);
  EXPECT_EQ(rays_of(effort, 40), effort.most_rays / 10);
  EXPECT_EQ(rays_of(effort, 100000), 256);
  EXPECT_EQ(rays_of(little_effort(100), 100000), 100);
}

TEST(TraceStudy, SceneShowsTheSkyWhereThereAreStarsOnly) {
  const auto surfaces = [](const std::string& layers) {
    std::string text = one_mass(1);
    text.replace(text.find("layers:"), std::string::npos, "layers: [" + layers + "]\n");
    return study_scene(shot_from(text), 1001).surfaces;
  };
  const auto is_sky = [](const Surface& s) { return std::holds_alternative<LatLong>(s); };
  EXPECT_EQ(surfaces("{name: stars, type: stars, catalogue: c.csv}").size(), 1U);
  EXPECT_TRUE(is_sky(surfaces("{name: stars, type: stars, catalogue: c.csv}").front()));
  EXPECT_EQ(surfaces("{name: a, type: plate, image: a.exr}").size(), 1U);
  // A card is crossed twice at most, but studied once.
  const auto both = surfaces(
      "{name: a, type: plate, image: a.exr, distance: 2e9 m}, {name: s, type: stars, catalogue: c.csv}");
  ASSERT_EQ(both.size(), 2U);
  EXPECT_TRUE(is_sky(both.back()));
}

TEST(TraceStudy, StopsBetweenRowsWithWhatIsDone) {
  Study study;
  int asked = 0;
  study_traces(shot_from(one_mass(1)), 1001, little_effort(100),
               {[](const std::string&) {}, [&] { return ++asked > 3; }}, study);
  EXPECT_TRUE(study.interrupted);
  EXPECT_EQ(study.traces.size(), 3U);
}

TEST(TraceStudy, LongTracesAreTimedInPart) {
  std::string text = one_mass(1);
  text.replace(text.find("[96, 64]"), 8, "[640, 1000]");
  const Shot shot = shot_from(text);
  const Scene scene = study_scene(shot, 1001);
  const Tracer tracer(scene, plan_trace(scene, TraceSettings()));
  const FilmGrid grid = grid_of(scene.camera, 4096);
  const Timing whole = time_trace(tracer, grid, {0, 5, 5, 1e9}),
               part = time_trace(tracer, grid, {0, 5, 5, 1e-3});
  const Timing by_grid = time_trace(tracer, grid, {0, 5, 5, 1e-9});
  EXPECT_FALSE(whole.of_a_part);
  // Parts stand for the whole, as far as a busy machine tells.
  for (const Timing& timing : {part, by_grid}) {
    EXPECT_TRUE(timing.of_a_part);
    EXPECT_GT(timing.least_s, 0.1 * whole.least_s);
    EXPECT_LT(timing.least_s, 10 * whole.least_s);
  }
}

}  // namespace
}  // namespace lensplane
