// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/tiled_texels.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <thread>

#include "tests/pipeline/composite/reference_filter.h"
#include "tests/pipeline/composite/tiled_file.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

constexpr int kWidth = 301, kHeight = 150;
constexpr std::size_t kFew = 300000;  // bytes: about 60 tiles of 16 x 16 of the 250 that there are

Picture noise() {
  std::mt19937 random(3);
  return painted(kWidth, kHeight, [&](int, int) {
    const auto value = [&] { return static_cast<float>(random() % 1024) / 1023; };
    return Rgba{value(), value(), value(), 1};
  });
}

/// The levels of a file, read without tiles.
Pyramid pyramid_of_file(const std::filesystem::path& path, const std::vector<TexelLevel>& levels) {
  Pyramid pyramid;
  pyramid.levels = levels;
  const auto input = OIIO::ImageInput::open(path.string());
  for (int level = 0; level < static_cast<int>(levels.size()); ++level) {
    EXPECT_TRUE(input->seek_subimage(0, level));
    const OIIO::ImageSpec& spec = input->spec();
    Picture picture = painted(spec.width, spec.height, [](int, int) { return Rgba{}; });
    EXPECT_TRUE(input->read_image(0, level, 0, 4, OIIO::TypeDesc::FLOAT, picture.pixels.data()));
    pyramid.pictures.push_back(std::move(picture));
  }
  return pyramid;
}

struct Lookup {
  TextureCoordinates st;
  Footprint footprint;
};

std::vector<Lookup> lookups(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Lookup> list;
  const Picture picture{kWidth, kHeight, 0, 0, kWidth, kHeight, {}};
  for (int i = 0; i < count; ++i) {
    const double minor = std::pow(10, 2.5 * uniform(random) - 1),
                 major = minor * std::pow(20, uniform(random));
    list.push_back({{1.4 * uniform(random) - 0.2, 1.4 * uniform(random) - 0.2},
                    footprint_of(picture, major, minor, 7 * uniform(random))});
  }
  return list;
}

class TiledTextures : public testing::Test {
 protected:
  TiledTextures() { write_tiled(path_, noise(), 16); }

  TiledTexture open(const std::shared_ptr<TileCache>& cache) const {
    return {open_tiled_image(path_, std::size_t{1} << 20), float_pixels, cache};
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "noise.tx";
};

TEST_F(TiledTextures, LookUpWhatIsThereInMemory) {
  for (const Wrap wrap : {Wrap::Black, Wrap::Clamp, Wrap::Mirror, Wrap::Repeat, Wrap::Globe}) {
    const auto cache = std::make_shared<TileCache>(kFew);
    const TiledTexture tiled = open(cache);
    const Texture texture(tiled, wrap), finest(noise(), wrap);
    const Pyramid pyramid = pyramid_of_file(path_, tiled.levels());
    for (const auto& [st, footprint] : lookups(300, 1)) {
      PyramidTexels texels(pyramid, wrap);
      const Rgba expected = filtered_texels(texels, st, footprint), got = texture.filtered(st, footprint);
      for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(got[c], expected[c], 2e-6);
      EXPECT_EQ(texture.lookup(st), finest.lookup(st));
    }
    EXPECT_LE(cache->bytes(), kFew);
  }
}

TEST_F(TiledTextures, ServeSeveralThreadsWithinTheBudget) {
  const auto cache = std::make_shared<TileCache>(kFew);
  const Texture texture(open(cache), Wrap::Globe);
  const Texture alone(open(std::make_shared<TileCache>()), Wrap::Globe);
  const auto list = lookups(400, 2);
  std::vector<Rgba> expected;
  for (const auto& [st, footprint] : list) expected.push_back(alone.filtered(st, footprint));
  std::array<int, 4> wrong{};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < list.size(); ++i) {
        const std::size_t k = (i * 7 + t * 100) % list.size();
        wrong[t] += texture.filtered(list[k].st, list[k].footprint) != expected[k];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, (std::array<int, 4>{}));
  EXPECT_LE(cache->bytes(), kFew);
  EXPECT_GT(cache->bytes(), kFew / 2);
}

TEST_F(TiledTextures, CountWhatIsNoNumber) {
  const auto image = open_tiled_image(path_, std::size_t{1} << 20);
  const TiledTexture tiled(
      image,
      [](const EncodedImage& encoded) {
        Picture picture = float_pixels(encoded);
        picture.not_numbers = 2;
        return picture;
      },
      std::make_shared<TileCache>());
  const Texture texture(tiled, Wrap::Clamp);
  const double s = 8.5 / kWidth, t = 1 - 8.5 / kHeight;
  texture.lookup({s, t});
  texture.lookup({s, t});
  EXPECT_EQ(tiled.not_numbers(), 2);
}

}  // namespace
}  // namespace lensplane
