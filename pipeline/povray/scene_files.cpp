// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/scene_files.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "pipeline/image/failure.h"

namespace lensplane {
namespace {

/// The end of the comment that begins at `at`; they may stand in one another.
std::size_t end_of_comment(const std::string& source, std::size_t at) {
  int depth = 0;
  for (; at + 1 < source.size(); ++at) {
    const std::string_view two(source.data() + at, 2);
    if (two == "/*" || two == "*/") depth += two == "/*" ? 1 : -1, ++at;
    if (depth == 0) return at + 1;
  }
  return source.size();
}

/// The closing quote of the text that begins after `at`.
std::size_t end_of_quote(const std::string& source, std::size_t at) {
  for (++at; at < source.size() && source[at] != '"'; ++at) {
    if (source[at] == '\\') ++at;
  }
  return std::min(at, source.size());
}

bool ends_with_include(const std::string& code) {
  const std::size_t last = code.find_last_not_of(" \t\r\n");
  return last != std::string::npos && std::string_view(code).substr(0, last + 1).ends_with("#include");
}

std::string contents_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file || !text) throw Failure(ExitCode::BadInput, path.string() + ": cannot be read");
  return text.str();
}

/// Reads `file` and what it includes. Names are looked up beside the scene, as POV-Ray does.
void collect(const std::filesystem::path& file, const std::filesystem::path& folder,
             std::set<std::filesystem::path>& seen, SceneFiles& files) {
  if (!seen.insert(file).second) return;
  const SceneText text = parse_scene_text(contents_of(file));
  files.code += text.code + "\n";
  files.complete = files.complete && text.complete;
  for (const SceneText::Quote& quote : text.quotes) {
    const std::filesystem::path named = (folder / quote.text).lexically_normal();
    std::error_code error;
    if (quote.text.empty() || !std::filesystem::is_regular_file(named, error)) continue;
    if (quote.included) {
      collect(named, folder, seen, files);
    } else {
      seen.insert(named);
    }
  }
}

}  // namespace

bool SceneFiles::says(const std::string& word) const {
  const auto part_of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t at = code.find(word); at != std::string::npos; at = code.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !part_of_word(code[at - 1])) && (end == code.size() || !part_of_word(code[end])))
      return true;
  }
  return false;
}

SceneText parse_scene_text(const std::string& source) {
  SceneText text;
  for (std::size_t at = 0; at < source.size();) {
    const std::string_view two = std::string_view(source).substr(at, 2);
    if (two == "//") {
      at = std::min(source.find('\n', at), source.size());
    } else if (two == "/*") {
      at = end_of_comment(source, at);
      text.code += ' ';
    } else if (source[at] == '"') {
      const std::size_t end = end_of_quote(source, at);
      text.quotes.push_back({source.substr(at + 1, end - at - 1), ends_with_include(text.code)});
      text.code += "\"\"";
      at = end + 1;
    } else {
      text.code += source[at++];
    }
  }
  static const std::regex made_up("#include\\s*[^\\s\"]");
  text.complete = !std::regex_search(text.code, made_up);
  return text;
}

SceneFiles read_scene_files(const std::filesystem::path& scene) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(scene, error))
    throw Failure(ExitCode::BadInput, scene.string() + ": no such scene");
  SceneFiles files;
  std::set<std::filesystem::path> seen;
  collect(scene.lexically_normal(), scene.parent_path(), seen, files);
  files.files.assign(seen.begin(), seen.end());
  static const std::regex version("#version\\s+3\\.[7-9]"), linear("assumed_gamma\\s+1(\\.0*)?(?![\\w.])");
  if (!std::regex_search(files.code, version) || !std::regex_search(files.code, linear)) {
    throw Failure(
        ExitCode::BadInput,
        scene.string() +
            ": without version 3.7 and a gamma of 1 its numbers are not light; write: #version 3.7; "
            "global_settings { assumed_gamma 1.0 }");
  }
  if (!files.says("lensplane_camera")) {
    throw Failure(ExitCode::BadInput,
                  scene.string() +
                      ": it does not use the shot's camera; write: #include \"lensplane.inc\" "
                      "camera { lensplane_camera }");
  }
  return files;
}

}  // namespace lensplane
