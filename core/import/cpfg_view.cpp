/// After the manual of cpfg (Virtual Laboratory, "CPFG Version 4.0 User's Manual", view files) and the program funcedit of
/// the same laboratory, whose functions are B-splines over control points.
#include "core/import/cpfg_view.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "core/import/cpfg_macros.h"
#include "core/import/formats.h"

namespace seedmesh {
namespace {

constexpr std::size_t most_samples = 100;  // of a function
constexpr std::size_t most_functions = 100, most_points = 1'000;
constexpr const char* view_only[] = {"viewpoint",
                                     "view reference point",
                                     "twist",
                                     "projection",
                                     "front distance",
                                     "back distance",
                                     "scale factor",
                                     "z buffer",
                                     "cue range",
                                     "shade mode",
                                     "light",
                                     "light direction",
                                     "diffuse reflection",
                                     "surface ambient",
                                     "surface diffuse",
                                     "render mode",
                                     "shadow map",
                                     "polygonization level",
                                     "tapered lines",
                                     "twist of cylinders",
                                     "background scene",
                                     "font",
                                     "line",
                                     "view",
                                     "window",
                                     "function",
                                     "function set",
                                     "generate on view change",
                                     "concave polygons",
                                     "tropism direction",
                                     "initial elasticity",
                                     "elasticity increment",
                                     "torque",
                                     "stationary",
                                     "color increment",
                                     "initial color",
                                     "texture",
                                     "contour",
                                     "corrected rotation",
                                     "interpretation past %"};

/// One line `key: value` of a view file.
struct Entry {
  std::string key, value;
};

std::vector<Entry> entries_of(const std::string& text) {
  std::string clean = cpfg_without_comments(text);
  std::vector<Entry> entries;
  for (const Line& each : lines_of(clean)) {
    const Line line = trimmed(clean, each);
    const std::size_t colon = clean.find(':', line.from);
    if (colon == std::string::npos || colon >= line.to || clean[line.from] == '#') continue;
    const Line key = trimmed(clean, {line.from, colon}), value = trimmed(clean, {colon + 1, line.to});
    entries.push_back({lower(std::string_view(clean).substr(key.from, key.to - key.from)),
                       clean.substr(value.from, value.to - value.from)});
  }
  return entries;
}

/// The numbers of a text, in which commas and blanks part them; the first text that is no number ends them.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end && numbers.size() < 3 * most_points) {
    if (is_blank(*at) || *at == ',') {
      ++at;
      continue;
    }
    double value = 0;
    const auto read = std::from_chars(at, end, value);
    if (read.ec != std::errc() || !std::isfinite(value)) break;
    numbers.push_back(value);
    at = read.ptr;
  }
  return numbers;
}

/// A function of funcedit: the value of a cubic B-spline over its x. The knots are 0 0 0 0 1 2 ... n n n n, so that it
/// begins and ends at its first and last point.
class Curve {
 public:
  explicit Curve(std::vector<std::array<double, 2>> points) : points_(std::move(points)) {}

  /// The y where x has this share of the way from the first point to the last. x rises along the curve.
  double at(double share) const {
    const double from = points_.front()[0], to = points_.back()[0], wanted = from + (to - from) * share;
    double low = 0, high = static_cast<double>(points_.size() - degree());
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (value(middle)[0] > wanted ? high : low) = middle;
    }
    return value((low + high) / 2)[1];
  }

 private:
  std::size_t degree() const { return std::min<std::size_t>(3, points_.size() - 1); }
  double knot(std::size_t i) const {
    return static_cast<double>(std::min(i < degree() + 1 ? 0 : i - degree(), points_.size() - degree()));
  }

  /// After C. de Boor, "On calculating with B-splines", 1972.
  std::array<double, 2> value(double t) const {
    const std::size_t count = degree();
    const std::size_t span =
        std::min(points_.size() - 1, count + static_cast<std::size_t>(std::max(0.0, std::floor(t))));
    std::array<std::array<double, 2>, 4> d{};
    for (std::size_t j = 0; j <= count; ++j) d[j] = points_[span - count + j];
    for (std::size_t r = 1; r <= count; ++r) {
      for (std::size_t j = count; j >= r; --j) {
        const double low = knot(j + span - count), high = knot(j + 1 + span - r);
        const double share = high > low ? (t - low) / (high - low) : 0;
        for (std::size_t axis = 0; axis < 2; ++axis)
          d[j][axis] = (1 - share) * d[j - 1][axis] + share * d[j][axis];
      }
    }
    return d[count];
  }

  std::vector<std::array<double, 2>> points_;
};

/// The curves of a file: one (`.func`) or several (`.fset`).
std::vector<Curve> curves_of(const std::string& text) {
  std::vector<Curve> curves;
  std::vector<std::array<double, 2>> points;
  std::size_t left = 0;
  for (const Line& each : lines_of(text)) {
    const Line line = trimmed(text, each);
    const std::string_view words = std::string_view(text).substr(line.from, line.to - line.from);
    if (words.substr(0, 7) == "points:") {
      const std::vector<double> count = numbers_of(words.substr(7));
      left = count.empty() ? 0 : static_cast<std::size_t>(std::clamp(count[0], 0.0, double(most_points)));
      points.clear();
    } else if (left > 0) {
      const std::vector<double> numbers = numbers_of(words);
      if (numbers.size() < 2) continue;
      const int times = numbers.size() > 2 ? static_cast<int>(std::clamp(numbers[2], 1.0, 10.0)) : 1;
      points.insert(points.end(), static_cast<std::size_t>(times), {numbers[0], numbers[1]});
      if (--left == 0 && points.size() >= 2 && curves.size() < most_functions) curves.emplace_back(points);
    }
  }
  return curves;
}

/// Whether `func(` is called somewhere.
bool calls_func(std::string_view text) {
  for (std::size_t at = text.find("func"); at != std::string_view::npos; at = text.find("func", at + 1)) {
    const std::size_t open = text.find_first_not_of(" \t", at + 4);
    if (open != std::string_view::npos && text[open] == '(' && (at == 0 || !is_name_part(text[at - 1])))
      return true;
  }
  return false;
}

class Files {
 public:
  Files(const std::map<std::string, std::string>& files, Json& parameters, ForeignText& source)
      : files_(files), parameters_(parameters), source_(source) {}

  void put() {
    std::vector<Curve> curves;
    bool has_view = false;
    std::vector<std::string> order;
    for (const auto& [name, text] : files_) {
      if (!ends_with(name, ".v")) continue;
      if (std::exchange(has_view, true)) {
        source_.report(0, "found a second view file, " + lang_quotes(name));
        continue;
      }
      for (const Entry& each : entries_of(text)) {
        if (each.key == "function" || each.key == "function set") order.push_back(first_word(each.value));
        view(name, each);
      }
    }
    // Functions are counted in the order of the view file; without one, in the order of their names.
    for (const auto& [name, text] : files_) {
      const bool is_curve = ends_with(name, ".func") || ends_with(name, ".fset");
      if (is_curve && std::find(order.begin(), order.end(), name) == order.end()) order.push_back(name);
      if (!is_curve && !ends_with(name, ".v")) {
        source_.warn(0, "the file " + lang_quotes(name) +
                            " is left out; only view files and files of functions are read");
      }
    }
    for (const std::string& name : order) {
      const auto found = files_.find(name);
      if (found == files_.end()) {
        source_.warn(0, "the view file names " + lang_quotes(name) + ", which is not given");
        continue;
      }
      for (Curve& each : curves_of(found->second)) curves.push_back(std::move(each));
    }
    if (curves.empty() && calls_func(source_.text())) {
      source_.warn(0,
                   "the file of functions is not given, so that `func(n, x)` is 1 everywhere; give it as one "
                   "of `files`");
      Json& list = parameters_["functions"];
      if (list.is_null()) list = Json::array();
      list.push_back("func(n, x) = 1");
    }
    if (!curves.empty()) functions(curves);
    if (!has_view) {
      source_.warn(0, "angle, width and colours are in cpfg's view file; the defaults are used",
                   "/parameters");
    }
  }

 private:
  static bool ends_with(std::string_view text, std::string_view end) {
    return text.size() >= end.size() && lower(text.substr(text.size() - end.size())) == end;
  }
  static std::string lang_quotes(std::string_view text) {
    return "`" + shortened(std::string(text), 60) + "`";
  }
  static std::string first_word(const std::string& text) { return text.substr(0, text.find_first_of(" \t")); }

  void view(const std::string& file, const Entry& entry) {
    const std::vector<double> numbers = numbers_of(entry.value);
    const auto is = [&](const char* key) { return entry.key == key && !numbers.empty(); };
    if (is("angle factor") && numbers[0] > 0) {
      parameters_["angle"] = 360 / numbers[0];
    } else if (is("angle increment")) {
      parameters_["angle"] = numbers[0];
    } else if (is("initial line width")) {
      if (entry.value.find('p') == std::string::npos && numbers[0] >= 0) {
        parameters_["width"] = numbers[0];
      } else {
        parameters_["style"] = "lines";
      }
    } else if (is("line width increment") && numbers[0] >= 0) {
      parameters_["width_decrement"] = numbers[0];
    } else if (entry.key == "line style") {
      if (lower(entry.value).substr(0, 5) == "pixel") parameters_["style"] = "lines";
    } else if (is("contour sides") && numbers[0] >= 3) {
      parameters_["sides"] = static_cast<int>(std::min(64.0, numbers[0]));
    } else if (entry.key == "surface") {
      surface(file, entry.value);
    } else if (entry.key == "tropism") {
      tropism(entry.value);
    } else if (std::find(std::begin(view_only), std::end(view_only), entry.key) == std::end(view_only)) {
      source_.warn(0, lang_quotes(file) + ": " + lang_quotes(entry.key) + " has no counterpart");
    }
  }

  /// `l leaf.s 800 ...`: the letter, the file and the scale.
  void surface(const std::string& file, const std::string& value) {
    if (value.empty()) return;
    const std::string name = is_letter(value[0]) ? value.substr(0, 1) : "_" + value.substr(0, 1);
    Json& surfaces = parameters_["surfaces"];
    if (surfaces.is_null() || !surfaces.contains(name)) return;
    const std::size_t from = value.find_first_not_of(" \t", 1);
    const std::size_t end = from == std::string::npos ? from : value.find_first_of(" \t", from);
    const std::vector<double> numbers =
        numbers_of(end == std::string::npos ? "" : std::string_view(value).substr(end));
    if (!numbers.empty() && numbers[0] > 0 && numbers[0] <= 1e6) surfaces[name]["size"] = numbers[0];
    source_.warn(0, lang_quotes(file) + ": a leaf replaces the surface " + lang_quotes(value.substr(0, end)),
                 "/parameters/surfaces/" + name);
  }

  /// `T: 0 -1 0 A: 90 I: 1 E: 0.1 S: 0.02`
  void tropism(const std::string& value) {
    const auto part = [&](const char* key) {
      const std::size_t at = value.find(key);
      return at == std::string::npos ? std::vector<double>()
                                     : numbers_of(std::string_view(value).substr(at + 2));
    };
    const std::vector<double> to = part("T:"), angle = part("A:"), pull = part("E:"), step = part("S:");
    if (to.size() < 3 || !(to[0] * to[0] + to[1] * to[1] + to[2] * to[2] > 0)) return;
    if (!angle.empty() && angle[0] != 0) {
      source_.warn(0, "a tropism at an angle has no counterpart; it bends toward its direction here");
    }
    Json each = {{"direction", {to[0], to[1], to[2]}}, {"elasticity", pull.empty() ? 0.0 : pull[0]}};
    if (!step.empty()) each["step"] = step[0];
    if (parameters_["tropism"].is_null()) parameters_["tropism"] = Json::array();
    if (parameters_["tropism"].size() < 16) parameters_["tropism"].push_back(std::move(each));
  }

  /// func(n, x) as a function over an array of samples: between two samples the value is linear, as in cpfg.
  void functions(const std::vector<Curve>& curves) {
    Json samples = Json::array();
    for (const Curve& curve : curves) {
      for (std::size_t i = 0; i < most_samples; ++i)
        samples.push_back(curve.at(static_cast<double>(i) / static_cast<double>(most_samples - 1)));
    }
    parameters_["arrays"]["cpfg_functions"] = std::move(samples);
    Json& list = parameters_["functions"];
    if (list.is_null()) list = Json::array();
    const std::string size = std::to_string(most_samples), last = std::to_string(most_samples - 1);
    list.push_back("func_at(n, x) = (n - 1) * " + size + " + clamp(x, 0, 1) * " + last);
    list.push_back(
        "func(n, x) = lerp(cpfg_functions[func_at(n, x)], cpfg_functions[min(func_at(n, x) + 1, n * " + size +
        " - 1)], func_at(n, x) - floor(func_at(n, x)))");
  }

  const std::map<std::string, std::string>& files_;
  Json& parameters_;
  ForeignText& source_;
};

}  // namespace

void put_cpfg_files(const std::map<std::string, std::string>& files, Json& parameters, ForeignText& source) {
  Files(files, parameters, source).put();
}

}  // namespace seedmesh
