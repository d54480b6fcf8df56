// SPDX-License-Identifier: Apache-2.0
//
// A study: what accuracy costs in time, of one frame of a shot, as plain data.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/composite/sample_pattern.h"
#include "pipeline/study/ladder.h"
#include "pipeline/study/stopwatch.h"
#include "src/accuracy.h"
#include "src/film_grid.h"

namespace lensplane {

/// A way of tracing the frame: its time, and how far off it is.
struct TraceRow {
  Rung rung;
  double plan_s = 0;  // what planning takes
  Timing trace;       // of the frame with its overscan, without any passes
  std::optional<std::size_t> peak_bytes;

  ErrorSummary error;            // against the reference
  std::vector<RayError> errors;  // of the grid's pixels, row by row
  std::string worst_at;          // in words, where that is

  // Only by `planes`: what the plan says that it leaves out at most, pixels, infinite without limit; and what
  // it does leave out, against the same planes with everything on.
  std::optional<double> bound_px;
  ErrorSummary left_out;
  bool violated = false;

  bool pareto = false;  // no other is both as fast and as right

  double seconds() const { return plan_s + trace.median_s; }
};

/// What the errors are measured against: curved rays at the finest tolerance that is of use.
struct Reference {
  double tolerance_rad = 0;
  FilmGrid grid;                            // the pixels that are compared
  ErrorSummary own;                         // how far a trace by a hundred times this tolerance is from it
  std::optional<ErrorSummary> closed_form;  // with a single mass: how far it is from Schwarzschild's light
};

/// What an effect or a pass adds to the time of a frame.
struct Price {
  std::string name;
  bool on = false;      // in this shot
  double seconds = 0;   // that it adds; measured also where it is off, if it could be on
  double base_s = 0;    // what it is added to
  double bound_px = 0;  // how far it would move what is seen, at most, if it is off
  std::string why;
};

/// What the plan has made of a lens.
struct LensFate {
  std::string name;
  LensPlan plan;
};

/// A way of sampling the picture.
struct PictureRow {
  Sampling sampling;
  TraceSettings trace;
  bool of_shot = false;
  Timing timing = {};
  std::optional<std::size_t> peak_bytes = {};
  double rays_per_pixel = 0;
  double psnr_db = 0;  // against many rays a pixel, of light; kLargestPsnr where there is no difference
  bool pareto = false;
};

struct Study {
  std::string shot;
  int frame = 0;
  Camera camera;
  std::size_t masses = 0;
  int threads = 0;
  std::string processor;

  Reference reference;
  std::vector<TraceRow> traces;
  std::vector<std::string> notes;  // what was left out of the study, and why

  std::vector<Price> prices;
  std::vector<LensFate> lenses;
  double left_out_px = 0;  // at most, by the shot's own plan

  std::vector<PictureRow> pictures;
  int truth_rays = 0;    // in each pixel of the truth
  int truth_pixels = 0;  // that pictures are compared at

  std::string advice;
  bool interrupted = false;

  /// Rays of the frame, overscan included, that a row traces in a second.
  double rays_per_s(const TraceRow& row) const {
    return static_cast<double>(camera.full_width()) * camera.full_height() / row.trace.median_s;
  }
};

/// How much work goes into a study.
struct StudyEffort {
  int most_rays = 32768;   // compared of the frame; fewer with more than four masses, see rays_of()
  Repeats repeats;         // of every row
  int truth_tiles = 8;     // each way, that pictures are compared at
  int truth_rays = 32;     // each way, in a pixel
  double pictures_s = 40;  // of all pictures: ways of sampling that come after that are left out
};

}  // namespace lensplane
