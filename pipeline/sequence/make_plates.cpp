// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/make_plates.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <thread>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/exr_writer.h"
#include "pipeline/image/failure.h"
#include "pipeline/povray/work_folder.h"
#include "pipeline/sequence/frame_report.h"
#include "pipeline/sequence/located_in_shot.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/sequence/render_plate.h"

namespace lensplane {
namespace {

/// Linear light with the primaries of Rec.709 and sRGB, as POV-Ray writes it.
constexpr const char* kInteropId = "lin_rec709_scene";
constexpr Chromaticities kRec709 = {{{0.64F, 0.33F}, {0.30F, 0.60F}, {0.15F, 0.06F}, {0.3127F, 0.3290F}}};

std::vector<std::size_t> povray_layers(const Shot& shot) {
  std::vector<std::size_t> layers;
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    if (shot.layers[k].povray) layers.push_back(k);
  }
  return layers;
}

PovRay povray_for(const Shot& shot, const std::vector<std::size_t>& layers) {
  const bool mesh = std::any_of(layers.begin(), layers.end(),
                                [&](std::size_t k) { return shot.layers[k].povray->as == PovRayAs::Bent; });
  const WorkFolder folder(shot.output.directory, shot.name + ".povray");
  return located_in_shot(shot.layers[layers.front()].povray->scene,
                         [&] { return find_povray(folder.path(), mesh); });
}

std::vector<PlateTask> tasks_of(const Shot& shot, const std::vector<std::size_t>& layers,
                                const std::vector<int>& frames, const PovRay& povray) {
  std::vector<PlateTask> tasks;
  for (const std::size_t k : layers) {
    const LocatedText& scene = shot.layers[k].povray->scene;
    const SceneFiles files = located_in_shot(scene, [&] { return read_scene_files(scene.text); });
    for (const int frame : frames) tasks.push_back(plate_task(shot, k, frame, files, povray));
  }
  return tasks;
}

std::filesystem::path path_of(const Shot& shot, const PlateTask& task) {
  return plate_path(shot, shot.layers[task.layer].name, task.frame);
}

void write_plate(const Shot& shot, const PlateTask& task, const PovRay& povray, const Picture& picture) {
  const Camera& camera = task.passes.front().facts.camera;
  ExrHeader header;
  header.shot = shot.name;
  header.frame = task.frame;
  header.plan = "POV-Ray " + povray.version;
  header.parameters = task.digest;
  header.colour_interop = kInteropId;
  header.chromaticities = kRec709;
  header.fps = shot.fps;
  header.camera_axes = camera.axes;
  header.camera_position = camera.position;
  std::vector<ExrChannel> channels;
  for (const char* name : {"R", "G", "B", "A"}) {
    channels.push_back({name, picture.pixels.front().data() + channels.size(), 4});
  }
  write_exr(path_of(shot, task), {task.camera.width, task.camera.height, task.camera.overscan}, channels,
            {PixelType::Half, ExrCompression::Zip}, header);
}

PlateReport report_of(const Shot& shot, const PlateTask& task, PlateReport::How how) {
  return {shot.layers[task.layer].name, task.frame, how, 0.0, task.camera.overscan, {}};
}

PlateReport make_plate(const Shot& shot, const PlateTask& task, const PovRay& povray,
                       const PovRayHooks& hooks) {
  PlateReport report = report_of(shot, task, PlateReport::How::Rendered);
  timed(report.seconds, [&] {
    located_in_shot(shot.layers[task.layer].povray->scene, [&] {
      PovRayPicture rendered = render_plate(shot, task, povray, hooks);
      report.warnings = std::move(rendered.warnings);
      write_plate(shot, task, povray, rendered.picture);
    });
  });
  return report;
}

/// Does `work(i)` for each i < count on several threads, until one fails. Throws what the first has thrown.
template <class Work>
void on_threads(std::size_t count, Work work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> failed = false;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto run = [&] {
    for (std::size_t i = next++; i < count && !failed; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failed) failure = std::current_exception();
        failed = true;
      }
    }
  };
  const auto most = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < std::min(most, count); ++i) threads.emplace_back(run);
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

void copy_plate(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::ifstream file(from, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw Failure(ExitCode::BadInput, from.string() + ": cannot be read");
  write_atomically(to, bytes);
}

/// The tasks by what is to be done with them.
struct Work {
  std::vector<const PlateTask*> render, share;
  std::map<std::string, const PlateTask*> makers;  // by digest: whose file is that plate
};

Work work_of(const Shot& shot, const std::vector<PlateTask>& tasks, bool redo, const PlateHooks& hooks) {
  Work work;
  std::vector<const PlateTask*> wanted;
  for (const PlateTask& task : tasks) {
    if (!redo && read_exr_attribute(path_of(shot, task), "parameters") == task.digest) {
      work.makers.emplace(task.digest, &task);
      hooks.made(report_of(shot, task, PlateReport::How::Done));
    } else {
      wanted.push_back(&task);
    }
  }
  for (const PlateTask* task : wanted) {
    const bool first = work.makers.emplace(task->digest, task).second;
    (first ? work.render : work.share).push_back(task);
  }
  return work;
}

}  // namespace

void make_plates(const Shot& shot, const std::vector<int>& frames, bool redo, const PlateHooks& hooks) {
  const std::vector<std::size_t> layers = povray_layers(shot);
  if (layers.empty()) return;
  const PovRay povray = povray_for(shot, layers);
  const std::vector<PlateTask> tasks = tasks_of(shot, layers, frames, povray);
  const Work work = work_of(shot, tasks, redo, hooks);
  std::mutex mutex;
  std::atomic<bool> failed = false;
  on_threads(work.render.size(), [&](std::size_t i) {
    const PlateTask& task = *work.render[i];
    const std::string who = fmt::format("{} {:04}: ", shot.layers[task.layer].name, task.frame);
    const PovRayHooks of_plate{[&](const std::string& line) {
                                 const std::lock_guard lock(mutex);
                                 hooks.say(who + line);
                               },
                               [&] { return failed || hooks.stop(); }};
    try {
      const PlateReport report = make_plate(shot, task, povray, of_plate);
      const std::lock_guard lock(mutex);
      hooks.made(report);
    } catch (...) {
      failed = true;  // others need not go on
      throw;
    }
  });
  for (const PlateTask* task : work.share) {
    copy_plate(path_of(shot, *work.makers.at(task->digest)), path_of(shot, *task));
    hooks.made(report_of(shot, *task, PlateReport::How::Shared));
  }
}

std::string line_of(const PlateReport& report) {
  const std::string more =
      report.overscan > 0 ? fmt::format(", with {} pixels more on each side", report.overscan) : "";
  switch (report.how) {
    case PlateReport::How::Rendered:
      return fmt::format("{:04}: {} rendered by POV-Ray in {:.2f} s{}", report.frame, report.layer,
                         report.seconds, more);
    case PlateReport::How::Shared:
      return fmt::format("{:04}: {} is as in another frame", report.frame, report.layer);
    case PlateReport::How::Done:
      break;
  }
  return fmt::format("{:04}: {} rendered already", report.frame, report.layer);
}

}  // namespace lensplane
