// SPDX-License-Identifier: Apache-2.0
//
// lensplane study as a user runs it, and its page in a browser.

#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A small frame of a chequered sky behind one mass.
std::filesystem::path write_shot(const TemporaryFolder& folder, const std::string& resolution = "[128, 80]") {
  std::string sky = "P3 256 128 255\n";
  for (int i = 0; i < 256 * 128; ++i)
    sky += i / 256 / 8 % 2 == i % 256 / 8 % 2 ? "250 200 90\n" : "20 40 120\n";
  folder.write("sky.ppm", sky);
  return folder.write("shot.yaml",
                      "lensplane: 1\nshot: small\nframes: 1001-1002\ncamera: {resolution: " + resolution +
                          ", fov: 20 deg}\n"
                          "lenses: [{name: hole, mass: 3000 Msun, position: [1e7 m, 2e7 m, -1e9 m]}]\n"
                          "layers: [{name: sky, type: latlong, image: sky.ppm}]\n"
                          "output: {directory: renders}\n");
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Opens a page in a headless browser; what it prints: the page's elements, and on `err` what its console
/// says.
ProgramResult browse(const std::filesystem::path& page) {
  return run_program({"chromium-headless-shell", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                      "--enable-logging=stderr", "--virtual-time-budget=2000", "--dump-dom",
                      "file://" + page.string()});
}

/// What one study of the small shot's second frame says and leaves; it takes some seconds.
class Study : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    result_ = lensplane({"study", write_shot(*folder_).string(), "-f", "1002"});
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::filesystem::path file(const std::string& name) {
    return *folder_ / "renders/small.study.1002" / name;
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static ProgramResult result_;
};
std::unique_ptr<TemporaryFolder> Study::folder_;
ProgramResult Study::result_;

TEST_F(Study, TellsWhatAccuracyCosts) {
  ASSERT_EQ(result_.exit_code, 0) << result_.err;
  EXPECT_THAT(result_.out, HasSubstr("shot small, frame 1002: 128 x 80, 1 mass"));
  EXPECT_THAT(result_.out, HasSubstr("\nfor 0.1 px in 99 of 100 pixels use "));
  EXPECT_THAT(result_.out, HasSubstr("rays a pixel, at"));  // pictures
  EXPECT_THAT(result_.out, HasSubstr("closed form of a single mass"));
  EXPECT_THAT(result_.out, HasSubstr(file("study.html").string()));
  const auto json = nlohmann::json::parse(contents_of(file("study.json")));
  EXPECT_EQ(json["traces"].size(), 27U);
  EXPECT_GE(json["pictures"].size(), 6U);
  EXPECT_GT(json["pictures"][0]["psnr_db"], 45.0);
  for (const auto& row : json["traces"]) EXPECT_GT(row["trace"]["median_s"], 0.0);
  EXPECT_EQ(count_of(contents_of(file("study.csv")), "\ntrace,"), 27U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("")), {}), 3);  // and nothing else
}

TEST_F(Study, PageOpensInABrowserWithoutErrors) {
  const auto page = browse(file("study.html"));
  ASSERT_EQ(page.exit_code, 0) << page.err << ": pipeline/setup.sh installs it";
  EXPECT_THAT(page.err, Not(HasSubstr("CONSOLE")));
  const std::size_t head = page.out.find("<tbody>", page.out.find("id=\"traces\""));
  const std::string rows = page.out.substr(head, page.out.find("</tbody>", head) - head);
  EXPECT_EQ(count_of(rows, "<tr"), 27U);
  EXPECT_EQ(count_of(page.out, "class=\"point\""), count_of(rows, "<tr"));
  // The test would see errors.
  const auto broken = browse(folder_->write("broken.html", "<script>missing()</script>"));
  EXPECT_THAT(broken.err, HasSubstr("CONSOLE"));
}

TEST_F(Study, PointsTellAboutThemselvesUnderTheMouse) {
  std::string html = contents_of(file("study.html"));
  const std::string hover =
      "<script>const r = points[0].querySelector('path').getBoundingClientRect();"
      "document.getElementById('plot').dispatchEvent(new MouseEvent('mousemove', {clientX: r.x + r.width / "
      "2, "
      "clientY: r.y + r.height / 2}));</script>";
  html.replace(html.find("</body>"), 0, hover);
  const auto page = browse(folder_->write("hovered.html", html));
  const std::string tip = page.out.substr(page.out.find("id=\"tip\""), 200);
  EXPECT_THAT(tip, HasSubstr("display: block"));
  EXPECT_THAT(tip, HasSubstr("kishi: "));
}

TEST_F(Study, WithoutItsImagesTracesAreStudiedNevertheless) {
  const TemporaryFolder folder;
  const auto path = write_shot(folder);
  std::filesystem::remove(folder / "sky.ppm");
  const auto result = lensplane({"study", path.string()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("note: pictures are left out: "));
  EXPECT_THAT(result.out, HasSubstr("sky.ppm: no such image"));
}

TEST_F(Study, InterruptedItLeavesWhatIsDone) {
  const TemporaryFolder folder;
  const auto path = write_shot(folder, "[1920, 1080]");
  const pid_t process = start_program({LENSPLANE_PROGRAM, "study", path.string()}, folder);
  std::this_thread::sleep_for(std::chrono::seconds(4));
  ::kill(process, SIGINT);
  const ProgramResult result = wait_for(process, folder);
  EXPECT_EQ(result.exit_code, 75);
  EXPECT_THAT(result.err, HasSubstr("interrupted; what was done is in "));
  const auto json = nlohmann::json::parse(contents_of(folder / "renders/small.study.1001/study.json"));
  EXPECT_EQ(json["interrupted"], true);
  EXPECT_LT(json["traces"].size(), 27U);  // it takes half a minute
  EXPECT_TRUE(std::filesystem::exists(folder / "renders/small.study.1001/study.html"));
}

TEST_F(Study, RefusesWhatItCannotDo) {
  const TemporaryFolder folder;
  const auto path = write_shot(folder);
  const auto two = lensplane({"study", path.string(), "-f", "1001-1002"});
  EXPECT_EQ(two.exit_code, 1);
  EXPECT_EQ(two.err, "-f: 2 frames; a study takes one\n");
  folder.write("file", "");
  const auto nowhere = lensplane({"study", path.string(), "--output", (folder / "file/deeper").string()});
  EXPECT_EQ(nowhere.exit_code, 3);
  EXPECT_THAT(nowhere.err, HasSubstr("study.csv"));
  EXPECT_EQ(count_of(nowhere.err, "\n"), 1U);
}

}  // namespace
}  // namespace lensplane
