// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/statistics.h"

#include <nlohmann/json.hpp>

#include "pipeline/image/version.h"

namespace lensplane {
namespace {

using Json = nlohmann::ordered_json;

Json json_from_phases(const FrameReport& report) {
  Json phases;
  for (std::size_t i = 0; i < kPhaseNames.size(); ++i) {
    phases[std::string(kPhaseNames[i])] = {{"seconds", report.phases[i].seconds},
                                           {"bytes", report.phases[i].bytes}};
  }
  return phases;
}

Json json_from_report(const FrameReport& report) {
  Json amplification = Json::object();
  for (const Amplification& a : report.amplifications) {
    amplification[a.layer] = a.factor ? Json(*a.factor) : Json(nullptr);
  }
  Json replaced = Json::object();
  for (const ReplacedPixels& r : report.replaced) replaced[r.layer] = r.count;
  Json missing = Json::object();
  for (const MissingFrame& m : report.missing) missing[m.layer] = m.shown ? Json(*m.shown) : Json();
  return {{"replaced_pixels", replaced},
          {"missing_frames", missing},
          {"frame", report.frame},
          {"already_done", report.already_done},
          {"seconds", report.seconds},
          {"rays", report.rays},
          {"unresolved_rays", report.unresolved},
          {"phases", json_from_phases(report)},
          {"amplification", amplification}};
}

FrameReport sum_of(const std::vector<FrameReport>& reports) {
  FrameReport sum;
  for (const FrameReport& report : reports) {
    sum.rays += report.rays;
    sum.unresolved += report.unresolved;
    for (std::size_t i = 0; i < kPhaseNames.size(); ++i) {
      sum.phases[i].seconds += report.phases[i].seconds;
      sum.phases[i].bytes += report.phases[i].bytes;
    }
  }
  return sum;
}

}  // namespace

std::string json_from_reports(const std::string& shot, int threads, double seconds,
                              const std::vector<FrameReport>& reports) {
  const FrameReport sum = sum_of(reports);
  Json json = {{"lensplane", kVersion},
               {"shot", shot},
               {"threads", threads},
               {"seconds", seconds},
               {"rays", sum.rays},
               {"unresolved_rays", sum.unresolved},
               {"phases", json_from_phases(sum)},
               {"frames", Json::array()}};
  for (const FrameReport& report : reports) json["frames"].push_back(json_from_report(report));
  return json.dump(2) + "\n";
}

}  // namespace lensplane
