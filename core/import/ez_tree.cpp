/// Trees of ez-tree (Daniel Greenheck, MIT): its options as JSON, as its page saves and loads them. They
/// become a tree of the model weber_penn, whose levels, lengths, angles and tapers mean nearly the same. What
/// has no counterpart becomes a warning.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/base/math.h"
#include "core/generators/registry.h"
#include "core/import/formats.h"

namespace seedmesh {
namespace {

// ez-tree's lengths are no metres: its medium oak is 63 high.
constexpr double metres = 0.2;
constexpr int levels_known = 4;
// Divergence of leaves and of children that follow each other along a limb.
constexpr double spiral = 137.5;
// The share of a parent's length that Weber and Penn take off for a child at its tip.
constexpr double tip_loss = 0.6;

struct Reader {
  std::vector<Issue> issues;
  std::vector<Warning> warnings;

  void fault(const std::string& pointer, std::string message) {
    issues.push_back({pointer, std::move(message), 0, 0});
  }
  /// Of what stands at `pointer` of the file; "": of all.
  void warn(const std::string& pointer, std::string message) {
    warnings.push_back({pointer, std::move(message), 0, 0});
  }

  const Json* member(const Json& from, const std::string& at, const char* name) {
    const auto found = from.find(name);
    if (found == from.end()) return nullptr;
    if (found->is_object()) return &*found;
    fault(at + "/" + name, "found " + std::string(found->type_name()) + ", expected an object");
    return nullptr;
  }

  double number(const Json* from, const std::string& at, const std::string& name, double otherwise,
                std::pair<double, double> range) {
    if (!from) return otherwise;
    const auto found = from->find(name);
    if (found == from->end()) return otherwise;
    if (!found->is_number()) {
      fault(at + "/" + name, "found " + std::string(found->type_name()) + ", expected a number");
      return otherwise;
    }
    const double value = found->get<double>();
    if (value >= range.first && value <= range.second) return value;
    fault(at + "/" + name, "found " + Json(value).dump() + ", expected " + Json(range.first).dump() + " to " +
                               Json(range.second).dump());
    return otherwise;
  }

  std::string word(const Json* from, const std::string& at, const char* name) {
    if (!from) return "";
    const auto found = from->find(name);
    if (found == from->end()) return "";
    if (found->is_string()) return found->get<std::string>();
    fault(at + "/" + name, "found " + std::string(found->type_name()) + ", expected a text");
    return "";
  }

  void known(const Json* from, const std::string& at, const std::set<std::string>& names) {
    if (!from) return;
    for (const auto& [name, value] : from->items()) {
      if (!names.contains(name))
        fault(at + "/" + pointer_token(name).substr(1),
              "\"" + shortened(name, 40) + "\" is no option of ez-tree");
    }
  }
};

struct Level {
  double angle = 60, children = 0, gnarliness = 0, length = 1, radius = 1, sections = 6, segments = 4,
         start = 0, taper = 0.7, twist = 0;
};

/// Missing members are those of a new tree of ez-tree 1.1.
std::array<Level, levels_known> usual_levels() {
  return {{{0, 7, 0.15, 20, 1.5, 12, 8, 0, 0.7, 0},
           {70, 7, 0.2, 20, 0.7, 10, 6, 0.4, 0.7, 0},
           {60, 5, 0.3, 10, 0.7, 8, 4, 0.3, 0.7, 0},
           {60, 0, 0.02, 1, 0.7, 6, 3, 0.3, 0.7, 0}}};
}

std::array<Level, levels_known> levels_of(Reader& reader, const Json* branch) {
  std::array<Level, levels_known> levels = usual_levels();
  struct Column {
    const char* name;
    double Level::*member;
    std::pair<double, double> range;
  };
  static const Column columns[] = {{"angle", &Level::angle, {0, 180}},
                                   {"children", &Level::children, {0, 500}},
                                   {"gnarliness", &Level::gnarliness, {-2, 2}},
                                   {"length", &Level::length, {0.01, 500}},
                                   {"radius", &Level::radius, {0.001, 50}},
                                   {"sections", &Level::sections, {1, 60}},
                                   {"segments", &Level::segments, {3, 64}},
                                   {"start", &Level::start, {0, 1}},
                                   {"taper", &Level::taper, {0, 1}},
                                   {"twist", &Level::twist, {-6.3, 6.3}}};
  for (const Column& column : columns) {
    const Json* object = branch ? reader.member(*branch, "/branch", column.name) : nullptr;
    const std::string at = std::string("/branch/") + column.name;
    reader.known(object, at, {"0", "1", "2", "3"});
    for (std::size_t i = 0; i < levels.size(); ++i) {
      double& value = levels[i].*column.member;
      value = reader.number(object, at, std::to_string(i), value, column.range);
    }
  }
  return levels;
}

double clamped(double value, double low, double high) {
  return std::round(1e6 * std::clamp(value, low, high)) / 1e6;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return text;
}

/// "#rrggbb" of ez-tree's number; empty where it is white, which changes nothing.
std::string color_of(Reader& reader, const Json* from, const std::string& at) {
  const double tint = reader.number(from, at, "tint", 0xFFFFFF, {0, 0xFFFFFF});
  const auto bits = math::to_uint32(tint);
  if (bits == 0xFFFFFF) return "";
  std::string text = "#";
  for (int shift = 20; shift >= 0; shift -= 4)
    text += "0123456789abcdef"[bits >> static_cast<unsigned>(shift) & 15U];
  return text;
}

class Writer {
 public:
  Writer(const Json& file, Reader& reader) : file_(file), reader_(reader) {}

  Json parameters() {
    branch_ = reader_.member(file_, "", "branch");
    reader_.known(branch_, "/branch",
                  {"levels", "angle", "children", "force", "gnarliness", "length", "radius", "sections",
                   "segments", "start", "taper", "twist"});
    level_ = levels_of(reader_, branch_);
    count_ = static_cast<int>(reader_.number(branch_, "/branch", "levels", 3, {0, 3})) + 1;
    is_evergreen_ = lower_case(reader_.word(&file_, "", "type")) == "evergreen";
    leaves_ = reader_.member(file_, "", "leaves");
    leaf_angle_ = reader_.number(leaves_, "/leaves", "angle", 10, {0, 180});
    write_tree();
    for (int i = 0; i < levels_known; ++i) write_level(static_cast<std::size_t>(i));
    write_force();
    write_leaves();
    write_bark();
    write_warnings();
    return std::move(out_);
  }

 private:
  void write_tree() {
    out_["model"] = "weber_penn";
    out_["Levels"] = count_;
    out_["Shape"] = is_evergreen_ ? 0 : 3;
    out_["Scale"] = clamped(level_[0].length * metres, 0.01, 100);
    out_["ScaleV"] = 0;
    out_["BaseSize"] = clamped(level_[1].start, 0, 0.99);
    out_["Ratio"] = clamped(level_[0].radius / level_[0].length, 1e-4, 0.2);
    const double shorter = level_[1].length / level_[0].length;
    const double power = std::abs(shorter - 1) < 1e-3 || level_[1].radius >= 1
                             ? 1
                             : math::log(level_[1].radius) / math::log(std::min(shorter, 0.99));
    out_["RatioPower"] = clamped(power, 0.3, 3);
    out_["Flare"] = 0.3;
    out_["Lobes"] = 0;
    out_["sides"] = static_cast<int>(level_[0].segments);
  }

  void write_level(std::size_t i) {
    const Level& own = level_[i];
    const std::string n = std::to_string(i);
    out_[n + "Taper"] = clamped(is_evergreen_ ? 1 : own.taper, 0, 1);
    out_[n + "CurveRes"] = static_cast<int>(own.sections);
    out_[n + "Curve"] = 0;
    // Each section turns by up to the gnarliness, more where it is thin.
    double radius = level_[0].radius;
    for (std::size_t k = 1; k <= i; ++k) radius *= level_[k].radius;
    const double turn = std::abs(own.gnarliness) * std::max(1.0, 1 / std::sqrt(std::max(radius, 1e-3)));
    out_[n + "CurveV"] = clamped(math::degrees(turn) * own.sections, 0, 720);
    if (i == 0) {
      out_["0Length"] = 1;
      return;
    }
    const Level& parent = level_[i - 1];
    const bool bears_leaves = static_cast<int>(i) >= count_;
    out_[n + "DownAngle"] = clamped(bears_leaves ? leaf_angle_ : own.angle, 0, 180);
    out_[n + "DownAngleV"] = 0;
    out_[n + "Rotate"] = spiral;
    out_[n + "RotateV"] = 20;
    out_[n + "Branches"] = static_cast<int>(parent.children);
    const double loss = i == 1 ? 1 : 1 - tip_loss * 0.5 * (1 + own.start);
    out_[n + "Length"] = clamped(own.length / parent.length / loss, 0, 3);
  }

  void write_force() {
    const Json* force = branch_ ? reader_.member(*branch_, "/branch", "force") : nullptr;
    reader_.known(force, "/branch/force", {"direction", "strength"});
    const Json* direction = force ? reader_.member(*force, "/branch/force", "direction") : nullptr;
    reader_.known(direction, "/branch/force/direction", {"x", "y", "z"});
    const std::string at = "/branch/force/direction";
    const double strength = reader_.number(force, "/branch/force", "strength", 0.01, {-1, 1});
    const double up = reader_.number(direction, at, "y", 1, {-1, 1});
    const double aside = std::abs(reader_.number(direction, at, "x", 0, {-1, 1})) +
                         std::abs(reader_.number(direction, at, "z", 0, {-1, 1}));
    const double thin = level_[0].radius * level_[1].radius * level_[2].radius;
    out_["AttractionUp"] = clamped(strength * up * level_[2].sections / std::max(thin, 0.05), -10, 10);
    if (aside > 0 && strength != 0)
      reader_.warn("/branch/force/direction", "limbs are drawn up or down only, not to a side");
  }

  void write_leaves() {
    const Json* leaves = leaves_;
    const std::string at = "/leaves";
    reader_.known(leaves, at,
                  {"type", "billboard", "angle", "count", "start", "size", "sizeVariance", "tint",
                   "alphaTest", "roundedNormals"});
    const std::string type = lower_case(reader_.word(leaves, at, "type"));
    static const std::map<std::string, std::string> shapes = {
        {"ash", "compound"}, {"aspen", "cordate"}, {"oak", "lobed"}, {"pine", "needles"}, {"", "lobed"}};
    const auto shape = shapes.find(type);
    if (shape == shapes.end())
      reader_.fault("/leaves/type",
                    "found \"" + shortened(type, 40) + "\", expected ash, aspen, oak or pine");
    const double size = reader_.number(leaves, at, "size", 2.5, {0, 100});
    const auto count = static_cast<int>(reader_.number(leaves, at, "count", 1, {0, 500}));
    out_["Leaves"] = count;
    out_["LeafScale"] = clamped(size * metres, 0.005, 5);
    out_["LeafScaleX"] = 1;
    Json leaf = {{"shape", shape == shapes.end() ? "lobed" : shape->second}};
    const bool is_single = lower_case(reader_.word(leaves, at, "billboard")) == "single";
    leaf["build"] = is_single ? "card" : "cross";
    if (count == 0 || size == 0) leaf["build"] = "none";
    if (is_evergreen_) leaf["evergreen"] = true;
    if (type == "pine") leaf["color"] = "#3f6b3a";
    const std::string color = color_of(reader_, leaves, at);
    if (!color.empty()) leaf["color"] = color;
    out_["leaf"] = std::move(leaf);
    if (reader_.number(leaves, at, "sizeVariance", 0, {0, 10}) > 0)
      reader_.warn("/leaves/sizeVariance", "leaves of one tree are of one size");
    if (reader_.number(leaves, at, "start", 0, {0, 1}) > 0)
      reader_.warn("/leaves/start", "leaves stand along the whole limb");
  }

  void write_bark() {
    const Json* bark = reader_.member(file_, "", "bark");
    reader_.known(bark, "/bark", {"type", "tint", "flatShading", "textured", "textureScale"});
    const std::string type = lower_case(reader_.word(bark, "/bark", "type"));
    out_["bark"] = type == "birch"    ? "birch_bark"
                   : type == "pine"   ? "pine_bark"
                   : type == "willow" ? "willow_bark"
                                      : "oak_bark";
    const std::string color = color_of(reader_, bark, "/bark");
    if (!color.empty()) out_["bark_color"] = color;
  }

  void write_warnings() {
    reader_.warn(
        "",
        "lengths are taken as fifths of a metre; chance is drawn by place: the tree is like the saved one, "
        "not the same");
    for (const Level& each : level_) {
      if (each.twist == 0) continue;
      reader_.warn("/branch/twist", "limbs do not turn about their own axis");
      break;
    }
    if (level_[2].start > 0 || level_[3].start > 0)
      reader_.warn("/branch/start", "beyond the first level limbs stand along the whole parent");
    const Json* trellis = reader_.member(file_, "", "trellis");
    if (trellis && trellis->value("enabled", Json(false)) == Json(true))
      reader_.warn("/trellis", "there is none here; an L-system with guides can have one");
  }

  const Json& file_;
  Reader& reader_;
  const Json *branch_ = nullptr, *leaves_ = nullptr;
  double leaf_angle_ = 10;
  std::array<Level, levels_known> level_;
  int count_ = 4;
  bool is_evergreen_ = false;
  Json out_ = Json::object();
};

}  // namespace

int marks_of_ez_tree(std::string_view text) {
  const Result<Json> file = parse_json(text);
  if (!file || !file->is_object()) return 0;
  int marks = 0;
  for (const char* name : {"branch", "leaves", "bark"}) {
    if (const auto found = file->find(name); found != file->end()) marks += found->is_object() ? 4 : 1;
  }
  return marks;
}

Result<Imported> import_ez_tree(std::string_view text, const ImportOptions& options) {
  if (!options.entry.empty()) {
    return Error{Code::invalid, {{"/entry", "a file of ez-tree holds one tree; expected no entry"}}};
  }
  Result<Json> file = parse_json(text);
  if (!file) return std::move(file).error();
  if (!file->is_object())
    return Error{Code::invalid, {{"", "expected an object of ez-tree's options", 0, 0}}};
  Reader reader;
  reader.known(&*file, "", {"seed", "type", "bark", "branch", "leaves", "trellis"});
  if (!file->contains("branch"))
    reader.fault("", "found no member \"branch\", which every tree of ez-tree has");
  const double seed = reader.number(&*file, "", "seed", 0, {0, 9007199254740991});
  Imported imported;
  Json parameters = Writer(*file, reader).parameters();
  if (!reader.issues.empty()) return Error{Code::invalid, std::move(reader.issues)};
  imported.request = {{"generator", "tree"},
                      {"seed", static_cast<std::uint64_t>(math::to_int64(seed))},
                      {"parameters", std::move(parameters)}};
  imported.warnings = std::move(reader.warnings);
  return imported;
}

}  // namespace seedmesh
