/// Entries of Fractint's L-system files, as its manual has them ("L-Systems" and "L-System Commands",
/// Fractint 20.0):
///
///   Name { ; comment
///     Angle 6            the turn of + and - is 360 / 6 degrees
///     Axiom F--F--F
///     F=F+F--F+F         several rules of one symbol are joined
///   }
///
/// Letters are the same in both cases. The turtle starts to the right, in the plane of the picture.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/import/foreign_text.h"
#include "core/import/formats.h"
#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

constexpr int usual_order = 4;       // the file leaves the number of steps to who looks at it
constexpr double most_colors = 256;  // a palette of VGA
constexpr std::size_t longest_rule = 1'000'000;

struct Entry {
  std::string name;
  std::size_t name_at = 0;
  std::vector<Line> lines;  ///< without comments and blanks at their ends
};

/// The entries of a file. Text between entries that is no comment is a fault, as is a brace that lacks its
/// partner.
std::vector<Entry> entries_of(ForeignText& source) {
  const std::string_view text = source.text();
  std::vector<Entry> entries;
  bool inside = false;
  for (Line line : lines_of(text)) {
    line.to = std::min(text.substr(0, line.to).find(';', line.from), line.to);
    line = trimmed(text, line);
    while (line.from < line.to) {
      const std::string_view rest = text.substr(line.from, line.to - line.from);
      const char mark = inside ? '}' : '{';
      const std::size_t end = std::min(rest.find(mark), rest.size());
      const Line part = trimmed(text, {line.from, line.from + end});
      if (inside && part.from < part.to) entries.back().lines.push_back(part);
      if (end == rest.size()) {
        if (!inside) source.fault(line.from, "found text outside an entry; expected a name and `{`");
        break;
      }
      if (!inside)
        entries.push_back({std::string(text.substr(part.from, part.to - part.from)), line.from, {}});
      inside = !inside;
      line = trimmed(text, {line.from + end + 1, line.to});
    }
  }
  if (inside) source.fault(entries.back().name_at, "found an entry without its `}`");
  return entries;
}

/// One entry, command by command.
class EntryReader {
 public:
  EntryReader(ForeignText& source, const Entry& entry) : source_(source), entry_(entry) {}

  Imported read() {
    find_angle();
    for (const Line& line : entry_.lines) read_line(line);
    if (!axiom_) source_.fault(entry_.name_at, "found no axiom in this entry");
    if (divisions_ == 0) source_.fault(entry_.name_at, "found no angle in this entry");
    return made();
  }

 private:
  std::string_view word(Line line) const {
    std::size_t end = line.from;
    while (end < line.to && !is_blank(source_.text()[end]) && source_.text()[end] != '=') ++end;
    return source_.text().substr(line.from, end - line.from);
  }

  /// Rules may stand before the angle, and what | means depends on it.
  void find_angle() {
    for (const Line& line : entry_.lines) {
      const std::string_view first = word(line);
      if (lower(first) != "angle") continue;
      const Line rest = trimmed(source_.text(), {line.from + first.size(), line.to});
      std::size_t at = rest.from;
      double value = 0;
      const bool number = take_number(source_.text(), at, rest.to, value) && at == rest.to;
      if (!number || value != std::floor(value) || value < 3 || value > 50) {
        source_.fault(rest.from, "found no angle; expected a whole number from 3 to 50, the parts of a turn");
        divisions_ = 6;
      } else {
        divisions_ = static_cast<int>(value);
      }
    }
  }

  void read_line(Line line) {
    const std::string_view text = source_.text();
    const std::string_view first = word(line);
    const std::string name = lower(first);
    if (name == "angle") return;
    if (name == "axiom") {
      if (axiom_) source_.fault(line.from, "found a second axiom");
      axiom_ = commands({line.from + first.size(), line.to});
      axiom_at_ = line.from;
      return;
    }
    const Line after = trimmed(text, {line.from + 1, line.to});
    if (after.from >= line.to || text[after.from] != '=') {
      source_.fault(line.from, "found no command; expected Angle, Axiom or a rule such as F=F+F");
      return;
    }
    const char symbol = upper(text[line.from]);
    if (!is_letter(symbol) && !is_digit(symbol)) {
      source_.fault(line.from, std::string("found a rule for `") + symbol + "`; expected a letter or digit");
      return;
    }
    if (std::none_of(rules_.begin(), rules_.end(), [&](const Rule& each) { return each.symbol == symbol; })) {
      rules_.push_back({symbol, "", line.from});
    }
    for (Rule& each : rules_) {
      if (each.symbol == symbol) each.successor += commands({after.from + 1, line.to});
    }
  }

  static char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

  static std::string text_of(double number) { return number_text(number); }

  /// The turtle's commands in text[line] in our symbols.
  std::string commands(Line line) {
    const std::string_view text = source_.text();
    std::string out;
    for (std::size_t at = line.from; at < line.to;) {
      const std::size_t start = at;
      const char c = upper(text[at++]);
      if (is_blank(c)) continue;
      if (is_letter(c) && c != 'C') {
        used_[static_cast<unsigned char>(c)] = true;
        out += c;
      } else if (is_digit(c)) {
        out += c;
      } else if (c == '+' || c == '-' || c == '[' || c == ']') {
        out += c;
      } else if (c == '|') {
        out += half_turn();
      } else if (c == '\\' || c == '/') {
        out += (c == '\\' ? "+(" : "-(") + text_of(number(start, at, line.to)) + ")";
      } else if (c == 'C' || c == '<' || c == '>') {
        out += color(c, start, at, line.to);
      } else if (c == '!') {
        out += "@-";
      } else if (c == '@') {
        out += "@Di(" + text_of(factor(start, at, line.to)) + ")";
      } else {
        source_.fault(start, "found " + lang::in_quotes(text.substr(start, 1)) + ", which is no command");
      }
      if (out.size() > longest_rule) {
        source_.fault(start, "found a rule that is too long");
        break;
      }
    }
    return out;
  }

  /// As near to 180 degrees as the parts of a turn allow.
  std::string half_turn() const {
    if (divisions_ % 2 == 0) return "|";
    return "+(" + text_of(360.0 / std::max(divisions_, 1) * (divisions_ / 2)) + ")";
  }

  double number(std::size_t start, std::size_t& at, std::size_t to) {
    double value = 0;
    if (!take_number(source_.text(), at, to, value)) {
      source_.fault(start, std::string("found `") + source_.text()[start] + "` without its number");
    }
    return value;
  }

  /// @ with I (the inverse) and Q (the square root) before its number, in this order.
  double factor(std::size_t start, std::size_t& at, std::size_t to) {
    const auto take = [&](char letter) {
      if (at >= to || upper(source_.text()[at]) != letter) return false;
      ++at;
      return true;
    };
    const bool inverse = take('I'), root = take('Q');
    const std::size_t before = at;
    double value = number(start, at, to);
    if (at == before) return 1;
    if (root) value = std::sqrt(value);
    if (inverse) value = 1 / value;
    if (!(value > 0) || !std::isfinite(value)) {
      source_.fault(start, "found a factor of the step that is not above 0");
      return 1;
    }
    return value;
  }

  /// C sets the colour, < takes from it and > adds to it; the latter two by 1 where no number follows.
  std::string color(char command, std::size_t start, std::size_t& at, std::size_t to) {
    double value = 1;
    if (!take_number(source_.text(), at, to, value) && command == 'C') {
      // A letter like any other, unless its number follows.
      return "C";
    }
    if (value != std::floor(value) || value >= most_colors) {
      source_.fault(start, "found a colour that is no whole number below 256");
      return "";
    }
    if (!std::exchange(colored_, true)) {
      source_.warn(start,
                   "the colours of Fractint's palette are not known here: numbers choose from `materials`");
    }
    if (command == 'C') return ";(" + text_of(value) + ")";
    return std::string(static_cast<std::size_t>(value), command == '>' ? ';' : ',');
  }

  Imported made() {
    Imported out;
    if (!source_.sound()) return out;
    Json parameters;
    parameters["axiom"] = "-(90)" + *axiom_;  // Fractint's turtle looks to the right
    parameters["angle"] = 360.0 / divisions_;
    parameters["iterations"] = usual_order;
    parameters["style"] = "lines";
    Json productions = Json::array();
    for (const Rule& rule : rules_) {
      out.origins.push_back(
          {"/parameters/productions/" + std::to_string(productions.size()), rule.at, false});
      productions.push_back(std::string(1, rule.symbol) + " -> " + rule.successor);
    }
    parameters["productions"] = std::move(productions);
    Json interpretation = Json::array();
    for (const auto& [letter, meaning] :
         std::array<std::pair<char, const char*>, 3>{{{'D', "D -> F"}, {'G', "G -> f"}, {'M', "M -> f"}}}) {
      if (used_[static_cast<unsigned char>(letter)]) interpretation.push_back(meaning);
    }
    parameters["interpretation"] = std::move(interpretation);
    out.origins.push_back({"/parameters/axiom", axiom_at_, false});
    out.request = {{"generator", "lsystem"}, {"parameters", std::move(parameters)}};
    source_.warn(
        entry_.name_at,
        "an entry does not say how many steps it wants; `iterations` is " + std::to_string(usual_order),
        "/parameters/iterations");
    return out;
  }

  struct Rule {
    char symbol;
    std::string successor;
    std::size_t at;
  };

  ForeignText& source_;
  const Entry& entry_;
  int divisions_ = 0;
  std::optional<std::string> axiom_;
  std::size_t axiom_at_ = 0;
  std::vector<Rule> rules_;
  std::array<bool, 256> used_{};
  bool colored_ = false;
};

std::string list_of(const std::vector<Entry>& entries) {
  std::string names;
  for (std::size_t i = 0; i < entries.size() && i < 50; ++i) names += (i == 0 ? "" : ", ") + entries[i].name;
  return names + (entries.size() > 50 ? ", ..." : "");
}

}  // namespace

Result<Imported> import_fractint(std::string_view text, const ImportOptions& options) {
  ForeignText source(text);
  const std::vector<Entry> entries = entries_of(source);
  const Entry* chosen = nullptr;
  for (const Entry& each : entries) {
    if (options.entry.empty() || lower(each.name) == lower(options.entry)) {
      chosen = &each;
      break;
    }
  }
  if (entries.empty()) {
    source.fault(0, "found no entry; expected a name and braces with Angle, Axiom and rules between");
  } else if (!chosen) {
    return Error{Code::invalid,
                 {{"/entry", "there is no entry \"" + shortened(options.entry, 40) + "\"; the file has " +
                                 list_of(entries)}}};
  } else if (options.entry.empty() && entries.size() > 1) {
    return Error{Code::invalid,
                 {{"/entry", "the file holds several systems; choose one of " + list_of(entries)}}};
  }
  Imported imported;
  if (chosen) imported = EntryReader(source, *chosen).read();
  return source.finish(std::move(imported));
}

}  // namespace seedmesh
