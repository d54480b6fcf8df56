// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/output_reader.h"

#include <algorithm>
#include <array>
#include <functional>

namespace lensplane {
namespace {

ExrFormat read_format(const Value& image) {
  image.only_keys({"type", "compression"});
  ExrFormat format;
  if (const auto type = image.find("type")) {
    constexpr std::array<std::string_view, 2> kNames = {"half", "float"};
    format.type = static_cast<PixelType>(type->choice(kNames));
  }
  if (const auto compression = image.find("compression")) {
    constexpr std::array<std::string_view, 10> kNames = {"none",  "rle", "zips", "zip",  "piz",
                                                         "pxr24", "b44", "b44a", "dwaa", "dwab"};
    format.compression = static_cast<ExrCompression>(compression->choice(kNames));
  }
  return format;
}

/// Which of `allowed` are chosen: all, none, or those in a list.
std::vector<bool> read_chosen(const Value& value, const std::vector<std::string_view>& allowed) {
  if (!value.is_list()) {
    constexpr std::array<std::string_view, 2> kNames = {"all", "none"};
    return std::vector<bool>(allowed.size(), value.choice(kNames) == 0);
  }
  std::vector<bool> chosen(allowed.size(), false);
  for (const Value& item : value.items()) chosen[item.choice(allowed)] = true;
  return chosen;
}

std::vector<bool> read_map_layers(const Value& maps, const OutputLayers& layers) {
  for (const Value& item : maps.is_list() ? maps.items() : std::vector<Value>()) {
    const auto named = std::find(layers.names.begin(), layers.names.end(), item.text());
    if (named != layers.names.end() && !layers.have_maps[named - layers.names.begin()])
      item.refuse(in_quotes(item.text()) + " is a layer of stars, which have no map");
  }
  std::vector<bool> chosen = read_chosen(maps, {layers.names.begin(), layers.names.end()});
  std::transform(chosen.begin(), chosen.end(), layers.have_maps.begin(), chosen.begin(),
                 std::logical_and<>());
  return chosen;
}

/// `maps` is the layers themselves, or a map of them and of how their edges are.
void read_maps(const Value& maps, const OutputLayers& layers, OutputSettings& settings) {
  if (!maps.is_map()) {
    settings.maps = read_map_layers(maps, layers);
    return;
  }
  maps.only_keys({"layers", "coverage"});
  if (const auto chosen = maps.find("layers")) settings.maps = read_map_layers(*chosen, layers);
  if (const auto coverage = maps.find("coverage")) {
    constexpr std::array<std::string_view, 2> kNames = {"filtered", "binary"};
    settings.coverage = static_cast<Coverage>(coverage->choice(kNames));
  }
}

/// `review` is the format itself, or a map of it and of an exposure.
void read_review(const Value& review, OutputSettings& settings) {
  if (review.is_map()) review.only_keys({"format", "exposure"});
  const auto format = review.is_map() ? review.find("format") : std::optional(review);
  if (format) {
    constexpr std::array<std::string_view, 4> kNames = {"none", "png", "png16", "tiff16"};
    const std::size_t chosen = format->choice(kNames);
    settings.review = chosen == 0 ? std::nullopt : std::optional(static_cast<ReviewFormat>(chosen - 1));
  }
  if (!review.is_map()) return;
  if (const auto exposure = review.find("exposure"))
    settings.review_exposure = read_keyed_exposure(*exposure);
}

Effects read_data(const Value& data) {
  std::vector<std::string_view> names;
  for (const EffectName& entry : kEffectNames) names.push_back(entry.name);
  const std::vector<bool> chosen = read_chosen(data, names);
  Effects effects;
  for (std::size_t i = 0; i < kEffectNames.size(); ++i) effects.*kEffectNames[i].effect = chosen[i];
  return effects;
}

}  // namespace

OutputSettings read_output(const std::optional<Value>& output, const std::string& name,
                           const OutputLayers& layers, NotYet& not_yet) {
  OutputSettings settings;
  settings.directory = "renders/" + name;
  settings.maps = layers.have_maps;
  if (!output) return settings;
  output->only_keys({"directory", "image", "maps", "data", "review", "movie", "locator"});
  if (const auto directory = output->find("directory")) settings.directory = directory->text();
  if (const auto image = output->find("image")) settings.image = read_format(*image);
  if (const auto maps = output->find("maps")) read_maps(*maps, layers, settings);
  if (const auto data = output->find("data")) settings.data = read_data(*data);
  if (std::find(settings.maps.begin(), settings.maps.end(), true) == settings.maps.end()) settings.data = {};
  if (const auto review = output->find("review")) read_review(*review, settings);
  if (const auto locator = output->find("locator")) {
    constexpr std::array<std::string_view, 2> kNames = {"none", "beside"};
    settings.locator = static_cast<Locator>(locator->choice(kNames));
  }
  if (const auto movie = output->find("movie")) {
    constexpr std::array<std::string_view, 3> kNames = {"none", "mp4", "prores"};
    if (movie->choice(kNames) != 0) not_yet.add(*movie, movie->text() + "; write none");
  }
  return settings;
}

}  // namespace lensplane
