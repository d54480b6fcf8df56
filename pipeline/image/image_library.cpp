// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/image_library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <string_view>

#include "pipeline/image/failure.h"
#include "pipeline/image/shipped.h"
#include "pipeline/image/version.h"

namespace lensplane {
namespace {

constexpr const char* kFile = "lib/lensplane/liblensplane_oiio.so";

// Two of what OpenImageIO brings along have half of all the symbols that the loader has to find. Loaded
// first, by themselves, they have theirs found among a dozen libraries instead of 250, which halves the time
// of it all. Where they have other names nothing but that time is lost.
constexpr const char* kLoadedFirst[] = {"libopenvdb.so.10.0", "libgdal.so.32"};

const ImageLibrary& load() {
  const std::string path = (installation_folder() / kFile).string();
  for (const char* name : kLoadedFirst) ::dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  void* library = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (!library) {
    std::string reason = ::dlerror();  // mostly begins with the path
    if (reason.starts_with(path + ": ")) reason.erase(0, path.size() + 2);
    throw Failure(ExitCode::BadInput, fmt::format("{}: cannot be loaded: {}", path, reason));
  }
  auto* entry = reinterpret_cast<ImageLibraryEntry*>(::dlsym(library, kImageLibraryEntry));
  if (!entry) {
    throw Failure(ExitCode::BadInput, fmt::format("{}: it is not lensplane's image library", path));
  }
  const ImageLibrary& offered = *entry();
  if (std::string_view(offered.version) != kVersion) {
    throw Failure(ExitCode::BadInput,
                  fmt::format("{}: of lensplane {}; needed: {}", path, offered.version, kVersion));
  }
  return offered;
}

}  // namespace

const ImageLibrary& image_library() {
  static const ImageLibrary& loaded = load();
  return loaded;
}

std::future<void> begin_to_load_image_library() {
  // TBB, too, looks for libraries when it begins to work, one at a time with others: it goes first.
  tbb::parallel_for(0, 2, [](int) {});
  return std::async(std::launch::async, [] { image_library(); });
}

}  // namespace lensplane
