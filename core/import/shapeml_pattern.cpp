/// Splits of ShapeML by a pattern, such as splitX("f(fs)f", size, { ... }, ...). Source: its interpreter.
///
/// f is a fixed size, s one that stretches, and brackets repeat. All brackets have the same number of repetitions. Fixed
/// parts are never cut: what does not fit is left out. CityEngine cuts them, and counts each repetition by itself, so
/// that such patterns are written with their numbers of repetitions.
#include <algorithm>

#include "core/import/shapeml_reader.h"

namespace seedmesh {
namespace {

constexpr char length_name[] = "own_pattern_length";

/// A part of a pattern.
struct PatternPart {
  bool is_fixed = false;
  int group = -1;  ///< of the brackets around it; -1: outside
};

/// The parts of a pattern; none if it is not valid.
std::vector<PatternPart> parts_of(std::string_view signs, int& groups) {
  std::vector<PatternPart> parts;
  bool is_inside = false;
  for (const char sign : signs) {
    if (sign == '(' && !is_inside) {
      is_inside = true;
      ++groups;
    } else if (sign == ')' && is_inside) {
      is_inside = false;
    } else if (sign == 'f' || sign == 's') {
      parts.push_back({sign == 'f', is_inside ? groups - 1 : -1});
    } else {
      return {};
    }
  }
  return is_inside ? std::vector<PatternPart>() : parts;
}

}  // namespace

/// Writes one split.
class ShapemlPattern {
 public:
  using Range = std::pair<std::size_t, std::size_t>;

  ShapemlPattern(ShapemlReader& reader, std::size_t at, std::vector<PatternPart> parts, int groups,
                 std::span<const Range> given, int depth)
      : reader_(reader), at_(at), parts_(std::move(parts)), groups_(groups), given_(given), depth_(depth) {
    axis_ = static_cast<char>(reader_.at(at_).text.back() | 0x20);
  }

  void write() {
    const bool has_stretch = has([](const PatternPart& part) { return !part.is_fixed; });
    if (groups_ > 1) return write_groups();
    if (has_stretch) return write_parts(Sizes::plain);
    reader_.need(groups_ == 0 ? "pattern_fit" : "pattern_count");
    write_parts(groups_ == 0 ? Sizes::fitting : Sizes::counted);
  }

  /// Whether the sizes are used several times, so that they must not be random.
  bool repeats_sizes() const {
    return groups_ > 1 || !has([](const PatternPart& part) { return !part.is_fixed; });
  }

 private:
  enum class Sizes { plain, fitting, counted };

  template <class Is>
  bool has(const Is& is) const {
    return std::any_of(parts_.begin(), parts_.end(), is);
  }

  void text(std::string_view words) { reader_.rules_.write(words, reader_.at(at_).offset); }

  void size(std::size_t part) {
    text("(");
    reader_.expression(given_[1 + 2 * part].first, given_[1 + 2 * part].second, reader_.rules_);
    text(")");
  }

  /// The sum of the sizes of some parts.
  template <class Is>
  void sum(const Is& is) {
    bool is_first = true;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (!is(parts_[i])) continue;
      text(is_first ? "" : " + ");
      size(i);
      is_first = false;
    }
    text(is_first ? "0" : "");
  }

  /// The length that is divided. Parts of parts read it from an attribute.
  void length() { text(groups_ > 1 ? std::string(length_name) : std::string("scope.s") + axis_); }

  /// The number of repetitions of all brackets.
  void count() {
    const auto is_outer = [](const PatternPart& part) { return part.group < 0; };
    const bool inner_alone = !has([&](const PatternPart& part) {
      return is_outer(part) && !part.is_fixed;
    }) && has([&](const PatternPart& part) { return !is_outer(part) && !part.is_fixed; });
    text("pattern_count(");
    length();
    text(", ");
    sum(is_outer);
    text(", ");
    sum([&](const PatternPart& part) { return is_outer(part) && part.is_fixed; });
    text(", ");
    sum([&](const PatternPart& part) { return !is_outer(part); });
    text(", ");
    sum([&](const PatternPart& part) { return !is_outer(part) && part.is_fixed; });
    text(inner_alone ? ", 1)" : ", 0)");
  }

  /// The factor of the sizes that stretch.
  void factor() {
    const auto some = [&](bool is_outer, bool is_fixed) {
      text(", ");
      sum([&](const PatternPart& part) { return (part.group < 0) == is_outer && part.is_fixed == is_fixed; });
    };
    text("pattern_stretch(");
    length();
    some(true, true);
    some(true, false);
    some(false, true);
    some(false, false);
    text(", ");
    count();
    text(")");
  }

  void operations(std::size_t part) { reader_.block(given_[2 + 2 * part], depth_, "split.index"); }

  void write_parts(Sizes sizes) {
    text(std::string(" split(") + axis_ + ") {");
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const bool begins = parts_[i].group >= 0 && (i == 0 || parts_[i - 1].group < 0);
      const bool ends = parts_[i].group >= 0 && (i + 1 == parts_.size() || parts_[i + 1].group < 0);
      text(i == 0 ? " " : " | ");
      text(begins ? "{ " : "");
      if (sizes == Sizes::fitting) {
        text("pattern_fit(");
        for (std::size_t k = 0; k <= i; ++k) {
          text(k == 0 ? "" : " + ");
          size(k);
        }
        text(", ");
        length();
        text(") * ");
      } else if (!parts_[i].is_fixed || (sizes == Sizes::counted && parts_[i].group >= 0)) {
        text("~");
      }
      size(i);
      text(" :");
      operations(i);
      text(ends ? " }*" : "");
    }
    if (sizes == Sizes::counted) {
      text(" | max(0, ");
      length();
      text(" - (");
      sum([](const PatternPart& part) { return part.group < 0; });
      text(") - ");
      count();
      text(" * (");
      sum([](const PatternPart& part) { return part.group >= 0; });
      text(")) : NIL");
    }
    text(" }");
  }

  /// Each of several brackets is a part of its own, whose parts repeat.
  void write_groups() {
    reader_.need("pattern_count");
    reader_.need("pattern_stretch");
    reader_.warn_of_index(at_, "`index` begins again in each of the brackets of a pattern");
    reader_.attributes_.insert(length_name);
    text(std::string(" set(") + length_name + ", scope.s" + axis_ + ") split(" + axis_ + ") {");
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      text(i == 0 ? " " : " | ");
      const int group = parts_[i].group;
      if (group < 0) {
        text(parts_[i].is_fixed ? "" : "~");
        size(i);
        text(" :");
        operations(i);
        continue;
      }
      count();
      text(" * (");
      sum([&](const PatternPart& part) { return part.group == group && part.is_fixed; });
      text(" + ");
      factor();
      text(" * (");
      sum([&](const PatternPart& part) { return part.group == group && !part.is_fixed; });
      text(std::string(")) : split(") + axis_ + ") {");
      for (bool is_first = true; i < parts_.size() && parts_[i].group == group; ++i, is_first = false) {
        text(is_first ? " ~" : " | ~");
        size(i);
        if (!parts_[i].is_fixed) {
          text(" * ");
          factor();
        }
        text(" :");
        operations(i);
      }
      --i;
      text(" }* NIL");
    }
    text(" }");
  }

  ShapemlReader& reader_;
  std::size_t at_;
  std::vector<PatternPart> parts_;
  int groups_;
  std::span<const Range> given_;
  int depth_;
  char axis_ = 'x';
};

void ShapemlReader::pattern(std::size_t i, const std::string& signs,
                            const std::vector<std::pair<std::size_t, std::size_t>>& given, int depth) {
  int groups = 0;
  std::vector<PatternPart> parts = parts_of(signs, groups);
  if (parts.empty() || given.size() != 1 + 2 * parts.size())
    return error(i, "the pattern of " + in_quotes(at(i)) + " does not fit its sizes and operations");
  ShapemlPattern pattern(*this, i, std::move(parts), groups, given, depth);
  for (std::size_t k = 1; k < given.size() && pattern.repeats_sizes(); k += 2) {
    for (std::size_t token = given[k].first; token < given[k].second; ++token) {
      if (at(token).text.starts_with("rand_"))
        return error(token, "random sizes in a pattern of fixed sizes have no counterpart");
    }
  }
  pattern.write();
}

}  // namespace seedmesh
