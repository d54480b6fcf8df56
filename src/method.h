// SPDX-License-Identifier: Apache-2.0
//
// The methods by which light can be traced, and the names that shot files give them.

#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace lensplane {

// Kishi             all sources on one plane, at their mass-weighted mean depth (T. Kishi 1999)
// ShinotsukaMakino  a lens plane at every depth where there are sources (S. Shinotsuka and M. Makino 2000)
// Planes            the same planes; each source turns the ray about itself, by a law of deflection.h
// Geodesic          no planes: curved rays through the metric of all masses
//
// The first two bend by equations (1) to (6) of the latter paper, with the weak law alpha = 4 m/b.
enum class Method { Kishi, ShinotsukaMakino, Planes, Geodesic };

struct MethodName {
  Method method;
  std::string_view name;
};

inline constexpr std::array kMethodNames = {
    MethodName{Method::Kishi, "kishi"},
    MethodName{Method::ShinotsukaMakino, "shinotsuka-makino"},
    MethodName{Method::Planes, "planes"},
    MethodName{Method::Geodesic, "geodesic"},
};

constexpr std::string_view name_of(Method method) {
  for (const MethodName& entry : kMethodNames) {
    if (entry.method == method) return entry.name;
  }
  return {};
}

constexpr std::optional<Method> method_named(std::string_view name) {
  for (const MethodName& entry : kMethodNames) {
    if (entry.name == name) return entry.method;
  }
  return std::nullopt;
}

}  // namespace lensplane
