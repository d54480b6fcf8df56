// SPDX-License-Identifier: Apache-2.0
//
// The half of effect_prices.h that looks at images.

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/composite/compositor.h"
#include "pipeline/composite/star_layer.h"
#include "pipeline/image/display_writer.h"
#include "pipeline/image/image_library.h"
#include "pipeline/sequence/frame_looks.h"
#include "pipeline/sequence/shot_colours.h"
#include "pipeline/sequence/shot_glow.h"
#include "pipeline/sequence/shutter.h"
#include "pipeline/shot/shot_scene.h"
#include "pipeline/study/effect_prices.h"

namespace lensplane {
namespace {

/// The picture of the frame's instant, as it is taken, and ways of taking it without something.
class Pricing {
 public:
  Pricing(const Shot& shot, const ColourConfig& colours, ShotAssets& assets, int frame,
          const StudyEffort& effort)
      : shot_(shot),
        colours_(colours),
        assets_(assets),
        frame_(frame),
        effort_(effort),
        sampling_{shot.sampling.max, shot.sampling.threshold},
        scene_(scene_at(shot, frame)),
        looks_(looks_at(shot, scene_, assets.textures, frame, frame)),
        tracer_(tracer_of(scene_, frame)) {
    base_s_ = seconds([&] { picture_ = composite(tracer_, looks_, sampling_).picture; });
  }

  void add_all(const StudyHooks& hooks, Study& study) {
    struct Part {
      const char* name;
      std::optional<Price> (Pricing::*price)();
    };
    for (const Part& part : {Part{"edges", &Pricing::edges}, Part{"stars", &Pricing::stars},
                             Part{"motion blur", &Pricing::motion_blur}, Part{"glow", &Pricing::glow},
                             Part{"night side", &Pricing::night}, Part{"light", &Pricing::light},
                             Part{"shadows on rings", &Pricing::shadows},
                             Part{"further crossings", &Pricing::crossings}, Part{"view", &Pricing::view}}) {
      if ((study.interrupted = hooks.stop())) return;
      hooks.doing(std::string("prices: ") + part.name);
      std::optional<Price> price = (this->*part.price)();
      if (!price) continue;
      price->name = part.name;
      study.prices.push_back(*price);
    }
  }

 private:
  template <class Work>
  double seconds(Work work) const {
    return time_repeatedly(effort_.repeats, work).median_s;
  }

  Tracer tracer_of(const Scene& scene, double time) const {
    TraceSettings settings = trace_at(shot_, time);
    settings.effects = {};
    settings.effects.jacobian = true;
    return {scene, plan_trace(scene, settings)};
  }

  /// What the picture takes more than it would with other looks.
  Price without(const std::string& why, const std::vector<SurfaceLook>& looks) const {
    const double plain_s = seconds([&] { composite(tracer_, looks, sampling_); });
    return {"", true, base_s_ - plain_s, plain_s, 0, why};
  }
  Price added(const std::string& why, double more_s) const { return {"", true, more_s, base_s_, 0, why}; }
  Price off(const std::string& why) const { return {"", false, 0, base_s_, 0, why}; }

  std::optional<Price> edges() {
    const bool on = sampling_.max > 1;
    Sampling one = sampling_, many = sampling_;
    one.max = 1;
    if (!on) many.max = Sampling().max;
    const double plain_s = on ? seconds([&] { composite(tracer_, looks_, one); }) : base_s_;
    const double all_s = on ? base_s_ : seconds([&] { composite(tracer_, looks_, many); });
    return Price{"",      on, all_s - plain_s,
                 plain_s, 0,  fmt::format("up to {} rays where one is not enough", many.max)};
  }
  std::optional<Price> stars() {
    if (!has_stars(shot_)) return off("the shot has none");
    double sum = 0;
    for (std::size_t k = 0; k < shot_.layers.size(); ++k) {
      if (!std::holds_alternative<StarsLayer>(shot_.layers[k].kind)) continue;
      const auto field = assets_.stars.field(k, frame_);
      Picture picture = picture_;
      sum += seconds([&] { add_stars(tracer_, looks_, *field, picture); });
    }
    return added("each image of each star found, and drawn", sum);
  }
  /// A few of the moments stand for all.
  std::optional<Price> motion_blur() {
    constexpr std::size_t kFew = 4;
    const auto moments = moments_of(shot_, frame_);
    if (moments.size() == 1) return off("the shutter takes one sample");
    const std::size_t few = std::min(kFew, moments.size());
    double sum = 0;
    for (std::size_t n = 0; n < few; ++n) {
      const Moment& moment = moments[n * moments.size() / few];
      const Scene scene = scene_at(shot_, moment.time);
      const Tracer tracer = tracer_of(scene, moment.time);
      const auto looks = looks_at(shot_, scene, assets_.textures, frame_, moment.time);
      timed(sum, [&] { composite(tracer, looks, moment.sampling); });
    }
    const double all_s = sum * static_cast<double>(moments.size()) / static_cast<double>(few);
    return added(fmt::format("{} moments instead of one", moments.size()), all_s - base_s_);
  }
  std::optional<Price> glow() {
    const auto glow = glow_at(shot_, frame_);
    if (!glow) return off("the camera has none");
    return added("the camera scatters light", seconds([&] { with_glow(picture_, *glow); }));
  }
  std::optional<Price> night() {
    std::vector<SurfaceLook> looks = looks_;
    bool any = false;
    for (SurfaceLook& look : looks) any |= look.night != nullptr, look.night = nullptr;
    if (!any) return std::nullopt;
    return without("a second texture where no light falls", looks);
  }
  std::optional<Price> light() {
    std::vector<SurfaceLook> looks = looks_;
    bool any = false;
    for (std::size_t k = 0; k < looks.size(); ++k) {
      if (!looks[k].light || !std::holds_alternative<Sphere>(scene_.surfaces[k])) continue;
      any = true;
      looks[k].light = std::nullopt;
      looks[k].night = nullptr;
    }
    if (!any) return std::nullopt;
    return without("on spheres, with their night side", looks);
  }
  std::optional<Price> shadows() {
    std::vector<SurfaceLook> looks = looks_;
    bool any = false;
    for (SurfaceLook& look : looks) any |= look.caster.has_value(), look.caster = std::nullopt;
    if (!any) return std::nullopt;
    return without("of their spheres", looks);
  }
  std::optional<Price> crossings() {
    const std::vector<LayerSurface> surfaces = surfaces_of(shot_);
    Scene scene = scene_;
    std::vector<SurfaceLook> looks;
    scene.surfaces.clear();
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      if (surfaces[k].crossing > 0) continue;
      scene.surfaces.push_back(scene_.surfaces[k]);
      looks.push_back(looks_[k]);
    }
    if (looks.size() == looks_.size()) return std::nullopt;
    const Tracer tracer = tracer_of(scene, frame_);
    const double plain_s = seconds([&] { composite(tracer, looks, sampling_); });
    return Price{"",      true, base_s_ - plain_s,
                 plain_s, 0,    "light goes through rings and cards more than once"};
  }
  std::optional<Price> view() {
    if (!shot_.output.review) return off("the shot asks for no picture for review");
    const int bits = *shot_.output.review == ReviewFormat::Png ? 8 : 16;
    return added(fmt::format("of the picture for review, and its file of {} bits", bits), seconds([&] {
                   const Picture display = colours_.to_display(picture_, view_of(shot_));
                   image_library().png_bytes("view.png", display, bits, {});
                 }));
  }

  const Shot& shot_;
  const ColourConfig& colours_;
  ShotAssets& assets_;
  int frame_;
  const StudyEffort& effort_;
  Sampling sampling_;
  Scene scene_;
  std::vector<SurfaceLook> looks_;
  Tracer tracer_;
  Picture picture_;
  double base_s_ = 0;
};

}  // namespace

void price_pictures(const Shot& shot, const ColourConfig& colours, ShotAssets& assets, int frame,
                    const StudyEffort& effort, const StudyHooks& hooks, Study& study) {
  hooks.doing("prices: the picture");
  Pricing(shot, colours, assets, frame, effort).add_all(hooks, study);
}

}  // namespace lensplane
