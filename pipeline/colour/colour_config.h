// SPDX-License-Identifier: Apache-2.0
//
// Colour management: an OpenColorIO config, and the two ways in which it is used: from an image file's
// encoding to the working space, and from the working space to a display.

#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <optional>
#include <string>
#include <vector>

#include "pipeline/image/encoded_image.h"
#include "pipeline/image/exr_format.h"
#include "pipeline/image/picture.h"

namespace lensplane {

/// What the colours of an image file mean.
struct ImageEncoding {
  std::string space;                  // a colour space of the config
  std::optional<bool> premultiplied;  // absent: as the file says
  bool ignore_alpha = false;
};

/// A grade by the numbers of the ASC: slope, offset, power, saturation.
struct Grade {
  std::string cdl;    // the path of a .cc, .ccc or .cdl
  std::string id;     // of the correction in a file of several; empty: the first
  std::string space;  // the colour space that its numbers are meant for
};

/// How a picture is shown.
struct ViewSettings {
  std::string working;  // the picture's space
  std::string display;
  std::string view;
  std::optional<Grade> grade = std::nullopt;  // before the view
};

/// The largest value of a channel: far beyond any light, and safe to add up and to interpolate.
inline constexpr float kBrightest = 1e18F;

class ColourConfig {
 public:
  /// The config of `path`, else that of `$OCIO` (`environment`, null or empty when not set), else the
  /// built-in one. Throws Failure (BadInput) that names the file which cannot be used, and why.
  static ColourConfig load(const std::optional<std::string>& path, const char* environment);

  bool has_space(const std::string& name) const;
  std::vector<std::string> spaces() const;
  std::vector<std::string> displays() const;
  std::vector<std::string> views(const std::string& display) const;

  /// The space of an image file: that of the colorInteropID in its header, `interop_id`, else (empty, or
  /// "unknown") the one that the config's file rules give to its path. Throws Failure (BadInput) when the
  /// config has no space of that ID.
  std::string space_of_file(const std::string& path, const std::string& interop_id = {}) const;

  /// The colorInteropID of what to_display makes, empty when there is none that we know.
  std::string display_interop_id(const std::string& display, const std::string& view) const;

  /// Throws Failure (BadInput) that names the grade's file when it is missing, broken, or has no such id.
  void check_grade(const Grade& grade) const;

  /// Whether light adds up in a space: linear and relative to the scene. Taken on trust from configs that do
  /// not say.
  bool is_scene_linear(const std::string& space) const;

  /// Identify what the two conversions below compute, by contents, for fingerprints.
  std::string conversion_id(const std::string& space, const std::string& working) const;
  std::string view_id(const ViewSettings& view) const;

  /// The colorInteropID of a space, empty when it has none that we know.
  std::string interop_id(const std::string& space) const;

  /// Primaries and white of a linear space that has an interop_id.
  std::optional<Chromaticities> chromaticities(const std::string& space) const;

  /// The picture in linear light in the working space, premultiplied. Pixels with a NaN or an infinity become
  /// black and are counted (Picture::not_numbers); what is brighter than kBrightest becomes that, so that one
  /// bad pixel stays one. Runs in parallel.
  Picture to_working(const EncodedImage& image, const ImageEncoding& encoding,
                     const std::string& working) const;

  /// A picture in the working space with its colours in `space`. Alpha is taken as shown over black.
  Picture to_space(const Picture& picture, const std::string& working, const std::string& space) const;

  /// The config's first display and its first view.
  ViewSettings default_view(const std::string& working) const;

  /// A picture in the working space as a display shows it. Alpha is taken as shown over black. The values are
  /// not clamped.
  Picture to_display(Picture picture, const ViewSettings& view) const;

 private:
  explicit ColourConfig(OCIO_NAMESPACE::ConstConfigRcPtr config) : config_(std::move(config)) {}

  OCIO_NAMESPACE::ConstConfigRcPtr config_;
};

}  // namespace lensplane
