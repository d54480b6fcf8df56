// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/statistics.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pipeline/sequence/progress.h"

namespace lensplane {
namespace {

FrameReport example_report() {
  FrameReport report;
  report.frame = 1001;
  report.seconds = 0.5;
  report.rays = 4'000'000;
  report[Phase::Trace] = {0.25, 1000};
  report[Phase::Write] = {0.125, 500};
  report.amplifications = {{"earth", 4.46}, {"moon", std::nullopt}};
  return report;
}

TEST(Statistics, HaveSecondsAndBytesPerPhaseAndTheFactors) {
  FrameReport second = example_report();
  second.frame = 1002;
  const auto json = nlohmann::json::parse(json_from_reports("shot", 2, 1.5, {example_report(), second}));
  EXPECT_EQ(json["shot"], "shot");
  EXPECT_EQ(json["threads"], 2);
  EXPECT_EQ(json["seconds"], 1.5);
  EXPECT_EQ(json["rays"], 8'000'000);
  EXPECT_EQ(json["phases"]["trace"]["seconds"], 0.5);
  EXPECT_EQ(json["phases"]["write"]["bytes"], 1000);
  ASSERT_EQ(json["frames"].size(), 2U);
  EXPECT_EQ(json["frames"][0]["frame"], 1001);
  EXPECT_EQ(json["frames"][0]["amplification"]["earth"], 4.46);
  EXPECT_TRUE(json["frames"][0]["amplification"]["moon"].is_null());
}

TEST(Statistics, FramesAreReportedInALine) {
  EXPECT_EQ(line_of(example_report()),
            "1001: 0.50 s, 8.0 million rays/s, A(earth) = 4.460, A(moon): not in the frame without lenses");
  FrameReport done = example_report();
  done.already_done = true;
  done.amplifications.pop_back();
  EXPECT_EQ(line_of(done), "1001: already done, A(earth) = 4.460");
}

}  // namespace
}  // namespace lensplane
