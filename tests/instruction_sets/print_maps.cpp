// SPDX-License-Identifier: Apache-2.0
//
// Prints the numbers of some maps, every method, law and effect, with all their digits: built once as the
// program is, and once for no more than the processor's baseline, to be compared.

#include <cmath>
#include <cstdio>

#include "src/constants.h"
#include "src/tracer.h"

namespace lensplane {
namespace {

Scene scene_with(Projection projection, const Surface& surface) {
  Scene scene;
  scene.camera.projection = projection;
  scene.camera.width = 32;
  scene.camera.height = 16;
  scene.camera.fov_rad = projection == Projection::Perspective ? 0.3 : kPi;
  scene.surfaces = {surface};
  scene.lenses = {{1e5, {2e7, 1e7, -1e9}},
                  {5e5, {-4e7, 3e6, -1.2e9}},
                  {3e4, {3e7, -2e7, -1.2e9}},
                  {2e5, {1e8, 1e7, 5e8}}};
  return scene;
}

/// Near critical curves a magnification is one over the small number that is traced, and knows no more
/// digits.
double known_part(double magnification) {
  return std::abs(magnification) > 1.0 ? 1.0 / magnification : magnification;
}

void print(const Scene& scene, const TraceSettings& settings) {
  const Tracer tracer(scene, plan_trace(scene, settings));
  TraceBatch batch = tracer.make_batch();
  for (int row = 0; row < scene.camera.height; row += kBatchSize / scene.camera.width) {
    for (int i = 0; i < kBatchSize; ++i) {
      batch.x[i] = i % scene.camera.width + 0.5;
      batch.y[i] = row + i / scene.camera.width + 0.5;
    }
    tracer.trace(batch);
    const SurfaceBatch& s = batch.surfaces.front();
    for (int i = 0; i < kBatchSize; ++i) {
      std::printf("%d %.17g %.17g", static_cast<int>(s.outcome[i]), s.s[i], s.t[i]);
      if (s.passes) {
        const PassBatch& p = *s.passes;
        std::printf(" %.17g %.17g %.17g %.17g", p.ds_dx[i], p.ds_dy[i], p.dt_dx[i], p.dt_dy[i]);
        std::printf(" %.17g %.17g %.17g %.17g", known_part(p.magnification[i]), p.delay[i], p.dir_x[i],
                    p.bends[i]);
      }
      std::printf("\n");
    }
  }
}

void print_all() {
  const Effects all{true, true, true, true, true, true, true};
  for (const Projection projection : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    for (const Surface& surface :
         {Surface(Plate{}), Surface(LatLong{}), Surface(Sphere{{0, 0, -2e9}, 3e8, {}}), Surface(Card{1.5e9}),
          Surface(Ring{{0, 0, -2e9}, basis_from_zxy({0.5, 0, 0.2}), 1e8, 5e8})}) {
      const Scene scene = scene_with(projection, surface);
      for (const Effects& effects : {Effects{}, all}) {
        for (const MethodName& entry : kMethodNames) {
          TraceSettings settings;
          settings.method = entry.method;
          settings.effects = effects;
          print(scene, settings);
          if (entry.method != Method::Planes) continue;
          for (const LawEntry& law : kLaws) {
            settings.law = law.law;
            print(scene, settings);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace lensplane

int main() {
  lensplane::print_all();
}
