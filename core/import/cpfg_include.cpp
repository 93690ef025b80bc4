#include "core/import/cpfg_include.h"

#include <algorithm>

#include "core/import/cpfg_text.h"

namespace seedmesh {
namespace {

constexpr int deepest_include = 16;
constexpr std::size_t longest_text = std::size_t{16} << 20U;

using Files = std::map<std::string, std::string>;

/// The name between quotes or angle brackets behind `#include`, without directories; empty if the line is no include.
std::string included_name(std::string_view line) {
  constexpr std::string_view key = "include";
  const Line word = trimmed(line, {1, line.size()});
  if (line.substr(word.from, key.size()) != key) return "";
  const std::string_view rest = line.substr(word.from + key.size());
  const std::size_t open = rest.find_first_of("\"<");
  if (open == std::string_view::npos) return "";
  const std::size_t close = rest.find_first_of("\">", open + 1);
  if (close == std::string_view::npos) return "";
  const std::string_view path = rest.substr(open + 1, close - open - 1);
  return std::string(path.substr(path.find_last_of("/\\") + 1));
}

class Joiner {
 public:
  explicit Joiner(const Files& files) : files_(files) {}

  /// `at`: the line of the main text that includes this text; none for the main text itself.
  void add(std::string_view text, const std::string& name, std::size_t at, int depth) {
    ForeignText unreported(text);
    const std::string clean = cpfg_without_comments(unreported);
    std::size_t from = 0;
    for (const Line& each : lines_of(clean)) {
      const Line line = trimmed(clean, each);
      if (line.from == line.to || clean[line.from] != '#') continue;
      const auto file = find(included_name(std::string_view(clean).substr(line.from, line.to - line.from)));
      if (file == files_.end() || depth == deepest_include) continue;
      copy(text.substr(from, line.from - from), name, name.empty() ? from : at);
      out.included.push_back(file->first);
      add(file->second, file->first, name.empty() ? line.from : at, depth + 1);
      from = line.to;
    }
    copy(text.substr(from), name, name.empty() ? from : at);
  }

  JoinedText out;

 private:
  Files::const_iterator find(const std::string& name) const {
    if (name.empty()) return files_.end();
    return std::ranges::find_if(files_, [&](const auto& each) {
      return each.first.substr(each.first.find_last_of('/') + 1) == name;
    });
  }

  void copy(std::string_view text, const std::string& name, std::size_t origin) {
    if (text.empty() || out.text.size() + text.size() > longest_text) return;
    out.parts.push_back({out.text.size(), origin, name});
    out.text += text;
  }

  const Files& files_;
};

}  // namespace

JoinedText with_cpfg_includes(std::string_view text, const Files& files) {
  Joiner joiner(files);
  joiner.add(text, "", 0, 0);
  return std::move(joiner.out);
}

}  // namespace seedmesh
