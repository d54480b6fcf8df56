// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/fingerprint.h"

#include <OpenImageIO/hash.h>
#include <fmt/format.h>

#include <fstream>

#include "pipeline/image/failure.h"
#include "pipeline/image/version.h"

namespace lensplane {

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
  print.add(kVersion).add(std::string(name_of(plan.method)));
  const Camera& camera = scene.camera;
  print.add(camera.width).add(camera.height).add(camera.overscan).add(camera.fov_rad);
  print.add(static_cast<int>(camera.projection));
  print.add(camera.position).add(camera.axes);
  for (const Lens& lens : scene.lenses) print.add("lens").add(lens.m).add(lens.position);
  for (const Surface& surface : scene.surfaces) {
    if (std::holds_alternative<Plate>(surface)) print.add("plate");
    if (std::holds_alternative<LatLong>(surface)) print.add("latlong");
    if (const auto* sphere = std::get_if<Sphere>(&surface)) {
      print.add("sphere").add(sphere->centre).add(sphere->radius).add(sphere->axes);
    }
  }
  return print;
}

}  // namespace lensplane
