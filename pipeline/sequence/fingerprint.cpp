// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/fingerprint.h"

#include <OpenImageIO/hash.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>

#include "pipeline/image/failure.h"
#include "pipeline/image/version.h"

namespace lensplane {
namespace {

void add_scene(Fingerprint& print, const Scene& scene) {
  const Camera& camera = scene.camera;
  print.add(camera.width).add(camera.height).add(camera.overscan).add(camera.fov_rad);
  print.add(static_cast<int>(camera.projection));
  print.add(camera.position).add(camera.axes);
  for (const Lens& lens : scene.lenses) print.add("lens").add(lens.m).add(lens.position);
  for (const Surface& surface : scene.surfaces) {
    if (const auto* plate = std::get_if<Plate>(&surface)) print.add(plate->bent ? "bent plate" : "plate");
    if (std::holds_alternative<LatLong>(surface)) print.add("latlong");
    if (const auto* sphere = std::get_if<Sphere>(&surface)) {
      print.add("sphere").add(sphere->centre).add(sphere->radius).add(sphere->axes);
    }
    if (const auto* ring = std::get_if<Ring>(&surface)) {
      print.add("ring").add(ring->centre).add(ring->axes).add(ring->inner).add(ring->outer);
      print.add(ring->crossing);
    }
    if (const auto* card = std::get_if<Card>(&surface)) {
      print.add("card").add(card->distance).add(card->crossing);
    }
  }
}

/// Where the masses are follows from the scene: only what the plan makes of them is added.
void add_recipe(Fingerprint& print, const Deflectors& recipe) {
  print.add("recipe").add(static_cast<double>(recipe.outward)).add(recipe.finite_distance);
  print.add(recipe.flat).add(recipe.blind);
  for (const DeflectorPlane& plane : recipe.planes) {
    print.add("plane");
    for (const Deflector& deflector : plane.deflectors) {
      print.add(static_cast<double>(deflector.lens)).add(static_cast<int>(deflector.law));
      print.add(deflector.index);
    }
  }
}

void add_plan(Fingerprint& print, const Plan& plan) {
  print.add(std::string(name_of(plan.method)));
  if (plan.method == Method::Geodesic) print.add(plan.geodesic_tolerance);
  for (const Deflectors& recipe : plan.recipes) add_recipe(print, recipe);
  const TileLevels& tiles = plan.tiles;
  print.add("tiles").add(tiles.size).add(tiles.columns).add(tiles.rows);
  print.add(std::string(tiles.level.begin(), tiles.level.end()));
  if (std::none_of(tiles.curved.begin(), tiles.curved.end(), [](std::uint8_t c) { return c != 0; })) return;
  print.add("curved").add(std::string(tiles.curved.begin(), tiles.curved.end()));
  print.add(plan.geodesic_tolerance).add(static_cast<double>(plan.masses.size()));
  for (const PointMass& mass : plan.masses) print.add(mass.m).add(mass.position);
}

}  // namespace

Fingerprint& Fingerprint::add(const std::string& text) {
  text_ += fmt::format("{}:{};", text.size(), text);
  return *this;
}

Fingerprint& Fingerprint::add(double value) {
  text_ += fmt::format("{:a};", value);
  return *this;
}

Fingerprint& Fingerprint::add_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  OIIO::SHA1 hash;
  std::vector<char> block(1 << 16);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0) {
    hash.append(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof()) throw Failure(ExitCode::BadInput, path.string() + ": cannot be read");
  return add(hash.digest());
}

std::string Fingerprint::digest() const {
  return OIIO::SHA1::digest(text_.data(), text_.size());
}

Fingerprint fingerprint_of_trace(const Scene& scene, const Plan& plan) {
  Fingerprint print;
  print.add(kVersion);
  add_scene(print, scene);
  add_plan(print, plan);
  return print;
}

}  // namespace lensplane
