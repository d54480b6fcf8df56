// SPDX-License-Identifier: Apache-2.0

#include "src/map_bands.h"

#include <gtest/gtest.h>

#include "tests/src/scenes.h"

namespace lensplane {
namespace {

/// Four points and one more: what they are does not matter here.
FilmFilter some_filter() {
  return {0.45, {{-0.3, -0.2}, {0.3, -0.3}, {-0.2, 0.3}, {0.2, 0.3}, {0.6, 0}}, 4};
}

Tracer tracer_with_depth() {
  Scene scene = seed_fig6(90);
  scene.surfaces.push_back(LatLong{});
  TraceSettings settings;
  settings.effects.depth = true;
  return {scene, plan_trace(scene, settings)};
}

void append(const UnsetVector<float>& from, std::size_t first, int rows, std::vector<float>& to) {
  const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
  to.insert(to.end(), begin, begin + std::ptrdiff_t{rows} * 90);
}

TEST(MapBands, AreTheWholeCutIntoPieces) {
  const Tracer tracer = tracer_with_depth();
  std::vector<LensMap> whole = trace_maps(tracer);
  filter_coverage(tracer, some_filter(), ThinCoverage(tracer, 0.45), {0, 90}, whole);
  for (const std::vector<int>& cuts : {std::vector<int>{90}, {64, 90}, {1, 2, 3, 7, 8, 40, 41, 89, 90}}) {
    MapBands bands(tracer, some_filter());
    std::vector<std::vector<float>> channels(8);  // s, t, valid and depth of two surfaces
    int finished = 0;
    for (const int cut : cuts) {
      const RowRange rows = bands.trace_until(cut);
      ASSERT_EQ(rows.begin, finished);
      finished = rows.end;
      for (std::size_t k = 0; k < 2; ++k) {
        const LensMap& map = bands.maps()[k];
        const UnsetVector<float>* samples[] = {&map.s, &map.t, &map.valid, &map.passes[0].values};
        for (std::size_t c = 0; c < 4; ++c)
          append(*samples[c], bands.first_sample(), rows.end - rows.begin, channels[4 * k + c]);
      }
    }
    ASSERT_EQ(finished, 90);
    for (std::size_t k = 0; k < 2; ++k) {
      const UnsetVector<float>* samples[] = {&whole[k].s, &whole[k].t, &whole[k].valid,
                                             &whole[k].passes[0].values};
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_TRUE(std::equal(samples[c]->begin(), samples[c]->end(), channels[4 * k + c].begin(),
                               channels[4 * k + c].end()))
            << cuts.size() << ' ' << k << ' ' << c;
      }
    }
  }
}

TEST(MapBands, WithoutAFilterTheyAreWhatCentresSee) {
  const Tracer tracer = tracer_with_depth();
  const std::vector<LensMap> whole = trace_maps(tracer);
  MapBands bands(tracer, std::nullopt);
  EXPECT_EQ(bands.trace_until(64).end, 64);
  std::vector<float> valid;
  append(bands.maps()[0].valid, bands.first_sample(), 64, valid);
  EXPECT_EQ(bands.trace_until(90).begin, 64);
  append(bands.maps()[0].valid, bands.first_sample(), 26, valid);
  EXPECT_TRUE(std::equal(valid.begin(), valid.end(), whole[0].valid.begin(), whole[0].valid.end()));
  EXPECT_EQ(bands.rays(), 90 * 90);
}

}  // namespace
}  // namespace lensplane
