// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/plate_margins.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/sequence/shutter.h"
#include "pipeline/shot/shot_scene.h"
#include "src/tracer.h"

namespace lensplane {
namespace {

/// Pixels of a frame that are looked at where many frames are.
constexpr int kRaysOfAFrame = 1 << 16;

/// The next pixels beside one that was looked at look a little farther.
constexpr int kMorePixels = 2;

/// Layers of plates, and the surfaces of a scene that show them first.
struct Plates {
  std::vector<std::size_t> layers;
  Scene scene;
};

Plates plates_at(const Shot& shot, int frame) {
  Plates plates;
  plates.scene = scene_at(shot, frame);
  plates.scene.camera.overscan = 0;
  const auto of_layers = map_surfaces_of(shot);
  std::vector<Surface> surfaces;
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    // What POV-Ray renders is as large as it has to be.
    if (!std::holds_alternative<PlateLayer>(shot.layers[k].kind) || shot.layers[k].povray) continue;
    plates.layers.push_back(k);
    surfaces.push_back(plates.scene.surfaces[*of_layers[k]]);
  }
  plates.scene.surfaces = std::move(surfaces);
  return plates;
}

/// Every `step`th pixel of every `step`th row, overscan included, by their middles.
std::vector<FilmPosition> pixels_of(const Camera& camera, int step) {
  std::vector<FilmPosition> films;
  for (int row = step / 2; row < camera.full_height(); row += step) {
    for (int column = step / 2; column < camera.full_width(); column += step) {
      films.push_back({column - camera.overscan + 0.5, row - camera.overscan + 0.5});
    }
  }
  return films;
}

/// Such that about `rays` pixels are looked at.
int step_for(const Camera& camera, int rays) {
  const double pixels = static_cast<double>(camera.full_width()) * camera.full_height();
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / rays))));
}

/// How many pixels (s, t) lies beyond the frame.
int beyond(const Camera& camera, double s, double t) {
  const double over = std::max(std::max(-s, s - 1.0) * camera.width, std::max(-t, t - 1.0) * camera.height);
  return static_cast<int>(std::ceil(std::clamp(over, 0.0, static_cast<double>(kFarthestMargin))));
}

/// For each plate, how far beyond its frame each of the film positions looks that sees it.
std::vector<std::vector<int>> lookups_beyond(const Tracer& tracer, const std::vector<FilmPosition>& films) {
  const std::size_t plates = tracer.surfaces().size(), batches = (films.size() + kBatchSize - 1) / kBatchSize;
  constexpr int kUnseen = -1;
  std::vector<std::vector<int>> result(plates, std::vector<int>(films.size(), kUnseen));
  tbb::parallel_for(std::size_t{0}, batches, [&](std::size_t n) {
    TraceBatch batch = tracer.make_batch();
    const std::size_t first = n * kBatchSize;
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const FilmPosition film = films[std::min(first + i, films.size() - 1)];
      batch.x[i] = film.x;
      batch.y[i] = film.y;
    }
    tracer.trace(batch);
    for (std::size_t k = 0; k < plates; ++k) {
      const SurfaceBatch& plate = batch.surfaces[k];
      for (std::size_t i = 0; i < kBatchSize && first + i < films.size(); ++i) {
        if (plate.outcome[i] != Outcome::Hit) continue;
        result[k][first + i] = beyond(tracer.camera(), plate.s[i], plate.t[i]);
      }
    }
  });
  for (auto& of_plate : result) std::erase(of_plate, kUnseen);
  return result;
}

PlateMargin margin_from(std::vector<int> beyond, const std::string& layer, int frame) {
  PlateMargin margin{layer, frame};
  if (beyond.empty()) return margin;
  std::sort(beyond.begin(), beyond.end());
  const auto count = static_cast<double>(beyond.size());
  const auto first_outside = std::upper_bound(beyond.begin(), beyond.end(), 0);
  margin.outside = static_cast<double>(beyond.end() - first_outside) / count;
  margin.most = beyond[static_cast<std::size_t>((1.0 - kUnserved) * (count - 1.0))];
  margin.all = beyond.back();
  return margin;
}

}  // namespace

std::vector<PlateMargin> plate_margins(const Shot& shot, int frame, int rays) {
  const Plates plates = plates_at(shot, frame);
  if (plates.layers.empty()) return {};
  TraceSettings settings = trace_at(shot, frame);
  settings.effects = {};
  const Camera& camera = plates.scene.camera;
  const int step = step_for(camera, rays);
  const auto beyond =
      lookups_beyond(Tracer(plates.scene, plan_trace(plates.scene, settings)), pixels_of(camera, step));
  std::vector<PlateMargin> margins;
  for (std::size_t k = 0; k < plates.layers.size(); ++k) {
    PlateMargin margin = margin_from(beyond[k], shot.layers[plates.layers[k]].name, frame);
    if (margin.most > 0) margin.most += kMorePixels * step;
    margins.push_back(std::move(margin));
  }
  return margins;
}

std::vector<PlateMargin> worst_margins(const Shot& shot, const std::vector<int>& frames) {
  std::vector<PlateMargin> worst;
  for (const int frame : frames) {
    const auto margins = plate_margins(shot, frame, kRaysOfAFrame);
    if (worst.empty()) worst = margins;
    for (std::size_t k = 0; k < margins.size(); ++k) {
      if (margins[k].most > worst[k].most || margins[k].outside > worst[k].outside) worst[k] = margins[k];
    }
  }
  std::erase_if(worst, [](const PlateMargin& margin) { return margin.outside == 0; });
  return worst;
}

std::string line_of(const PlateMargin& margin) {
  const std::string all = margin.all < kFarthestMargin ? fmt::format("{}", margin.all)
                                                       : fmt::format("more than {}", kFarthestMargin);
  return fmt::format(
      "layer {}: {:.2g} % of the pixels of frame {:04} look outside of the plate; {} pixels more on each "
      "side "
      "serve {:.4g} % of all, {} every one",
      margin.layer, 100 * margin.outside, margin.frame, margin.most, 100 * (1 - kUnserved), all);
}

int needed_overscan(const Shot& shot, std::size_t layer, int frame) {
  if (shot.camera.projection == Projection::LatLong) return 0;
  std::vector<int> all;
  int step = 1;
  for (const Moment& moment : moments_of(shot, frame)) {
    Scene scene = scene_at(shot, moment.time);
    scene.surfaces = {scene.surfaces[*map_surfaces_of(shot)[layer]]};
    TraceSettings settings = trace_at(shot, moment.time);
    settings.effects = {};
    step = step_for(scene.camera, kRaysOfAFrame);
    const auto beyond =
        lookups_beyond(Tracer(scene, plan_trace(scene, settings)), pixels_of(scene.camera, step));
    all.insert(all.end(), beyond.front().begin(), beyond.front().end());
  }
  const int most = margin_from(std::move(all), shot.layers[layer].name, frame).most;
  const int side = std::max(shot.camera.width, shot.camera.height);
  return most == 0 ? 0 : (std::min(most + kMorePixels * step, side) + 1) / 2 * 2;
}

Shot with_overscan(Shot shot) {
  if (shot.camera.overscan) return shot;
  shot.camera.overscan = 0;
  int most = 0;
  for (const PlateMargin& margin : worst_margins(shot, shot.frames)) most = std::max(most, margin.most);
  const int side = std::max(shot.camera.width, shot.camera.height);
  int even = (std::min(most, side) + 1) / 2 * 2;
  const auto fits = [&](int overscan) {
    return static_cast<double>(shot.camera.width + 2 * overscan) * (shot.camera.height + 2 * overscan) <=
           kMaxFilmPixels;
  };
  while (!fits(even)) even -= 2;
  shot.camera.overscan = even;
  return shot;
}

}  // namespace lensplane
