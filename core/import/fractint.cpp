/// Entries of Fractint's L-system files, as its manual has them ("L-Systems" and "L-System Commands",
/// Fractint 20.0):
///
///   Name { ; comment
///     Angle 6            the turn of + and - is 360 / 6 degrees
///     Axiom F--F--F
///     F=F+F--F+F         several rules of one symbol are joined
///   }
///
/// Letters are the same in both cases; entries without a name or called comment are comments. The turtle
/// starts to the right, in the plane of the image. It has two headings: + - | turn that of F and G, \\ and
/// / that of D and M. The turtle here has one. If an entry draws with both, it is that of F and G, and a variable is the
/// angle from it to the other heading; rules of the interpretation keep it up to date.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "core/import/foreign_text.h"
#include "core/import/formats.h"
#include "core/import/fractint_entries.h"
#include "core/import/traced_text.h"
#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

constexpr int usual_order = 4;       // the file does not contain the number of steps
constexpr double most_colors = 256;  // a palette of VGA
constexpr std::size_t longest_rule = 1'000'000;
constexpr std::size_t deepest_branch = 1'000;  // of entries with two headings

/// One entry, command by command.
class EntryReader {
 public:
  EntryReader(ForeignText& source, const FractintEntry& entry) : source_(source), entry_(entry) {}

  Imported read() {
    find_angle();
    find_headings();
    for (const Line& line : entry_.lines) read_line(line);
    if (!has_axiom_) source_.report(entry_.name_at, "found no axiom in this entry");
    if (divisions_ == 0) source_.report(entry_.name_at, "found no angle in this entry");
    return made();
  }

 private:
  /// The first word of a line, which ends at a blank or `=`; `rest` is the text after it and its `=`.
  std::string word(Line line, Line& rest) const {
    const std::string_view text = source_.text();
    std::size_t end = line.from;
    while (end < line.to && !is_blank(text[end]) && text[end] != '=') ++end;
    if (end == line.from) ++end;  // a rule for =
    rest = trimmed(text, {end, line.to});
    if (rest.from < rest.to && text[rest.from] == '=') rest = trimmed(text, {rest.from + 1, rest.to});
    return lower(text.substr(line.from, end - line.from));
  }

  /// Reads the angle first, because the meaning of | in earlier rules depends on it.
  void find_angle() {
    for (const Line& line : entry_.lines) {
      Line rest;
      if (word(line, rest) != "angle") continue;
      std::size_t at = rest.from;
      double value = 0;
      const bool number = take_number(source_.text(), at, rest.to, value) && at == rest.to;
      if (!number || value != std::floor(value) || value < 3 || value > 50) {
        source_.report(rest.from,
                       "found no angle; expected a whole number from 3 to 50, the parts of a turn");
        divisions_ = 6;
      } else {
        divisions_ = static_cast<int>(value);
      }
    }
  }

  /// Whether the entry draws with steps (F, G), with degrees (D, M) or with both.
  void find_headings() {
    for (const Line& line : entry_.lines) {
      Line rest;
      const std::string first = word(line, rest);
      if (first == "angle" || (first != "axiom" && first.size() > 1)) continue;
      for (std::size_t at = rest.from; at < rest.to; ++at) {
        const char c = upper(source_.text()[at]);
        by_steps_ = by_steps_ || c == 'F' || c == 'G';
        by_degrees_ = by_degrees_ || c == 'D' || c == 'M';
        has_mirror_ = has_mirror_ || c == '!';
      }
    }
  }

  void read_line(Line line) {
    const std::string_view text = source_.text();
    Line rest;
    const std::string name = word(line, rest);
    if (name == "angle") return;
    if (name == "axiom") {
      if (std::exchange(has_axiom_, true)) source_.report(line.from, "found a second axiom");
      axiom_.write("-(90)", rest.from);  // the turtle of Fractint starts to the right
      commands(rest, axiom_);
      return;
    }
    const Line after = trimmed(text, {line.from + name.size(), line.to});
    if (name.size() > 1 || after.from >= line.to || text[after.from] != '=') {
      source_.report(line.from, "found no command; expected Angle, Axiom or a rule such as F=F+F");
      return;
    }
    rule(upper(text[line.from]), line.from, rest);
  }

  void rule(char symbol, std::size_t at, Line successor) {
    const std::string predecessor = predecessor_of(symbol);
    if (predecessor.empty()) {
      source_.report(at, std::string("found a rule for `") + symbol +
                             "`; expected one for a letter, a digit or a command without brackets");
      return;
    }
    if (predecessor.back() == ')' && successor.from < successor.to) {
      source_.report(at, std::string("found a rule that gives `") + symbol +
                             "` with its number a successor; only one that removes it is supported");
      return;
    }
    auto known = std::find_if(rules_.begin(), rules_.end(),
                              [&](const Rule& each) { return each.predecessor == predecessor; });
    if (known == rules_.end()) {
      rules_.push_back({predecessor, {}});
      known = rules_.end() - 1;
      known->text.write(predecessor + " -> ", at);
    }
    commands(successor, known->text);
  }

  bool has_two_headings() const { return by_steps_ && by_degrees_; }

  /// The module for a symbol, with a parameter if the command has a number; empty if there is none.
  std::string predecessor_of(char symbol) const {
    switch (symbol) {
      case 'C':
        return ";(n)";
      case '<':
        return ";";
      case '>':
        return ",";
      case '@':
        return "@Di(n)";
      case '\\':
        return has_two_headings() ? "left_m(n)" : "+(n)";
      case '/':
        return has_two_headings() ? "right_m(n)" : "-(n)";
      case '!':
        return "@-";
      case '|':
        return divisions_ % 2 == 0 ? "|" : "";
      default:
        return is_letter(symbol) || is_digit(symbol) || symbol == '+' || symbol == '-'
                   ? std::string(1, symbol)
                   : "";
    }
  }

  static char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

  static std::string text_of(double number) { return number_text(number); }

  /// Converts the commands in text[line] to our symbols.
  void commands(Line line, TracedText& out) {
    const std::string_view text = source_.text();
    for (std::size_t at = line.from; at < line.to;) {
      const std::size_t start = at;
      const char c = upper(text[at++]);
      if (is_blank(c)) continue;
      if (c == '+' || c == '-' || c == '|') {
        if (turns(by_steps_, by_degrees_, c, start))
          out.write(c == '|' ? half_turn(start) : std::string(1, c), start);
      } else if (c == '\\' || c == '/') {
        const std::string degrees = text_of(number(start, at, line.to));
        const bool left = c == '\\';
        if (has_two_headings()) {
          out.write((left ? "left_m(" : "right_m(") + degrees + ")", start);
        } else if (turns(by_degrees_, by_steps_, c, start)) {
          out.write((left ? "+(" : "-(") + degrees + ")", start);
        }
      } else if (c == 'C' || c == '<' || c == '>') {
        out.write(color(c, start, at, line.to), start);
      } else if (is_letter(c)) {
        used_[static_cast<unsigned char>(c)] = true;
        out.write(std::string(1, c), start);
      } else if (is_digit(c) || c == '[' || c == ']') {
        if (c == ']' || !has_two_headings()) {
          out.copy(text, start, at);
        } else {
          out.write("save_m[", start);
        }
        if (c == ']' && has_two_headings()) out.write("load_m", start);
      } else if (c == '!') {
        out.write("@-", start);
      } else if (c == '@') {
        out.write("@Di(" + text_of(factor(start, at, line.to)) + ")", start);
      } else {
        while (at < line.to && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
        warn_once(start, text.substr(start, at - start), "is not a command of Fractint, which ignores it");
      }
      if (out.size() > longest_rule) {
        source_.report(start, "found a rule that is too long");
        break;
      }
    }
  }

  /// Whether a turn has an effect. Turns of a heading that nothing uses are left out.
  bool turns(bool by_this, bool by_other, char symbol, std::size_t at) {
    if (by_this || !by_other) return true;
    warn_once(at, std::string_view(&symbol, 1),
              symbol == '\\' || symbol == '/' ? "turns only D and M, which do not occur, and is left out"
                                              : "turns only F and G, which do not occur, and is left out");
    return false;
  }

  void warn_once(std::size_t at, std::string_view symbol, const char* text) {
    if (warned_.insert(std::string(symbol)).second) source_.warn(at, lang::in_quotes(symbol) + " " + text);
  }

  /// The turn nearest to 180 degrees that the divisions allow, to the right. `!` does not change it.
  std::string half_turn(std::size_t at) {
    if (divisions_ % 2 == 0) return "|";
    if (has_two_headings()) return "back_m";
    if (has_mirror_) warn_once(at, "|", "turns to the other side after `!`, unlike in Fractint");
    return "-(" + text_of(odd_half_turn()) + ")";
  }

  double odd_half_turn() const {
    const int half = divisions_ / 2;
    return 360.0 / std::max(divisions_, 1) * half;
  }

  double number(std::size_t start, std::size_t& at, std::size_t to) {
    double value = 0;
    if (!take_number(source_.text(), at, to, value)) {
      source_.report(start, std::string("found `") + source_.text()[start] + "` without its number");
    }
    return value;
  }

  /// @ with I (the inverse) and Q (the square root) before its number, in either order.
  double factor(std::size_t start, std::size_t& at, std::size_t to) {
    bool inverse = false, root = false;
    for (; at < to; ++at) {
      bool& flag = upper(source_.text()[at]) == 'I' ? inverse : root;
      if (flag || (&flag == &root && upper(source_.text()[at]) != 'Q')) break;
      flag = true;
    }
    const std::size_t before = at;
    double value = number(start, at, to);
    if (at == before) return 1;
    if (root) value = std::sqrt(value);
    if (inverse) value = 1 / value;
    if (!(value > 0) || !std::isfinite(value)) {
      source_.report(start, "found a factor of the step that is not above 0");
      return 1;
    }
    return value;
  }

  /// C sets the colour, < adds to it and > takes from it; 0 where no number follows.
  std::string color(char command, std::size_t start, std::size_t& at, std::size_t to) {
    double value = 0;
    take_number(source_.text(), at, to, value);
    if (value != std::floor(value) || value >= most_colors) {
      source_.report(start, "found a colour that is not a whole number below 256");
      return "";
    }
    warn_once(start, "C",
              "and `<` `>`: Fractint's palette is not available; numbers select from `materials`");
    if (command == 'C') return ";(" + text_of(value) + ")";
    return std::string(static_cast<std::size_t>(value), command == '<' ? ';' : ',');
  }

  Imported made() {
    Imported out;
    Json parameters;
    if (has_axiom_) parameters["axiom"] = axiom_.text();
    parameters["angle"] = 360.0 / std::max(divisions_, 1);
    parameters["iterations"] = usual_order;
    parameters["style"] = "lines";
    Json productions = Json::array();
    for (const Rule& rule : rules_) {
      out.origins.push_back(
          {"/parameters/productions/" + std::to_string(productions.size()), rule.text.runs()});
      productions.push_back(rule.text.text());
    }
    parameters["productions"] = std::move(productions);
    Json interpretation = Json::array();
    for (const auto& [letter, meaning] :
         std::array<std::pair<char, const char*>, 3>{{{'D', "D -> F"}, {'G', "G -> f"}, {'M', "M -> f"}}}) {
      if (used_[static_cast<unsigned char>(letter)]) interpretation.push_back(meaning);
    }
    if (has_two_headings()) put_two_headings(parameters, interpretation);
    parameters["interpretation"] = std::move(interpretation);
    out.origins.push_back({"/parameters/axiom", axiom_.runs()});
    out.request = {{"generator", "lsystem"}, {"parameters", std::move(parameters)}};
    source_.warn(entry_.name_at,
                 "an entry has no number of steps; `iterations` is " + std::to_string(usual_order),
                 "/parameters/iterations");
    return out;
  }

  /// `apart` is the angle from the heading of F and G to that of D and M, `side` is -1 after an odd number of `!`.
  void put_two_headings(Json& parameters, Json& rules) const {
    const std::string turn = text_of(360.0 / std::max(divisions_, 1));
    rules = {"+ : {apart = apart - " + turn + " * side;} 1 -> +",
             "- : {apart = apart + " + turn + " * side;} 1 -> -",
             "| : {apart = apart + 180;} 1 -> |",
             "back_m : {apart = apart + " + text_of(odd_half_turn()) + ";} 1 -> -(" +
                 text_of(odd_half_turn()) + " * side)",
             "left_m(n) : {apart = apart + n * side;} 1 -> *",
             "right_m(n) : {apart = apart - n * side;} 1 -> *",
             "@- : {side = -side;} 1 -> @-",
             "save_m : {saved[level] = apart; saved[level + 1] = side; level = level + 2;} 1 -> *",
             "load_m : {level = level - 2; apart = saved[level]; side = saved[level + 1];} 1 -> *",
             "D -> +(apart * side)F-(apart * side)",
             "M -> +(apart * side)f-(apart * side)",
             "G -> f"};
    parameters["modules"] = {"left_m(n)", "right_m(n)", "back_m", "save_m", "load_m"};
    parameters["variables"] = {{"apart", 0}, {"side", 1}, {"level", 0}};
    parameters["arrays"] = {{"saved", Json(std::vector<double>(2 * deepest_branch, 0.0))}};
  }

  struct Rule {
    std::string predecessor;
    TracedText text;
  };

  ForeignText& source_;
  const FractintEntry& entry_;
  int divisions_ = 0;
  bool has_axiom_ = false, has_mirror_ = false, by_steps_ = false, by_degrees_ = false;
  TracedText axiom_;
  std::vector<Rule> rules_;
  std::array<bool, 256> used_{};
  std::set<std::string> warned_;
};

std::string list_of(const std::vector<FractintEntry>& entries) {
  std::string names;
  for (std::size_t i = 0; i < entries.size() && i < 50; ++i) names += (i == 0 ? "" : ", ") + entries[i].name;
  return names + (entries.size() > 50 ? ", ..." : "");
}

}  // namespace

Result<Imported> import_fractint(std::string_view text, const ImportOptions& options) {
  ForeignText source(text);
  std::vector<FractintEntry> entries = fractint_entries(source);
  const auto is_comment = [](const FractintEntry& each) {
    return each.name.empty() || lower(each.name) == "comment";
  };
  entries.erase(std::remove_if(entries.begin(), entries.end(), is_comment), entries.end());
  const FractintEntry* chosen = nullptr;
  for (const FractintEntry& each : entries) {
    if (options.entry.empty() || lower(each.name) == lower(options.entry)) {
      chosen = &each;
      break;
    }
  }
  if (entries.empty()) {
    source.report(0, "found no entry; expected a name and braces with Angle, Axiom and rules between");
  } else if (!chosen) {
    return Error{
        Code::invalid,
        {{IssueKind::unknown_name, "/entry",
          "there is no entry \"" + shortened(options.entry, 40) + "\"; the file has " + list_of(entries)}}};
  } else if (options.entry.empty() && entries.size() > 1) {
    return Error{Code::invalid,
                 {{missing_for({"entry"}), "/entry",
                   "the file contains several systems; expected one of " + list_of(entries)}}};
  }
  Imported imported;
  if (chosen) imported = EntryReader(source, *chosen).read();
  return source.finish(std::move(imported));
}

}  // namespace seedmesh
