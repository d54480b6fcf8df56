// SPDX-License-Identifier: Apache-2.0
//
// The half of effect_prices.h that looks at images.

#include <fmt/format.h>

#include <functional>

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

/// The picture of one instant, as it is taken, and ways of taking it without something.
class Pricing {
 public:
  Pricing(const Shot& shot, const ColourConfig& colours, ShotAssets& assets, int frame,
          const StudyEffort& effort)
      : shot_(shot),
        colours_(colours),
        assets_(assets),
        frame_(frame),
        effort_(effort),
        moment_(moments_of(shot, frame).front()),
        scene_(scene_at(shot, moment_.time)),
        looks_(looks_at(shot, scene_, assets.textures, frame, moment_.time)),
        tracer_(tracer_of(scene_)) {
    base_s_ = seconds([&] { picture_ = composite(tracer_, looks_, moment_.sampling).picture; });
  }

  void add_all(const StudyHooks& hooks, Study& study) {
    using Part = std::optional<Price> (Pricing::*)();
    for (const Part part :
         {&Pricing::edges, &Pricing::stars, &Pricing::motion_blur, &Pricing::glow, &Pricing::night,
          &Pricing::light, &Pricing::shadows, &Pricing::crossings, &Pricing::view}) {
      if ((study.interrupted = hooks.stop())) return;
      if (const auto price = (this->*part)()) {
        hooks.doing("prices: " + price->name);
        study.prices.push_back(*price);
      }
    }
  }

 private:
  template <class Work>
  double seconds(Work work) const {
    return time_repeatedly(effort_.repeats, work).median_s;
  }

  Tracer tracer_of(const Scene& scene) const {
    TraceSettings settings = trace_at(shot_, moment_.time);
    settings.effects = {};
    settings.effects.jacobian = true;
    return {scene, plan_trace(scene, settings)};
  }

  /// What the picture takes more than it would with other looks.
  Price without(const std::string& name, const std::string& why,
                const std::vector<SurfaceLook>& looks) const {
    const double plain_s = seconds([&] { composite(tracer_, looks, moment_.sampling); });
    return {name, true, base_s_ - plain_s, plain_s, 0, why};
  }
  Price added(const std::string& name, const std::string& why, double more_s) const {
    return {name, true, more_s, base_s_, 0, why};
  }
  Price off(const std::string& name, const std::string& why) const {
    return {name, false, 0, base_s_, 0, why};
  }

  std::optional<Price> edges() {
    Sampling one = moment_.sampling;
    one.max = 1;
    const double plain_s = seconds([&] { composite(tracer_, looks_, one); });
    const bool on = moment_.sampling.max > 1;
    return Price{"edges",
                 on,
                 on ? base_s_ - plain_s : 0,
                 plain_s,
                 0,
                 on ? fmt::format("up to {} rays where one is not enough", moment_.sampling.max)
                    : "one ray everywhere"};
  }
  std::optional<Price> stars() {
    if (!has_stars(shot_)) return off("stars", "the shot has none");
    double sum = 0;
    for (std::size_t k = 0; k < shot_.layers.size(); ++k) {
      if (!std::holds_alternative<StarsLayer>(shot_.layers[k].kind)) continue;
      const auto field = assets_.stars.field(k, moment_.time);
      Picture picture = picture_;
      sum += seconds([&] { add_stars(tracer_, looks_, *field, picture); });
    }
    return added("stars", "each image of each star found, and drawn", sum);
  }
  std::optional<Price> motion_blur() {
    const auto moments = moments_of(shot_, frame_);
    if (moments.size() == 1) return off("motion blur", "the shutter takes one sample");
    double all = 0;  // every moment once
    timed(all, [&] {
      for (const Moment& moment : moments) {
        const Scene scene = scene_at(shot_, moment.time);
        composite(tracer_of(scene), looks_at(shot_, scene, assets_.textures, frame_, moment.time),
                  moment.sampling);
      }
    });
    return added("motion blur", fmt::format("{} moments instead of one", moments.size()), all - base_s_);
  }
  std::optional<Price> glow() {
    const auto glow = glow_at(shot_, frame_);
    if (!glow) return off("glow", "the camera has none");
    return added("glow", "the camera scatters light", seconds([&] { with_glow(picture_, *glow); }));
  }
  std::optional<Price> night() {
    std::vector<SurfaceLook> looks = looks_;
    bool any = false;
    for (SurfaceLook& look : looks) any |= look.night != nullptr, look.night = nullptr;
    if (!any) return std::nullopt;
    return without("night side", "a second texture where no light falls", looks);
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
    return without("light", "on spheres, with their night side", looks);
  }
  std::optional<Price> shadows() {
    std::vector<SurfaceLook> looks = looks_;
    bool any = false;
    for (SurfaceLook& look : looks) any |= look.caster.has_value(), look.caster = std::nullopt;
    if (!any) return std::nullopt;
    return without("shadows on rings", "of their spheres", looks);
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
    const Tracer tracer = tracer_of(scene);
    const double plain_s = seconds([&] { composite(tracer, looks, moment_.sampling); });
    return Price{"further crossings",
                 true,
                 base_s_ - plain_s,
                 plain_s,
                 0,
                 "light goes through rings and cards more than once"};
  }
  std::optional<Price> view() {
    if (!shot_.output.review) return off("review picture", "the shot asks for none");
    const int bits = *shot_.output.review == ReviewFormat::Png ? 8 : 16;
    return added("review picture", "the view, and the file", seconds([&] {
                   const Picture display = colours_.to_display(picture_, view_of(shot_));
                   image_library().png_bytes("review.png", display, bits, {});
                 }));
  }

  const Shot& shot_;
  const ColourConfig& colours_;
  ShotAssets& assets_;
  int frame_;
  const StudyEffort& effort_;
  Moment moment_;
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
