/// Reads trees of ez-tree (Daniel Greenheck, MIT): the JSON options that its page saves and loads. They become a tree of
/// the model ez_tree, which has the same limbs and leaves. An option without a counterpart becomes a warning.
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>

#include "core/base/math.h"
#include "core/import/foreign_text.h"
#include "core/import/formats.h"

namespace seedmesh {
namespace {

constexpr int levels_known = 4;

struct Reader {
  std::vector<Issue> issues;
  std::vector<Warning> warnings;

  void report(IssueCause cause, const std::string& pointer, std::string message) {
    issues.emplace_back(std::move(cause), pointer, std::move(message));
  }
  /// `pointer` leads into the file; "" is the whole file.
  void warn(const std::string& pointer, std::string message) {
    warnings.push_back({pointer, std::move(message), 0, 0});
  }

  const Json* member(const Json& from, const std::string& at, const char* name) {
    const auto found = from.find(name);
    if (found == from.end()) return nullptr;
    if (found->is_object()) return &*found;
    report(IssueKind::wrong_type, at + "/" + name,
           "found " + std::string(found->type_name()) + ", expected an object");
    return nullptr;
  }

  double number(const Json* from, const std::string& at, const std::string& name, double otherwise,
                std::pair<double, double> range) {
    if (!from) return otherwise;
    const auto found = from->find(name);
    if (found == from->end()) return otherwise;
    if (!found->is_number()) {
      report(IssueKind::wrong_type, at + "/" + name,
             "found " + std::string(found->type_name()) + ", expected a number");
      return otherwise;
    }
    const double value = found->get<double>();
    if (value >= range.first && value <= range.second) return value;
    report(IssueKind::out_of_range, at + "/" + name,
           "found " + Json(value).dump() + ", expected " + Json(range.first).dump() + " to " +
               Json(range.second).dump());
    return otherwise;
  }

  std::string word(const Json* from, const std::string& at, const char* name) {
    if (!from) return "";
    const auto found = from->find(name);
    if (found == from->end()) return "";
    if (found->is_string()) return found->get<std::string>();
    report(IssueKind::wrong_type, at + "/" + name,
           "found " + std::string(found->type_name()) + ", expected a text");
    return "";
  }

  void known(const Json* from, const std::string& at, const std::set<std::string>& names) {
    if (!from) return;
    for (const auto& [name, value] : from->items()) {
      if (!names.contains(name)) {
        report(IssueKind::unknown_key, at + pointer_token(name),
               "\"" + shortened(name, 40) + "\" is not an option of ez-tree");
      }
    }
  }
};

struct Level {
  double angle = 60, children = 0, gnarliness = 0, length = 1, radius = 1, sections = 6, segments = 4,
         start = 0, taper = 0.7, twist = 0;
};

/// The defaults of ez-tree 1.1.
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

/// The number of a colour that is a text, as presets before 1.0 and pages have it: "0xfcffdc" or "#fcffdc".
std::optional<std::uint32_t> written_color(std::string_view text) {
  if (!text.starts_with("#") && !text.starts_with("0x")) return std::nullopt;
  text.remove_prefix(text[0] == '#' ? 1 : 2);
  std::uint32_t bits = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bits, 16);
  const bool is_whole = text.size() == 6 && error == std::errc() && end == text.data() + text.size();
  return is_whole ? std::optional(bits) : std::nullopt;
}

/// "#rrggbb" for the number of ez-tree; empty for white, which has no effect.
std::string color_of(Reader& reader, const Json* from, const std::string& at) {
  const Json given = from ? from->value("tint", Json()) : Json();
  const std::optional<std::uint32_t> written =
      given.is_string() ? written_color(given.get_ref<const std::string&>()) : std::nullopt;
  const double tint = written ? *written : reader.number(from, at, "tint", 0xFFFFFF, {0, 0xFFFFFF});
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
    is_evergreen_ = lower(reader_.word(&file_, "", "type")) == "evergreen";
    leaves_ = reader_.member(file_, "", "leaves");
    write_tree();
    write_force();
    write_leaves();
    write_trellis();
    out_["model"] = "ez_tree";
    out_["sides"] = static_cast<int>(level_[0].segments);
    out_["ez_tree"] = std::move(tree_);
    write_bark();
    reader_.warn(
        "", "lengths are read as fifths of a metre; the images of bark and leaves are those of this program");
    return std::move(out_);
  }

 private:
  void write_tree() {
    tree_["evergreen"] = is_evergreen_;
    tree_["levels"] = static_cast<int>(reader_.number(branch_, "/branch", "levels", 3, {0, 3}));
    Json levels = Json::array();
    for (const Level& own : level_) {
      levels.push_back({{"angle", own.angle},
                        {"children", static_cast<int>(own.children)},
                        {"gnarliness", own.gnarliness},
                        {"length", own.length},
                        {"radius", own.radius},
                        {"sections", static_cast<int>(own.sections)},
                        {"start", own.start},
                        {"taper", own.taper},
                        {"twist", own.twist}});
    }
    tree_["level"] = std::move(levels);
  }

  void write_force() {
    const Json* force = branch_ ? reader_.member(*branch_, "/branch", "force") : nullptr;
    reader_.known(force, "/branch/force", {"direction", "strength"});
    const Json* direction = force ? reader_.member(*force, "/branch/force", "direction") : nullptr;
    reader_.known(direction, "/branch/force/direction", {"x", "y", "z"});
    const std::string at = "/branch/force/direction";
    tree_["force_strength"] = reader_.number(force, "/branch/force", "strength", 0.01, {-1, 1});
    tree_["force_x"] = reader_.number(direction, at, "x", 0, {-1, 1});
    tree_["force_y"] = reader_.number(direction, at, "y", 1, {-1, 1});
    tree_["force_z"] = reader_.number(direction, at, "z", 0, {-1, 1});
  }

  void write_leaves() {
    const Json* leaves = leaves_;
    const std::string at = "/leaves";
    reader_.known(leaves, at,
                  {"type", "billboard", "angle", "count", "start", "size", "sizeVariance", "tint",
                   "alphaTest", "roundedNormals"});
    const std::string type = lower(reader_.word(leaves, at, "type"));
    static const std::map<std::string, std::string> shapes = {
        {"ash", "compound"}, {"aspen", "cordate"}, {"oak", "lobed"}, {"pine", "pine_needles"}, {"", "lobed"}};
    const auto shape = shapes.find(type);
    if (shape == shapes.end()) {
      reader_.report(IssueKind::invalid_value, "/leaves/type",
                     "found \"" + shortened(type, 40) + "\", expected ash, aspen, oak or pine");
    }
    const double size = reader_.number(leaves, at, "size", 2.5, {0, 100});
    const auto count = static_cast<int>(reader_.number(leaves, at, "count", 1, {0, 500}));
    tree_["leaf_angle"] = reader_.number(leaves, at, "angle", 10, {0, 180});
    tree_["leaf_count"] = count;
    tree_["leaf_start"] = reader_.number(leaves, at, "start", 0, {0, 1});
    tree_["leaf_size_variance"] = reader_.number(leaves, at, "sizeVariance", 0.7, {0, 1});
    if (size > 0) tree_["leaf_size"] = size;
    Json leaf = {{"shape", shape == shapes.end() ? "lobed" : shape->second}};
    const bool is_single = lower(reader_.word(leaves, at, "billboard")) == "single";
    leaf["build"] = is_single ? "card" : "cross";
    if (size == 0) leaf["build"] = "none";
    if (is_evergreen_) leaf["evergreen"] = true;
    if (type == "pine") leaf["color"] = "#3f6b3a";
    const std::string color = color_of(reader_, leaves, at);
    if (!color.empty()) leaf["color"] = color;
    out_["leaf"] = std::move(leaf);
  }

  void write_trellis() {
    const Json* trellis = reader_.member(file_, "", "trellis");
    reader_.known(
        trellis, "/trellis",
        {"enabled", "position", "width", "height", "spacing", "force", "cylinderRadius", "visible", "color"});
    if (!trellis || trellis->value("enabled", Json(false)) != Json(true)) return;
    const Json* position = reader_.member(*trellis, "/trellis", "position");
    reader_.known(position, "/trellis/position", {"x", "y", "z"});
    const Json* force = reader_.member(*trellis, "/trellis", "force");
    reader_.known(force, "/trellis/force", {"strength", "maxDistance", "falloff"});
    const std::pair<double, double> anywhere{-1000, 1000}, size{0.001, 1000};
    tree_["trellis"] = {{"enabled", true},
                        {"x", reader_.number(position, "/trellis/position", "x", 0, anywhere)},
                        {"y", reader_.number(position, "/trellis/position", "y", 0, anywhere)},
                        {"z", reader_.number(position, "/trellis/position", "z", -2, anywhere)},
                        {"width", reader_.number(trellis, "/trellis", "width", 10, size)},
                        {"height", reader_.number(trellis, "/trellis", "height", 20, size)},
                        {"spacing", reader_.number(trellis, "/trellis", "spacing", 2, size)},
                        {"strength", reader_.number(force, "/trellis/force", "strength", 0.02, {-10, 10})},
                        {"max_distance", reader_.number(force, "/trellis/force", "maxDistance", 3, size)},
                        {"falloff", reader_.number(force, "/trellis/force", "falloff", 1, {0, 10})}};
    reader_.warn("/trellis", "limbs bend toward the trellis, but its bars are not drawn");
  }

  void write_bark() {
    const Json* bark = reader_.member(file_, "", "bark");
    reader_.known(bark, "/bark", {"type", "tint", "flatShading", "textured", "textureScale"});
    const std::string type = lower(reader_.word(bark, "/bark", "type"));
    const bool is_plain = bark && bark->value("textured", Json(true)) == Json(false);
    out_["bark"] = is_plain           ? "none"
                   : type == "birch"  ? "birch_bark"
                   : type == "pine"   ? "pine_bark"
                   : type == "willow" ? "willow_bark"
                                      : "oak_bark";
    const std::string color = color_of(reader_, bark, "/bark");
    if (!color.empty()) out_["bark_color"] = color;
  }

  const Json& file_;
  Reader& reader_;
  const Json *branch_ = nullptr, *leaves_ = nullptr;
  std::array<Level, levels_known> level_;
  bool is_evergreen_ = false;
  Json out_ = Json::object(), tree_ = Json::object();
};

}  // namespace

int marks_of_ez_tree(std::string_view text) {
  if (text.size() > largest_tree_file) return 0;
  const Result<Json> file = parse_json(text);
  if (!file || !file->is_object()) return 0;
  int marks = 0;
  for (const char* name : {"branch", "leaves", "bark"}) {
    if (const auto found = file->find(name); found != file->end()) marks += found->is_object() ? 4 : 1;
  }
  return marks;
}

Result<Imported> import_ez_tree(std::string_view text, const ImportOptions& options) {
  if (std::optional<Error> error = entry_error(options, "a file of ez-tree contains one tree"))
    return *std::move(error);
  Result<Json> file = parse_json(text);
  if (!file) return std::move(file).error();
  if (!file->is_object())
    return Error{Code::invalid, {{IssueKind::wrong_type, "", "expected an object of ez-tree's options"}}};
  if (file->contains("trunk")) {
    return Error{
        Code::invalid,
        {{IssueKind::not_available, "/trunk",
          "found \"trunk\", as versions of ez-tree before 0.1 have it; expected the options of version "
          "0.1 or later, in which the trunk is level 0 of \"branch\""}}};
  }
  Reader reader;
  reader.known(&*file, "", {"seed", "type", "bark", "branch", "leaves", "trellis"});
  if (!file->contains("branch"))
    reader.report(missing_for({"branch"}), "", "found no member \"branch\", which every tree of ez-tree has");
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
