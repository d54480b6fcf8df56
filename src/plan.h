// SPDX-License-Identifier: Apache-2.0
//
// The plan: what is simulated for a scene, and why, as a value that can be printed and tested.
//
// By `planes` with the law left open, every choice comes with a bound, in pixels of the output frame, on what
// it leaves out: how far aside of its place any film position looks for it. (Where light is magnified, points
// lie farther off on the film.) The bounds add up to no more than the tolerance, but for what masses do
// together, which is no choice and is told beside them; see plan_bounds.h.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/batch.h"
#include "src/deflectors.h"
#include "src/effects.h"
#include "src/method.h"
#include "src/plan_tiles.h"
#include "src/projection.h"

namespace lensplane {

enum class Choice { Auto, On, Off };

/// What the shot asks of the trace.
struct TraceSettings {
  Method method = Method::Planes;
  std::optional<Law> law;                 // nothing: as the tolerance needs it
  double tolerance_px = 0.05;             // how far aside pixels may look, in pixels of the frame, > 0
  Choice finite_distance = Choice::Auto;  // of the camera and of surfaces
  Effects effects;                        // called for by outputs
};

/// What becomes of one lens of the scene.
struct LensPlan {
  std::size_t lens = 0;  // its number in the scene
  bool culled = false;   // left out, but near masses
  Law law = Law::Weak;   // the highest that it needs; near masses all are exact, here if the whole film is
  double moves_px = 0;   // how far it moves what is seen, at most, over the film; infinite near its shadow
  double bound_px = 0;   // how much of that is left out, at most
  std::string reason;
  bool company = false;  // of the exact law: what the other masses add to it counts (company.h)
};

/// The name of what masses do together, among the effects.
inline constexpr std::string_view kJointEffect = "masses together";

/// What becomes of one effect.
struct EffectPlan {
  std::string name;
  bool on = false;
  double bound_px = 0;  // how far what is left out of it would move what is seen, at most
  std::string reason;
  double share = 0;  // of the film where it is simulated; of the finite distance perhaps only near masses
};

/// Curved rays take time in proportion to the masses: past more of them than this bodies stay with chords.
inline constexpr std::size_t kMostCurvedMasses = 200;

/// The name of the curved rays by which bodies are met, among the effects.
inline constexpr std::string_view kCurvedEffect = "curved rays";

struct Plan {
  Method method = Method::Planes;
  Effects effects;                  // what is computed beside (s, t)
  std::vector<LensPlane> planes;    // of the paper's methods, as lens_planes orders them
  std::vector<Deflectors> recipes;  // of `planes`: cheapest first; the last simulates everything asked for
  TileLevels tiles;
  std::vector<PointMass> masses;     // that curved rays meet, in camera axes
  double geodesic_tolerance = 1e-9;  // radians

  std::vector<LensPlan> lenses;     // by `planes`, in the order of the scene
  std::vector<EffectPlan> choices;  // every effect; by `planes` first the finite distance, then what masses
                                    // do together, and, where there are bodies, what meets them
  double near_masses = 0;  // the share of the film whose tiles are wild (plan_bounds.h): nothing is left out
  double bound_px = 0;     // all that is left out, at most
};

/// Rounding, in pixels, comes on top of all bounds.
inline constexpr double kRoundingPx = 1e-8;

/// By `geodesic` the direction of a ray is followed to this share of the tolerance.
inline constexpr double kGeodesicShare = 0.1;

/// What it takes to trace `scene`.
Plan plan_trace(const Scene& scene, const TraceSettings& settings);

/// By `method` with nothing left out, nothing else called for.
Plan plan_trace(const Scene& scene, Method method);

/// The recipe of the tile in which a film position lies.
std::size_t level_at(const Plan& plan, const Camera& camera, FilmPosition film);

/// Are bodies met by curved rays at a film position? What lies at infinity is seen by the tile's recipe.
bool curves_at(const Plan& plan, const Camera& camera, FilmPosition film);

/// By how much chords would misplace bodies at a film position at most, in pixels; infinite without a bound.
double chords_px_at(const Plan& plan, const Camera& camera, FilmPosition film);

/// The share of the film, overscan included, that each recipe traces.
std::vector<double> recipe_shares(const Plan& plan, const Camera& camera);

/// The least and the highest recipe of the tiles that the film positions span.
struct LevelRange {
  std::size_t least, most;
};
LevelRange levels_of(const Plan& plan, const Camera& camera, const BatchArray& x, const BatchArray& y);

}  // namespace lensplane
