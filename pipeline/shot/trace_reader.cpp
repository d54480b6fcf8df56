// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/trace_reader.h"

#include <fmt/format.h>

#include <array>

namespace lensplane {
namespace {

Method read_method(const Value& value) {
  std::array<std::string_view, kMethodNames.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kMethodNames[i].name;
  return kMethodNames[value.choice(names)].method;
}

bool is_of_the_paper(Method method) {
  return method == Method::Kishi || method == Method::ShinotsukaMakino;
}

/// "\"exact\"; the method kishi has ...": `value` and why the method refuses it.
[[noreturn]] void refuse_for(const Value& value, Method method, const std::string& why) {
  value.refuse(fmt::format("{}; the method {} {}", in_quotes(value.text()), name_of(method), why));
}

/// Nothing for `auto`.
std::optional<Law> read_law(const Value& value, Method method) {
  constexpr std::string_view kAuto = "auto";
  std::array<std::string_view, kLaws.size() + 1> names;
  for (std::size_t i = 0; i < kLaws.size(); ++i) names[i] = kLaws[i].name;
  names.back() = kAuto;
  const std::string_view chosen = names[value.choice(names)];
  if (chosen == kAuto) return std::nullopt;
  if (method == Method::Geodesic) refuse_for(value, method, "follows curved rays, by no law; allowed: auto");
  if (is_of_the_paper(method) && chosen != name_of(Law::Weak))
    refuse_for(value, method, "has the weak law only; allowed: weak, auto");
  return law_named(chosen);
}

Choice read_finite_distance(const Value& value, Method method, Projection projection) {
  constexpr std::array<std::string_view, 3> kNames = {"on", "off", "auto"};
  constexpr std::array<Choice, 3> kChoices = {Choice::On, Choice::Off, Choice::Auto};
  const Choice choice = kChoices[value.choice(kNames)];
  if (choice == Choice::On && is_of_the_paper(method))
    refuse_for(value, method, "knows no finite distances; allowed: off, auto");
  if (choice == Choice::Off && method == Method::Geodesic)
    refuse_for(value, method, "follows light from where the camera is; allowed: on, auto");
  if (choice == Choice::Off && method == Method::Planes && projection != Projection::Perspective) {
    value.refuse(
        fmt::format("\"off\"; a {} camera needs finite distances: only with them are bends continuous over "
                    "the whole sphere; allowed: on, auto",
                    projection == Projection::LatLong ? "latlong" : "fisheye"));
  }
  return choice;
}

}  // namespace

TraceTrack read_trace(const std::optional<Value>& trace, Projection projection) {
  TraceTrack track;
  if (!trace) return track;
  trace->only_keys({"method", "law", "tolerance", "effects", "shadow"});
  if (const auto method = trace->find("method")) track.method = read_method(*method);
  if (const auto law = trace->find("law")) track.law = read_law(*law, track.method);
  if (const auto tolerance = trace->find("tolerance"))
    track.tolerance_px = read_keyed_positive(*tolerance, Dimension::Pixels);
  if (const auto shadow = trace->find("shadow")) {
    constexpr std::array<std::string_view, 2> kNames = {"opaque", "transparent"};
    track.shadow = static_cast<HoleShadow>(shadow->choice(kNames));
  }
  const auto effects = trace->find("effects");
  if (!effects) return track;
  effects->only_keys({"finite_distance"});
  if (const auto finite = effects->find("finite_distance"))
    track.finite_distance = read_finite_distance(*finite, track.method, projection);
  return track;
}

}  // namespace lensplane
