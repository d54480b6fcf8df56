// SPDX-License-Identifier: Apache-2.0
//
// The light of spheres and rings that are thinner than a few pixels: rays over their images, wherever these
// are, each of which counts for the pixels round it.
//
// The pixel filter is the Gaussian of footprint.h, divided by its sum over all pixels: so what a thin body
// adds to a picture does not depend on where between pixels it is.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/composite/layering.h"
#include "src/thin_images.h"

namespace lensplane {

/// Rays count for pixels whose centres are nearer than this along either axis, in pixels.
inline constexpr int kThinReach = 2;

/// The weight of light `off` pixels beside a pixel's centre, along one axis. Over all pixels weights add up
/// to 1.
double pixel_weight(double off);

/// A ray over a thin image.
struct ThinRay {
  FilmPosition film;
  double area;        // of the film that it stands for, square pixels
  double scale;       // its filter's width in units of kPixelSigma
  std::size_t image;  // number of the image
};

/// The thin images on a camera's film.
class ThinBodies {
 public:
  ThinBodies() = default;  // none
  explicit ThinBodies(const Tracer& tracer);

  /// Are there none?
  bool empty() const { return images_.empty(); }

  /// What the rays are traced by: curved light to a small part of the smallest images.
  const Tracer& tracer() const { return *tracer_; }

  /// The rays whose light counts for the pixels from (left, top), of which there are width x height, as film
  /// positions.
  std::vector<ThinRay> rays_around(double left, double top, int width, int height) const;

  /// The thin image on which a ray through `film` that meets `points` finds its body: the first one. -1 where
  /// there is none, and the ray counts as any other.
  std::ptrdiff_t image_of(FilmPosition film, std::span<const SeenPoint> points) const;

  /// How much of the pixel with that centre thin images of a surface cover, as the pixel filter weighs the
  /// film, whatever lies before them.
  double coverage(FilmPosition centre, std::size_t surface) const;

  /// The body that an image is of, as the number of its surface.
  std::size_t surface(std::size_t image) const { return images_[image].surface; }

 private:
  std::span<const ThinImage> in_pixel(int column, int row) const;

  std::optional<Tracer> tracer_;
  int left_ = 0, top_ = 0, width_ = 0, height_ = 0;  // pixels of the film, and beside it
  std::vector<ThinImage> images_;                    // by pixels, row by row
  std::vector<std::uint32_t> first_;                 // of each pixel
};

}  // namespace lensplane
