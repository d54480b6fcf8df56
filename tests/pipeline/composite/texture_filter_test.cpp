// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/texture_filter.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "pipeline/composite/sample_pattern.h"
#include "tests/pipeline/composite/reference_filter.h"

namespace lensplane {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array kWraps = {Wrap::Black, Wrap::Clamp, Wrap::Mirror, Wrap::Repeat, Wrap::Globe};

Picture noise(int width, int height) {
  std::mt19937 random(7);
  return painted(width, height, [&](int, int) {
    const auto value = [&] { return static_cast<float>(random() % 1024) / 1023; };
    const float alpha = value();
    return Rgba{alpha * value(), alpha * value(), alpha * value(), alpha};
  });
}

Picture checker(int size) {
  return painted(size, size, [](int column, int row) {
    const float value = (column + row) % 2 == 0 ? 1.0F : 0.0F;
    return Rgba{value, value, value, 1};
  });
}

/// Footprints between the sizes, in texels to the pixel.
struct Sizes {
  double least, most;  // the shorter axis
  double longest;      // the longer axis is up to this many times as long
};

/// Signal to noise in decibels, for a peak of 1, of lookups all over the picture and beyond its edges.
double decibels(const Texture& texture, const Sizes& sizes, int lookups, double margin = 0) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  double squares = 0;
  for (int i = 0; i < lookups; ++i) {
    const TextureCoordinates st{uniform(random) * (1 + 2 * margin) - margin,
                                uniform(random) * (1 + 2 * margin) - margin};
    const double minor = sizes.least * std::pow(sizes.most / sizes.least, uniform(random));
    const double major = minor * std::pow(sizes.longest, uniform(random));
    const Footprint footprint =
        footprint_of(texture.windows(), major, minor, 2 * kPi * uniform(random), 2 * kPi * uniform(random));
    const Rgba got = texture.filtered(st, footprint), expected = reference_filtered(texture, st, footprint);
    for (std::size_t c = 0; c < 3; ++c) squares += std::pow(static_cast<double>(got[c] - expected[c]), 2) / 3;
  }
  return -10 * std::log10(squares / lookups);
}

TEST(TextureFilter, AgreesWithTheReferenceAtAnySize) {
  for (const Picture& picture : {zone_plate(256), noise(300, 200)}) {
    const Texture texture(picture, Wrap::Mirror);
    EXPECT_GT(decibels(texture, {0.51, 1.0, 1.01}, 200), 55);  // about 1:1
    EXPECT_GT(decibels(texture, {0.51, 1.05, 4}, 150), 48);    // sheared
    EXPECT_GT(decibels(texture, {1.05, 1.5, 4}, 150), 45);     // from the close to the elliptical filter
    EXPECT_GT(decibels(texture, {1.5, 5, 2}, 150), 48);        // minified
    EXPECT_GT(decibels(texture, {4, 16, 4}, 50), 50);
  }
}

TEST(TextureFilter, WhatRepeatsInTwoTexelsIsNotFarOff) {
  // No surface shows the finest checkerboard as it is; what filters of long ellipses take from it is a guess.
  const Texture texture(checker(128), Wrap::Mirror);
  EXPECT_GT(decibels(texture, {0.51, 1.0, 1.01}, 200), 55);
  EXPECT_GT(decibels(texture, {0.51, 1.05, 4}, 150), 39);
  EXPECT_GT(decibels(texture, {1.05, 1.5, 4}, 150), 39);
  EXPECT_GT(decibels(texture, {1.5, 5, 2}, 150), 48);
}

TEST(TextureFilter, LinesAndEdgesAreAsSharpAsAGaussianMakesThem) {
  // A window of another shape, however right its variance, is off by a hundredth here.
  const Texture texture(painted(256, 256,
                                [](int column, int row) {
                                  const bool ink = column / 16 % 2 == 0 || std::abs(row - column) < 3;
                                  const float value = ink ? 0.0F : 1.0F;
                                  return Rgba{value, value, value, 1};
                                }),
                        Wrap::Mirror);
  for (const double texels : {1.7, 2.0, 3.0, 4.0, 7.0, 9.0}) {
    for (int i = 0; i < 40; ++i) {
      const TextureCoordinates st{0.3 + 0.0047 * i, 0.52};
      const Footprint footprint = footprint_of(texture.windows(), texels, 0.9 * texels, 0.4);
      // Up to two texels a pixel, where the picture's own filter fades, one filter takes over from another.
      EXPECT_NEAR(texture.filtered(st, footprint)[0], reference_filtered(texture, st, footprint)[0],
                  texels <= 2 ? 0.006 : 0.004)
          << texels << " " << i;
    }
  }
}

TEST(TextureFilter, LongEllipsesStaySharpAcross) {
  for (const Picture& picture : {zone_plate(256), noise(300, 200)}) {
    const Texture texture(picture, Wrap::Mirror);
    for (const double angle : {0.0, 0.3, kPi / 4, kPi / 2, 2.5}) {
      const Footprint arc = footprint_of(picture, 100, 1, angle), wide = footprint_of(picture, 200, 2, angle);
      for (const TextureCoordinates st : {TextureCoordinates{0.3, 0.4}, {0.52, 0.7}}) {
        for (const Footprint& footprint : {arc, wide}) {
          const Rgba got = texture.filtered(st, footprint),
                     expected = reference_filtered(texture, st, footprint);
          for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(got[c], expected[c], 0.004) << angle;
        }
      }
    }
  }
}

TEST(TextureFilter, EdgesAreAsTheReferenceSays) {
  for (const Wrap wrap : {Wrap::Black, Wrap::Clamp, Wrap::Mirror, Wrap::Repeat}) {
    const Texture texture(noise(50, 34), wrap);
    EXPECT_GT(decibels(texture, {0.6, 2, 3}, 150, 0.2), 42) << static_cast<int>(wrap);
    EXPECT_GT(decibels(texture, {2, 6, 3}, 100, 0.2), 42) << static_cast<int>(wrap);
  }
}

TEST(TextureFilter, OverscanAndOddSizesKeepTheirPlaceOnEveryLevel) {
  // A ramp is itself wherever it is filtered, when texel centres and means are right.
  for (const int x : {0, -7}) {
    Picture ramp = painted(333, 217, [&](int column, int row) {
      return Rgba{static_cast<float>(column + x), static_cast<float>(row + x), 0, 1};
    });
    ramp.x = ramp.y = x;
    ramp.display_width = 333 + 2 * x;
    ramp.display_height = 217 + 2 * x;
    const Texture texture(ramp, Wrap::Clamp);
    for (const double texels : {0.1, 0.5, 1.0, 1.1, 1.2, 2.0, 3.0, 5.0, 9.0, 12.0}) {
      const TextureCoordinates st{0.47, 0.55};
      const Rgba got = texture.filtered(st, footprint_of(ramp, texels * 1.3, texels, 0.6));
      EXPECT_NEAR(got[0], st.s * ramp.display_width - 0.5, 0.01 * texels) << texels << " " << x;
      EXPECT_NEAR(got[1], (1 - st.t) * ramp.display_height - 0.5, 0.01 * texels) << texels << " " << x;
    }
  }
}

/// What Catmull and Rom's cubic leaves of a wave: its Fourier transform (Keys 1981).
double left_by_cubic(double waves_per_texel) {
  const double f = kPi * waves_per_texel;
  const auto sinc = [&](double times) { return std::sin(times * f) / (times * f); };
  return 3 / (f * f) * (std::pow(sinc(1), 2) - sinc(2)) -
         1 / (f * f) * (3 * std::pow(sinc(2), 2) - 2 * sinc(2) - sinc(4));
}

TEST(TextureFilter, ItIsAsWideAsThePixelFilter) {
  // What a Gaussian leaves of a wave tells its variance: of fine pictures nothing is taken off.
  for (const double texels : {1.7, 2.0, 2.2, 2.5, 4.0, 4.5, 8.0, 15.0}) {
    const double variance = std::pow(kPixelSigma * texels, 2),
                 sigma = std::sqrt(variance - own_variance(variance));
    const double waves = std::round(512 / (2 * kPi * sigma)), per_texel = 2 * kPi * waves / 512;
    const Texture texture(painted(512, 4,
                                  [&](int column, int) {
                                    const auto value =
                                        static_cast<float>(std::cos(per_texel * (column + 0.5)));
                                    return Rgba{value, value, value, 1};
                                  }),
                          Wrap::Repeat);
    const float got = texture.filtered({0, 0.4}, footprint_of(texture.windows(), texels, texels, 0))[0];
    EXPECT_NEAR(got, left_by_cubic(per_texel / (2 * kPi)) * std::exp(-std::pow(per_texel * sigma, 2) / 2),
                0.012)
        << texels;
  }
}

TEST(TextureFilter, WhatIsConstantStaysConstant) {
  const Rgba colour{0.3F, 20, 0.007F, 0.75F};
  for (const Wrap wrap : {Wrap::Clamp, Wrap::Mirror, Wrap::Repeat, Wrap::Globe}) {
    const Texture texture(painted(101, 47, [&](int, int) { return colour; }), wrap);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-0.5, 1.5), power(-3, 5);
    for (int i = 0; i < 500; ++i) {
      const Footprint footprint = footprint_of(texture.windows(), std::pow(10, power(random)),
                                               std::pow(10, power(random)), uniform(random) * 7);
      const Rgba got = texture.filtered({uniform(random), uniform(random)}, footprint);
      for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(got[c] / colour[c], 1, 1e-5);
    }
  }
}

TEST(TextureFilter, LightIsKept) {
  // One bright texel in the dark, filmed by a lattice of pixels: what all of them see together does not
  // depend on how many they are.
  const Texture texture(
      painted(96, 96,
              [](int column, int row) {
                return column == 40 && row == 51 ? Rgba{1000, 1000, 1000, 1} : Rgba{0, 0, 0, 0};
              }),
      Wrap::Black);
  const auto light_at = [&](double texels) {
    double sum = 0;
    const Footprint footprint = footprint_of(texture.windows(), texels, texels, 0);
    for (double y = 0.1; y < 96; y += texels / 2) {
      for (double x = 0.2; x < 96; x += texels / 2) {
        const Rgba got = texture.filtered({x / 96, 1 - y / 96}, footprint);
        EXPECT_GE(got[0], 0);
        sum += static_cast<double>(got[0]) * texels * texels / 4;
      }
    }
    return sum;
  };
  for (const double texels : {2.3, 3.1, 4.4, 6.0, 9.0}) EXPECT_NEAR(light_at(texels), 1000, 5) << texels;
  // Where the dark ring beside it is left out a highlight has more: by (13/12)^2 on the whole surface.
  for (const double texels : {0.2, 0.7, 1.15, 1.7}) {
    EXPECT_GT(light_at(texels), 995);
    EXPECT_LT(light_at(texels), 1190);
  }
}

TEST(TextureFilter, NothingJumpsWhenFootprintsGrow) {
  const Texture texture(noise(256, 256), Wrap::Repeat);
  for (const double ratio : {1.0, 3.0}) {
    for (double texels = 0.02; texels < 60; texels *= 1.002) {
      const auto at = [&](double size) {
        return texture.filtered({0.312, 0.57}, footprint_of(texture.windows(), size * ratio, size, 0.4));
      };
      const Rgba here = at(texels), next = at(texels * 1.002);
      for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(here[c], next[c], 0.008) << texels << " " << ratio;
    }
  }
}

TEST(TextureFilter, MagnifiedItIsSmoothAndNeverNegative) {
  const Texture texture(painted(32, 32,
                                [](int column, int row) {
                                  return column == 16 && row == 16 ? Rgba{1, 1, 1, 1} : Rgba{0, 0, 0, 0};
                                }),
                        Wrap::Clamp);
  // Second differences along a line: the bilinear surface has creases of 0.03 to the step here. The cubic's
  // are 0.03^2 of its second derivative, up to 5, and where it would be negative it ends with a slope of 1/2.
  const Footprint footprint = footprint_of(texture.windows(), 0.03, 0.03, 0);
  const auto along = [&](double x) { return texture.filtered({x / 32, 15.6 / 32}, footprint)[0]; };
  for (double x = 13; x < 20; x += 0.03) {
    EXPECT_GE(along(x), 0);
    const double step = along(x - 0.03) - 2 * along(x) + along(x + 0.03);
    EXPECT_NEAR(step, 0, along(x) > 0.02 ? 0.005 : 0.018) << x;
  }
}

TEST(TextureFilter, OneCubicServesEveryMagnification) {
  // A line of one texel: its crest stays, and between there and 1/1000 of a texel a pixel nothing changes.
  const Texture texture(painted(33, 9,
                                [](int column, int) {
                                  const float value = column == 16 ? 1.0F : 0.0F;
                                  return Rgba{value, value, value, 1};
                                }),
                        Wrap::Clamp);
  const auto at = [&](double away, double magnified) {
    return static_cast<double>(texture.filtered(
        {(16.5 + away) / 33, 0.5}, footprint_of(texture.windows(), 1 / magnified, 1 / magnified, 0.3))[0]);
  };
  // Catmull and Rom's cubic, by hand.
  const auto cubic = [](double x) { return x < 1 ? 1 - x * x * (2.5 - 1.5 * x) : 0.0; };
  for (const double magnified : {1.0, 1.5, 3.0, 4.0, 6.0, 8.0, 30.0, 1000.0}) {
    EXPECT_NEAR(at(0, magnified), 1, 1e-5) << magnified;
    for (const double away : {0.2, 0.5, 0.8, 1.0, 1.3, 1.9}) {
      EXPECT_NEAR(at(away, magnified), cubic(away), 2e-3) << magnified << " " << away;
    }
  }
  for (double magnified = 0.3; magnified < 3; magnified *= 1.01) {
    EXPECT_LE(at(0, magnified), at(0, magnified * 1.01) + 0.01);  // and it comes steadily
    EXPECT_NEAR(at(0, magnified), at(0, magnified * 1.01), 0.03) << magnified;
  }
}

TEST(TextureFilter, HighlightsDoNotRing) {
  const Texture texture(painted(40, 40,
                                [](int column, int row) {
                                  const bool star = column == 20 && row == 20;
                                  const float light = star ? 1000.0F : 0.2F;
                                  return Rgba{light, light, light, column < 20 ? 1.0F : 0.0F};
                                }),
                        Wrap::Clamp);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 5000; ++i) {
    const double minor = std::pow(10, 2.5 * uniform(random) - 2),
                 major = minor * std::pow(50, uniform(random));
    const Rgba got = texture.filtered({0.4 + 0.2 * uniform(random), 0.4 + 0.2 * uniform(random)},
                                      footprint_of(texture.windows(), major, minor, 7 * uniform(random)));
    ASSERT_GE(got[0], 0.2F * (1 - 1e-4F)) << major << " " << minor;
    ASSERT_LE(got[0], 1000.1F);
    ASSERT_GE(got[3], 0);
    ASSERT_LE(got[3], 1 + 1e-5F);
  }
}

TEST(TextureFilter, TheSeamOfAGlobeIsNotSeen) {
  // A smooth function of the longitude that goes round once.
  const Texture texture(painted(200, 100,
                                [](int column, int) {
                                  const auto value =
                                      static_cast<float>(std::cos(2 * kPi * (column + 0.5) / 200));
                                  return Rgba{value, value, value, 1};
                                }),
                        Wrap::Globe);
  for (const double texels : {0.2, 1.0, 3.0, 10.0}) {
    const Footprint footprint = footprint_of(texture.windows(), texels, texels, 0.2);
    for (double s = -0.02; s < 0.02; s += 0.001) {
      const double blur = 2 * kPi * texels / 200 * kPixelSigma;
      const double expected = std::cos(2 * kPi * s) * std::exp(-0.5 * blur * blur);
      EXPECT_NEAR(texture.filtered({s, 0.5}, footprint)[0], expected, 0.002) << s << " " << texels;
      EXPECT_NEAR(texture.filtered({s + 1, 0.5}, footprint)[0], expected, 0.002) << s << " " << texels;
    }
  }
}

/// A camera that looks down on the north pole: a film position, in radians from the pole, and what it sees.
struct PolarView {
  TextureCoordinates st;
  Footprint footprint;
};
PolarView polar_view(double u, double v, double radians_per_pixel) {
  const double r = std::hypot(u, v);
  const double around = radians_per_pixel / (r * r * 2 * kPi), out = radians_per_pixel / (r * kPi);
  return {{std::atan2(v, u) / (2 * kPi), 1 - r / kPi},
          {.ds_dx = -v * around, .ds_dy = u * around, .dt_dx = -u * out, .dt_dy = -v * out}};
}

TEST(TextureFilter, PolesAreFilteredAsAnyOtherPlace) {
  // On the plane at the pole this is a wave; filtered it is the same wave, but weaker.
  const int width = 720, height = 360;
  const double wave = 40;  // radians of phase per radian
  const Texture texture(
      painted(width, height,
              [&](int column, int row) {
                const double r = kPi * (row + 0.5) / height, s = 2 * kPi * (column + 0.5) / width;
                const auto value = static_cast<float>(std::cos(wave * r * std::cos(s) + 0.5));
                return Rgba{value, value, value, 1};
              }),
      Wrap::Globe);
  for (const double pixel : {0.001, 0.004, 0.01, 0.03}) {
    for (const double away : {0.03, 0.3, 0.9, 1.4, 2.2, 4.0}) {
      for (const double angle : {0.1, 1.2, 2.9, 5.0}) {
        const double u = away * pixel * std::cos(angle), v = away * pixel * std::sin(angle);
        const PolarView view = polar_view(u, v, pixel);
        const double blur =
            wave *
            std::sqrt(std::max(0.0, std::pow(kPixelSigma * pixel, 2) - std::pow(0.45 * kPi / height, 2)));
        const double expected = std::cos(wave * u + 0.5) * std::exp(-blur * blur / 2);
        EXPECT_NEAR(texture.filtered(view.st, view.footprint)[0], expected, 0.03) << pixel << " " << away;
      }
    }
  }
}

TEST(TextureFilter, RaysWithinAPixelAreTogetherItsFilter) {
  // Where a pixel is taken by many rays it must not be sharper nor softer than the pixel beside it.
  const Texture texture(zone_plate(256), Wrap::Mirror);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double size : {0.1, 0.7, 1.0, 1.3, 2.0, 4.0}) {
    double squares = 0;
    constexpr int kLookups = 60;
    for (int i = 0; i < kLookups; ++i) {
      const TextureCoordinates st{0.2 + 0.6 * uniform(random), 0.2 + 0.6 * uniform(random)};
      Footprint footprint = footprint_of(texture.windows(), size * (1 + uniform(random)), size,
                                         7 * uniform(random), 7 * uniform(random));
      const float whole = texture.filtered(st, footprint)[0];
      double sum = 0;
      footprint.scale = kSampleScale;
      for (const SampleOffset& offset : sample_offsets()) {
        footprint.x = offset.x;
        footprint.y = offset.y;
        const TextureCoordinates seen{st.s + footprint.ds_dx * offset.x + footprint.ds_dy * offset.y,
                                      st.t + footprint.dt_dx * offset.x + footprint.dt_dy * offset.y};
        sum += static_cast<double>(texture.filtered(seen, footprint)[0]) / kMostSamples;
      }
      squares += std::pow(sum - static_cast<double>(whole), 2) / kLookups;
    }
    EXPECT_LT(std::sqrt(squares), size < 1 ? 2e-3 : 0.01) << size;
  }
}

TEST(TextureFilter, APictureAsLargeAsTheFilmComesBack) {
  const Picture picture = noise(64, 36);
  for (const Wrap wrap : kWraps) {
    const Texture texture(picture, wrap);
    const Footprint footprint = footprint_of(picture, 1, 1, 0);
    for (int row = 0; row < 36; ++row) {
      for (int column = 0; column < 64; ++column) {
        const Rgba got = texture.filtered({(column + 0.5) / 64, 1 - (row + 0.5) / 36}, footprint);
        for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(got[c], picture.at(column, row)[c], 1e-5);
      }
    }
  }
}

TEST(TextureFilter, WhateverIsAskedForTheAnswerIsFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const Wrap wrap : kWraps) {
    const Texture texture(noise(64, 33), wrap);
    for (const double huge : {0.0, 1e-300, 1.0, 1e3, 1e12, 1e300, inf, nan, -1e300}) {
      for (const double other : {0.0, 1e-3, 1e300, nan}) {
        for (const double s : {0.0, 0.5, 1.0, -1e9, 1e300, nan}) {
          for (const Footprint& footprint : {Footprint{huge, other, other, huge},
                                             {huge, huge, huge, huge, other},
                                             {huge, 0, 0, other},
                                             {0, other, huge, 0}}) {
            for (const float channel : texture.filtered({s, 0.7}, footprint))
              ASSERT_TRUE(std::isfinite(channel));
          }
        }
      }
    }
  }
}

TEST(TextureFilter, FootprintsOfNoUseSeeTheMean) {
  const Picture picture = noise(64, 33);
  std::array<double, 4> mean{};
  for (const Rgba& pixel : picture.pixels) {
    for (std::size_t c = 0; c < 4; ++c) mean[c] += static_cast<double>(pixel[c]) / (64 * 33);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Rgba got = Texture(picture, Wrap::Globe).filtered({0.2, 0.3}, {nan, 0, 0, 0});
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(got[c], mean[c], 0.03);
}

/// A fine picture shows the film's own filter; one as coarse as the film shows itself; between, no step.
TEST(TextureFilter, APicturesOwnFilterCountsLessTheFinerItIs) {
  const auto left = [](double texels) {  // variance of what is left, in pixels of the film
    const double variance = kPixelSigma * kPixelSigma * texels * texels;
    return std::max(0.0, variance - own_variance(variance)) / (texels * texels);
  };
  EXPECT_EQ(left(0.5), 0);
  EXPECT_EQ(left(1), 0);
  for (const double texels : {2.0, 3.0, 100.0}) EXPECT_EQ(left(texels), kPixelSigma * kPixelSigma);
  for (double texels = 1; texels < 2; texels += 0.01) {
    EXPECT_LE(left(texels), left(texels + 0.01));
    EXPECT_LT(left(texels + 0.01) - left(texels), 0.01);
  }
}

}  // namespace
}  // namespace lensplane
