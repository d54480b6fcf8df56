// SPDX-License-Identifier: Apache-2.0
//
// What becomes of a study: advice, tables, plot, page.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "pipeline/image/failure.h"
#include "pipeline/image/image_reader.h"
#include "pipeline/study/advice.h"
#include "pipeline/study/error_map.h"
#include "pipeline/study/readable.h"
#include "pipeline/study/run_study.h"
#include "pipeline/study/study_files.h"
#include "pipeline/study/study_page.h"
#include "pipeline/study/study_plot.h"
#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::Not;

TraceRow row_of(Method method, double tolerance, double seconds, double p99) {
  TraceRow row;
  row.rung.settings.method = method;
  row.rung.settings.tolerance_px = tolerance;
  row.trace = timing_of({seconds});
  row.error = {4, 4, p99 / 2, p99, 2 * p99, 1, 0.25, 0, 0};
  row.errors = {{true, false, false, p99}, {true, false, false, 2 * p99}, {false, true, false, 0}, {}};
  row.worst_at = "(3.5, 1.5)";
  if (method == Method::Planes) row.bound_px = tolerance, row.left_out = row.error;
  return row;
}

/// The paper's method, two by planes of which the second is worse in all, and curved rays.
Study small_study() {
  Study study;
  study.shot = "a<b";
  study.frame = 1001;
  study.camera.width = 4;
  study.camera.height = 2;
  study.masses = 2;
  study.threads = 2;
  study.processor = "one & another";
  study.reference.grid = {1, 2, 2};
  study.traces = {row_of(Method::ShinotsukaMakino, 1, 0.010, 0.4), row_of(Method::Planes, 0.1, 0.014, 0.05),
                  row_of(Method::Planes, 0.5, 0.020, 0.05), row_of(Method::Geodesic, 1e-4, 3, 0)};
  study.traces[1].rung.of_shot = true;
  study.prices = {{"glow", true, 0.5, 1, 0, "the camera scatters light"},
                  {"delay", false, 0.2, 1, 0, "no output asks for it"}};
  study.pictures = {{{16, 0.01}, {}, true, timing_of({1, 2}), 1000000, 1.5, 40},
                    {{1, 0.01}, {}, false, timing_of({1}), std::nullopt, 1, 45}};
  mark_pareto(study);
  study.advice = advice_of(study);
  return study;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(StudyOutput, ParetoRowsHaveNoneThatIsBothFasterAndAsRight) {
  const Study study = small_study();
  EXPECT_TRUE(study.traces[0].pareto);
  EXPECT_TRUE(study.traces[1].pareto);
  EXPECT_FALSE(study.traces[2].pareto);
  EXPECT_TRUE(study.traces[3].pareto);
  EXPECT_FALSE(study.pictures[0].pareto);
  EXPECT_TRUE(study.pictures[1].pareto);
}

TEST(StudyOutput, AdviceIsTheFastestThatIsRightEnough) {
  Study study = small_study();
  EXPECT_EQ(
      study.advice,
      "for 0.1 px in 99 of 100 pixels use planes, law auto, 0.1 px, finite distance auto: 14 ms; the paper's "
      "method is 0.4 px off (0.8 px at (3.5, 1.5))");
  // What sees something else is no better for being fast.
  study.traces[0].error = {4, 4, 0.01, 0.01, 0.01, 1, 0, 0.05, 0};
  EXPECT_THAT(
      advice_of(study),
      HasSubstr("use planes, law auto, 0.1 px, finite distance auto: 14 ms; the paper's method is "
                "0.01 px off (0.01 px at (3.5, 1.5)), and sees something else in 5.0 % of the pixels"));
  mark_pareto(study);
  EXPECT_FALSE(study.traces[0].pareto);
  study = small_study();
  study.traces.resize(1);
  EXPECT_EQ(advice_of(study),
            "for 0.1 px in 99 of 100 pixels no row does; the nearest is shinotsuka-makino: 0.4 px off");
  study.traces[0].error = {};
  EXPECT_EQ(advice_of(study), "nothing in the frame could be compared with curved rays");
  study.traces.clear();
  EXPECT_EQ(advice_of(study), "nothing was traced");
}

TEST(StudyOutput, ViolatedBoundsAreRefusedByName) {
  Study study = small_study();
  EXPECT_NO_THROW(require_bounds(study));
  study.traces[2].violated = true;
  const Refusal refusal = refusal_of([&] { require_bounds(study); });
  EXPECT_EQ(refusal.code, ExitCode::BadShot);
  EXPECT_THAT(
      refusal.line,
      HasSubstr(
          "planes, law auto, 0.5 px, finite distance auto leaves out 0.1 px where it says at most 0.5 px"));
  EXPECT_THAT(page_from_study(study), HasSubstr("violated\""));
  EXPECT_THAT(csv_from_study(study), HasSubstr("finite distance auto\",0,0"));
}

TEST(StudyOutput, ReadsAsPeopleDo) {
  EXPECT_EQ(readable_seconds(0.0123), "12.3 ms");
  EXPECT_EQ(readable_seconds(1.5), "1.5 s");
  EXPECT_EQ(readable_pixels(0.00123), "0.0012 px");
  EXPECT_EQ(readable_pixels(INFINITY), "no limit");
  EXPECT_EQ(readable_share(0), "0.0 %");
  EXPECT_EQ(readable_share(1e-5), "< 0.1 %");
  EXPECT_EQ(readable_share(0.0786), "7.9 %");
  EXPECT_EQ(readable_memory(std::nullopt), "-");
  EXPECT_EQ(readable_memory(3000000), "3 MB");
  EXPECT_EQ(readable_price({"a", true, 0.5, 1, 0, ""}), "500 ms");
  EXPECT_EQ(readable_price({"a", false, 0.5, 1, 0, ""}), "would add 500 ms");
  EXPECT_EQ(readable_price({"a", true, -0.01, 1, 0, ""}), "too little to tell");
  EXPECT_EQ(readable_price({"a", true, -0.5, 1, 0, ""}), "-500 ms");
  EXPECT_EQ(readable_price({"a", false, -0.5, 1, 0, ""}), "too little to tell");
  EXPECT_EQ(readable_price({"a", false, 0, 1, 0, ""}), "-");
}

TEST(StudyOutput, CsvHasALineForEachRowOfEqualLength) {
  const std::string csv = csv_from_study(small_study());
  EXPECT_EQ(count_of(csv, "\n"), 1U + 4 + 2 + 2);
  std::istringstream lines(csv);
  std::string head;
  std::getline(lines, head);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t from = line.find('"'), to = line.rfind('"');  // of the name, which has commas
    line.erase(from, to - from);
    EXPECT_EQ(count_of(line, ","), count_of(head, ",")) << line;
  }
  EXPECT_THAT(csv, HasSubstr("trace,\"planes, law auto, 0.1 px, finite distance auto\",1,1,0.014,"));
}

TEST(StudyOutput, JsonHasEverythingWithAllDigits) {
  Study study = small_study();
  study.traces[1].bound_px = INFINITY;
  const auto json = nlohmann::json::parse(json_from_study(study));
  EXPECT_EQ(json["shot"], "a<b");
  EXPECT_EQ(json["traces"].size(), 4U);
  EXPECT_EQ(json["traces"][1]["error"]["p99_px"], 0.05);
  EXPECT_TRUE(json["traces"][1]["bound_px"].is_null());
  EXPECT_EQ(json["traces"][2]["bound_px"], 0.5);
  EXPECT_FALSE(json["traces"][0].contains("bound_px"));
  EXPECT_EQ(json["pictures"][0]["psnr_db"], 40);
  EXPECT_EQ(json["prices"][1]["on"], false);
  EXPECT_EQ(json["advice"], study.advice);
}

TEST(StudyOutput, WhatComparesNothingIsNotCalledRight) {
  Study study = small_study();
  study.traces[0].error = {4, 0, 0, 0, 0, 0, 0, 1, 0};
  mark_pareto(study);
  EXPECT_FALSE(study.traces[0].pareto);
  EXPECT_EQ(count_of(plot_of(study), "class=\"point\""), 4U);
  EXPECT_THAT(plot_of(study), HasSubstr("nothing to compare"));
  EXPECT_TRUE(nlohmann::json::parse(json_from_study(study))["traces"][0]["error"]["p99_px"].is_null());
  EXPECT_THAT(advice_of(study), HasSubstr("use planes"));
}

TEST(StudyOutput, JsonTakesAnyPath) {
  Study study = small_study();
  study.notes = {"/tmp/\xff.png: no such image"};
  EXPECT_EQ(nlohmann::json::parse(json_from_study(study))["notes"].size(), 1U);
}

TEST(StudyOutput, PlotHasAPointForEachTrace) {
  const std::string svg = plot_of(small_study());
  EXPECT_EQ(count_of(svg, "class=\"point\""), 4U);
  EXPECT_EQ(count_of(svg, "<title>"), 4U);
  EXPECT_THAT(svg, HasSubstr("class=\"front\""));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_THAT(plot_of(Study()), HasSubstr("</svg>"));
}

TEST(StudyOutput, PageHoldsAllThatItNeeds) {
  const std::string html = page_from_study(small_study());
  EXPECT_EQ(count_of(html, "src=\"data:image/png;base64,"), 4U);
  EXPECT_EQ(count_of(html, "http"), 1U);  // the name of SVG's namespace
  EXPECT_THAT(html, HasSubstr("a&lt;b, frame 1001"));
  EXPECT_THAT(html, HasSubstr("one &amp; another"));
  EXPECT_THAT(html, Not(HasSubstr("a<b")));
  Study interrupted = small_study();
  interrupted.interrupted = true;
  EXPECT_THAT(page_from_study(interrupted), HasSubstr("was interrupted"));
}

TEST(StudyOutput, ErrorColoursGrowLighter) {
  const auto lightness = [](double px) {
    const Rgba c = error_colour(px);
    return 0.3 * c[0] + 0.6 * c[1] + 0.1 * c[2];
  };
  double before = -1;
  for (double px = kLeastShownPx; px <= kMostShownPx; px *= 1.3) {
    EXPECT_GT(lightness(px), before) << px;
    before = lightness(px);
  }
  EXPECT_EQ(error_colour(0), error_colour(kLeastShownPx));
  EXPECT_EQ(error_colour(1e9), error_colour(kMostShownPx));
}

TEST(StudyOutput, ErrorMapsAreWholePngs) {
  const Study study = small_study();
  const Picture map = error_map(study.reference.grid, study.traces[0].errors);
  ASSERT_EQ(map.pixels.size(), 4U);
  EXPECT_NE(map.pixels[2], map.pixels[3]);  // validity differs, and nothing to compare
  const std::string uri = data_uri_of(map);
  const std::string head = "data:image/png;base64,";
  ASSERT_EQ(uri.substr(0, head.size()), head);
  std::string bytes;
  unsigned group = 0;
  int digits = 0;
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (const char c : uri.substr(head.size())) {
    if (c == '=') break;
    group = group << 6 | static_cast<unsigned>(alphabet.find(c));
    digits += 6;
    if (digits >= 8) bytes += static_cast<char>(group >> (digits -= 8) & 255U);
  }
  const TemporaryFolder folder;
  const EncodedImage image = read_image(folder.write("map.png", bytes));
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 2);
}

}  // namespace
}  // namespace lensplane
