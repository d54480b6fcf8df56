// SPDX-License-Identifier: Apache-2.0
//
// What a ray sees: the surfaces that it meets, shaded, and laid over one another by their depth along it.
//
// Nearer surfaces lie over farther ones. At infinity plates lie over skies, and later ones over earlier ones;
// stars stand between skies and plates. Everything is linear light, premultiplied.

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/composite/sample_pattern.h"
#include "pipeline/composite/texture.h"
#include "src/sight.h"

namespace lensplane {

/// A ball that keeps the light from a ring, in the ring's own axes.
struct ShadowCaster {
  Vec3 centre{0};     // metres from the ring's centre
  double radius = 0;  // metres
};

/// What a ray meets on one surface.
struct SeenPoint {
  bool hit = false;
  double distance = 0;  // metres along the ray
  TextureCoordinates st{0, 0};
  Footprint footprint;
};

/// What ray `i` of a batch meets on a surface; the Jacobian has to be among its passes.
SeenPoint seen_point(const SurfaceBatch& surface, std::size_t i);

/// What a surface of the scene looks like.
struct SurfaceLook {
  std::shared_ptr<const Texture> texture;
  std::optional<Vec3> light = {};  // unit vector towards the light in the surface's own axes: spheres are
                                   // shaded by Lambert's law, rings lie in the shadow of `caster`
  std::shared_ptr<const Texture> night = {};  // spheres: what shines where the light does not reach
  std::optional<ShadowCaster> caster = {};    // rings
  float gain = 1;                             // that its light is multiplied by
  double sun = 0;                             // angular radius of the light's disc, radians; 0: a point
};

/// The colour of a surface at (s, t), under a footprint.
Rgba shade(const Surface& surface, const SurfaceLook& look, TextureCoordinates st,
           const Footprint& footprint);

/// How far the night reaches into the day of a sphere, as the cosine to the light: the twilight.
inline constexpr double kTwilight = 0.1;

/// The surfaces in the order of their depth, farthest first, as far as it does not depend on the ray: skies,
/// then everything else.
std::vector<std::size_t> order_at_infinity(const std::vector<Surface>& surfaces);

/// Looks along rays. Not for more than one thread at a time: it keeps its notes.
class Viewer {
 public:
  /// `surfaces` in camera axes, as Tracer::surfaces; `looks` in their order.
  Viewer(const std::vector<Surface>& surfaces, const std::vector<SurfaceLook>& looks);

  /// What a ray sees that meets `points`, in the order of the surfaces. Its filter is `scale` times as wide
  /// as the pixel filter; `offset`: where it lies within its pixel.
  Rgba see(std::span<const SeenPoint> points, double scale, SampleOffset offset = {0, 0});

  /// Whether what was seen last lies at least by this share, and at most by all but this share, behind a
  /// nearer surface: alphas between the two.
  bool saw_through(float share) const { return veil_ >= share && veil_ <= 1 - share; }

  /// The alpha of the nearest surface along such a ray, looked up as see() does; 0 where nothing is met.
  float nearest_alpha(std::span<const SeenPoint> points, double scale);

  /// How much of the light from behind all plates and bodies comes through along such a ray.
  float clearness(std::span<const SeenPoint> points) const;

 private:
  void sort_by_depth(std::span<const SeenPoint> points);

  const std::vector<Surface>& surfaces_;
  const std::vector<SurfaceLook>& looks_;
  std::vector<std::size_t> order_;     // farthest first, where rays do not say
  std::vector<std::size_t> by_depth_;  // farthest first, for the present ray
  float veil_ = 0;  // the alpha of the nearest surface that the last ray saw, where something was behind it
};

}  // namespace lensplane
