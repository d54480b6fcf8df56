// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/trace_reader.h"

#include <gtest/gtest.h>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/shot/example_shot.h"

namespace lensplane {
namespace {

TraceTrack trace_of(const std::string& trace) {
  return example_shot({"trace=" + trace}).trace;
}

/// The line that refuses the trace, from its key on.
std::string line_for(const std::string& trace, const std::string& camera = "") {
  std::vector<std::string> settings = {"trace=" + trace};
  if (!camera.empty()) settings.push_back("camera=" + camera);
  const Refusal refusal = refusal_of([&] { example_shot(settings); });
  if (refusal.line.empty()) return "";
  EXPECT_EQ(refusal.code, ExitCode::BadShot);
  EXPECT_EQ(refusal.line.find("--set trace:1:"), 0U) << refusal.line;
  return refusal.line.substr(refusal.line.find(": ") + 2);
}

TEST(TraceReader, WhatIsLeftOutIsPlanesAsTheToleranceNeedsIt) {
  for (const char* left_out : {"null", "{}", "{law: null}"}) {
    const TraceTrack trace = trace_of(left_out);
    EXPECT_EQ(trace.method, Method::Planes) << left_out;
    EXPECT_FALSE(trace.law) << left_out;
    EXPECT_EQ(value_at(trace.tolerance_px, 1001), 0.05) << left_out;
    EXPECT_EQ(trace.finite_distance, Choice::Auto) << left_out;
    EXPECT_EQ(trace.shadow, HoleShadow::Opaque) << left_out;
  }
}

TEST(TraceReader, ReadsEveryMethodAndLaw) {
  for (const MethodName& entry : kMethodNames)
    EXPECT_EQ(trace_of("{method: " + std::string(entry.name) + "}").method, entry.method);
  for (const LawEntry& entry : kLaws)
    EXPECT_EQ(trace_of("{law: " + std::string(entry.name) + "}").law, entry.law);
  EXPECT_FALSE(trace_of("{method: geodesic, law: auto}").law);
  EXPECT_EQ(trace_of("{method: kishi, law: weak}").law, Law::Weak);
}

TEST(TraceReader, ReadsToleranceAndEffects) {
  EXPECT_EQ(value_at(trace_of("{tolerance: 0.2 px}").tolerance_px, 1001), 0.2);
  EXPECT_EQ(value_at(trace_of("{tolerance: {keys: {1001: 0.1 px, 1003: 0.3 px}}}").tolerance_px, 1003), 0.3);
  EXPECT_EQ(trace_of("{effects: {finite_distance: on}}").finite_distance, Choice::On);
  EXPECT_EQ(trace_of("{effects: {finite_distance: off}}").finite_distance, Choice::Off);
  EXPECT_EQ(trace_of("{effects: {finite_distance: auto}}").finite_distance, Choice::Auto);
  EXPECT_EQ(trace_of("{shadow: transparent}").shadow, HoleShadow::Transparent);
  EXPECT_EQ(trace_of("{effects: {}}").finite_distance, Choice::Auto);
}

TEST(TraceReader, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(line_for("{method: newton}"),
            "trace.method: \"newton\"; allowed: kishi, shinotsuka-makino, planes, geodesic");
  EXPECT_EQ(line_for("{shadow: black}"), "trace.shadow: \"black\"; allowed: opaque, transparent");
  EXPECT_EQ(line_for("{law: strong}"), "trace.law: \"strong\"; allowed: weak, second-order, exact, auto");
  EXPECT_EQ(line_for("{tolerance: 0 px}"), "trace.tolerance: \"0 px\" is not greater than 0");
  EXPECT_EQ(line_for("{tolerance: -1 px}"), "trace.tolerance: \"-1 px\" is not greater than 0");
  EXPECT_EQ(line_for("{tolerance: 0.05}"),
            "trace.tolerance: \"0.05\" has no unit; a number of pixels is needed, in px");
  EXPECT_EQ(line_for("{tolerance: 1 deg}"),
            "trace.tolerance: \"1 deg\" is an angle; a number of pixels is needed, in px");
  EXPECT_EQ(line_for("{accuracy: 1 px}"),
            "trace.accuracy: unknown key; allowed: method, law, tolerance, effects, shadow");
  EXPECT_EQ(line_for("{effects: {gravity: on}}"),
            "trace.effects.gravity: unknown key; allowed: finite_distance");
  EXPECT_EQ(line_for("{effects: {finite_distance: maybe}}"),
            "trace.effects.finite_distance: \"maybe\"; allowed: on, off, auto");
}

TEST(TraceReader, LawsBelongToPlanes) {
  EXPECT_EQ(line_for("{method: kishi, law: exact}"),
            "trace.law: \"exact\"; the method kishi has the weak law only; allowed: weak, auto");
  EXPECT_EQ(line_for("{method: shinotsuka-makino, law: second-order}"),
            "trace.law: \"second-order\"; the method shinotsuka-makino has the weak law only; allowed: weak, "
            "auto");
  EXPECT_EQ(line_for("{method: geodesic, law: weak}"),
            "trace.law: \"weak\"; the method geodesic follows curved rays, by no law; allowed: auto");
}

TEST(TraceReader, FiniteDistancesFitTheMethodAndTheView) {
  const std::string on = "effects: {finite_distance: on}}", off = "effects: {finite_distance: off}}";
  EXPECT_EQ(line_for("{method: kishi, " + on),
            "trace.effects.finite_distance: \"on\"; the method kishi knows no finite distances; allowed: "
            "off, auto");
  EXPECT_EQ(line_for("{method: kishi, " + off), "");
  EXPECT_EQ(line_for("{method: geodesic, " + off),
            "trace.effects.finite_distance: \"off\"; the method geodesic follows light from where the camera "
            "is; allowed: on, auto");
  EXPECT_EQ(line_for("{method: geodesic, " + on), "");
  const std::string latlong = "{projection: latlong, resolution: [4, 2]}";
  const std::string fisheye = "{projection: fisheye, resolution: [4, 4], fov: 180 deg}";
  EXPECT_EQ(line_for("{" + off, latlong),
            "trace.effects.finite_distance: \"off\"; a latlong camera needs finite distances: only with them "
            "are bends continuous over the whole sphere; allowed: on, auto");
  EXPECT_EQ(line_for("{" + off, fisheye),
            "trace.effects.finite_distance: \"off\"; a fisheye camera needs finite distances: only with them "
            "are bends continuous over the whole sphere; allowed: on, auto");
  EXPECT_EQ(line_for("{method: shinotsuka-makino, " + off, latlong), "");
  EXPECT_EQ(line_for("{" + on, latlong), "");
  EXPECT_EQ(line_for("{" + off), "");
}

}  // namespace
}  // namespace lensplane
