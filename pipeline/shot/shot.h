// SPDX-License-Identifier: Apache-2.0
//
// A shot: everything that a shot file says, as plain data in SI units, over all its frames.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/image/exr_format.h"
#include "pipeline/image/image_choice.h"
#include "pipeline/shot/keyed.h"
#include "pipeline/shot/location.h"
#include "src/plan.h"

namespace lensplane {

/// A name that the shot gives to something outside of it, with the place to blame when it does not exist.
struct LocatedText {
  std::string text;
  Location location;
  std::string key;
};

/// The narrowest field of view, in radians: narrower ones cannot be told from nothing in double precision.
inline constexpr double kNarrowestFov = 1e-15;

/// The most pixels of a frame, overscan included: 16384 x 16384.
inline constexpr int kMaxFilmPixels = 1 << 28;

/// A perspective camera's field of view as the focal length of a lens.
struct FocalLength {
  Keyed<double> focal_length;  // metres
  Keyed<double> film_width;    // metres
  Location location;
};

struct LensIndex {
  std::size_t index;
};
struct LayerIndex {
  std::size_t index;
};

/// What the camera looks at: a point, a lens, or a layer with a centre.
struct LookAt {
  std::variant<Keyed<Vec3>, LensIndex, LayerIndex> target;
  Keyed<Direction> up = Keyed<Direction>::constant({{0, 1, 0}});
  Location location;
};

/// Angles about x, y, z in radians, applied in the order z, x, y.
struct Rotation {
  Keyed<Vec3> angles;
};

/// Light that is scattered in the camera; see Glow.
struct GlowTrack {
  Keyed<double> strength;  // share of the light
  Keyed<double> radius;    // share of the frame's width
};

/// When light is let in, in frames from the frame itself, and at how many moments between.
struct Shutter {
  Keyed<double> open, close;
  std::optional<int> samples = 1;  // nothing: as many as what moves on the film needs
};

/// What a camera's position, rotation and field of view are taken from: a file of another program, or what
/// the images of a plate say.
struct CameraFile {
  LocatedText path;  // .chan; of a plate: empty
  bool is_plate = false;
  std::optional<LayerIndex> plate;  // nothing: the only one
  double unit = 1;                  // metres that one unit of length of the file is
  bool fov_is_given = false;        // by the shot
};

struct CameraTrack {
  int width = 0;
  int height = 0;
  std::optional<int> overscan = 0;  // pixels on every side; nothing: as much as the lenses need
  Projection projection = Projection::Perspective;
  std::variant<Keyed<double>, FocalLength> fov;  // radians, as Camera::fov_rad
  Keyed<Vec3> position;
  std::variant<Rotation, LookAt> orientation;
  Shutter shutter;
  std::optional<GlowTrack> glow;
  Keyed<double> exposure;          // stops, of the picture
  std::optional<CameraFile> from;  // of which read_shot() has made the above
};

struct LensTrack {
  std::string name;
  Keyed<double> m;  // geometric mass, metres
  Keyed<Vec3> position;
};

/// What lies outside of a plate.
enum class Edge { Black, Clamp, Mirror, Repeat };

/// How a picture's colours and its alpha belong together.
enum class AlphaKind { Associated, Straight, None };

/// What is seen in a frame whose image is not there: nothing, the one before it (or, before the first, the
/// first), or transparent black.
enum class Missing { Error, Hold, Black };

struct LayerImage {
  LocatedText pattern;  // a path, or that of a sequence; see path_of_frame
  std::optional<LocatedText> space;
  std::optional<AlphaKind> alpha;  // absent: as the file says
  ImageChoice choice = {};
  Missing missing = Missing::Error;  // of a sequence
};

struct PlateLayer {
  Edge edge = Edge::Black;
  std::optional<Keyed<double>> distance = {};  // metres along the camera's axis; nothing: at infinity
  bool bent = false;                           // a picture of light that lenses have bent already
};
struct LatLongLayer {};
struct SphereLayer {
  Keyed<Vec3> centre;
  Keyed<double> radius;
  Keyed<Vec3> rotation;                                       // as Rotation
  std::optional<Keyed<Direction>> light;                      // towards the light
  Keyed<double> light_diameter = Keyed<double>::constant(0);  // radians; 0: a point
  std::optional<LayerImage> night;  // seen where the light does not come; only with light
};
struct RingLayer {
  std::variant<Keyed<Vec3>, LayerIndex> centre;  // or that of a sphere
  Keyed<Direction> normal;
  Keyed<double> inner, outer;                                 // metres
  std::optional<LayerIndex> shadow_of;                        // the sphere whose shadow falls on it
  std::optional<Keyed<Direction>> light;                      // of that shadow; nothing: the sphere's
  Keyed<double> light_diameter = Keyed<double>::constant(0);  // of that, radians; 0: a point
};
struct StarsLayer {
  LocatedText catalogue;   // a path
  Keyed<double> exposure;  // stops
  Keyed<Vec3> rotation;    // as Rotation
};

/// What a POV-Ray scene is rendered as: the camera's view without lenses, everything around the camera, or
/// what the bent rays themselves meet.
enum class PovRayAs { Plate, LatLong, Bent };

/// A scene that POV-Ray renders, frame by frame, into the image of its layer.
struct PovRayScene {
  static constexpr int kBentAntialias = 2;

  LocatedText scene;  // a path
  PovRayAs as = PovRayAs::Plate;
  double unit_m = 1.0;            // metres that one unit of the scene is
  int antialias = 3;              // n x n rays in a pixel; bent: in each, otherwise where neighbours differ
  std::optional<int> width = {};  // pixels of a lat-long; nothing: as fine as the camera sees, up to 4096
  double timeout_s = 600.0;       // without progress until POV-Ray is taken to hang
};

struct Layer {
  std::string name;
  LayerImage image;  // stars have none
  std::variant<PlateLayer, LatLongLayer, SphereLayer, RingLayer, StarsLayer> kind;
  std::optional<PovRayScene> povray = {};  // what renders the image
  Keyed<double> exposure = {};             // stops; stars have their own
};

/// A grade by an ASC CDL, for the picture for review.
struct GradeSettings {
  LocatedText cdl;                   // path
  std::string id;                    // of one correction in the file; empty: the first
  std::optional<LocatedText> space;  // absent: the working space
};

struct ColourSettings {
  std::optional<LocatedText> config;  // path
  LocatedText working{"ACEScg", {}, "colour.working"};
  LocatedText display{"sRGB - Display", {}, "colour.display"};
  LocatedText view{"ACES 1.0 - SDR Video", {}, "colour.view"};
  std::optional<GradeSettings> grade;
};

/// What the picture is where light ends in a mass: black, or nothing.
enum class HoleShadow { Opaque, Transparent };

/// What the shot asks of the trace; see trace_at.
struct TraceTrack {
  Method method = Method::Planes;
  std::optional<Law> law;  // nothing: as the tolerance needs it
  Keyed<double> tolerance_px = Keyed<double>::constant(TraceSettings().tolerance_px);
  Choice finite_distance = Choice::Auto;
  HoleShadow shadow = HoleShadow::Opaque;
};

/// How finely a pixel of the picture is sampled.
struct SamplingSettings {
  int max = 64;              // rays in a pixel at most: a power of 4
  double threshold = 0.004;  // standard error, as an eye sees it, up to which a pixel has enough of them
};

/// The file of the picture for review: 8 or 16 bits.
enum class ReviewFormat { Png, Png16, Tiff16 };

/// Where the picture of where the sources are goes.
enum class Locator { None, Beside };

/// What the coverage of a map says: how much of a pixel sees the layer, or whether its centre does.
enum class Coverage { Filtered, Binary };

struct OutputSettings {
  std::filesystem::path directory;
  ExrFormat image;
  std::vector<bool> maps;  // per layer; never of stars
  Coverage coverage = Coverage::Filtered;
  Effects data;  // passes of the data files, which stand beside the maps; none without maps
  std::optional<ReviewFormat> review = ReviewFormat::Png;
  Keyed<double> review_exposure;  // stops, beside that of the picture
  Locator locator = Locator::None;
};

struct Shot {
  std::string file;
  std::string name;
  std::vector<int> frames;
  Rational fps{24, 1};
  CameraTrack camera;
  std::vector<LensTrack> lenses;
  std::vector<Layer> layers;
  TraceTrack trace;
  SamplingSettings sampling;
  ColourSettings colour;
  OutputSettings output;
};

}  // namespace lensplane
