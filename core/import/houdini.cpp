/// Reads L-systems of Houdini's L-System node: its parameters and rules, one in each line, after "L-System" in SideFX's
/// documentation of the node:
///
///   Premise: A(1)                     Generations: 7    Angle: 28    Step Size: 0.1    Thickness: 0.05
///   Rule 1: A(s) : s > b = F(s)[+A(s*b)]-A(s*b) : 0.5           b: 0.7    (a rule may also stand alone)
///
/// Symbols that turn the other way in Houdini are exchanged: there + turns right and & turns up. Symbols that scale by a
/// parameter of the node get its value as an argument.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/generators/lsystem/notation.h"
#include "core/import/foreign_text.h"
#include "core/import/formats.h"
#include "core/import/houdini_names.h"
#include "core/import/houdini_rules.h"
#include "core/import/houdini_settings.h"
#include "core/import/traced_text.h"
#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

class HoudiniReader {
 public:
  explicit HoudiniReader(ForeignText& source) : source_(source), text_(source.text()) {
    for (const HoudiniSetting& each : houdini_settings()) values_[std::string(each.name)] = each;
  }

  Imported read() {
    std::vector<Line> rules;
    for (const Line& each : lines_of(text_)) {
      const Line line = trimmed(text_, each);
      const std::string_view two = text_.substr(line.from, std::min<std::size_t>(2, line.to - line.from));
      if (line.from == line.to || two == "//" || two == "# ") continue;
      read_line(line, rules);
    }
    find_group(rules);
    positions_ = HoudiniPositions(text_, rules);
    if (!premise_) {
      source_.report(0, "found no premise");
    } else {
      TracedText axiom;
      modules(*premise_, Role::word, axiom);
      put("/axiom", axiom.text(), axiom.runs());
    }
    if (is_bare_ && rules.empty())
      source_.report(premise_->from, "found no rule; expected one such as `A=FA`");
    parameters_["productions"] = Json::array();
    for (const Line& each : rules) rule(each);
    positions_.put(parameters_);
    names_.put(values_["gravity"].value, parameters_, source_);
    return made();
  }

 private:
  enum class Role { word, pattern };

  /// Behind the name of a parameter or of a rule at the beginning of a line, and the sign that follows it: a colon, or
  /// for names of several letters also `=` or a blank. `key` becomes the name; line.to: the line has none.
  std::size_t behind_name(Line line, std::string& key) const {
    const auto knows = [&](std::size_t end, bool is_colon) {
      key = houdini_name(text_.substr(line.from, end - line.from));
      const bool is_rule = key.starts_with("rule") && std::all_of(key.begin() + 4, key.end(), is_digit);
      return (is_colon || key.size() > 1) && (is_rule || key == "premise" || key == "axiom" ||
                                              key == "contextignore" || values_.contains(key));
    };
    const std::string_view words = text_.substr(0, line.to);
    const std::size_t colon = std::min(words.find(':', line.from), line.to);
    if (colon < line.to && knows(colon, true)) return colon + 1;
    const std::size_t equals = std::min(words.find('=', line.from), line.to);
    if (equals < line.to && knows(equals, false)) return equals + 1;
    for (int skipped = 0; skipped < 3; ++skipped) {  // a name has at most three words, the longest first
      std::size_t end = line.from;
      for (int word = 0; word < 3 - skipped && end < line.to; ++word) {
        while (end < line.to && is_blank(text_[end])) ++end;
        while (end < line.to && !is_blank(text_[end])) ++end;
      }
      if (end < line.to && knows(end, false)) return end;
    }
    key.clear();
    return line.to;
  }

  void read_line(Line line, std::vector<Line>& rules) {
    std::string key;
    const std::size_t behind = behind_name(line, key);
    const Line rest = trimmed(text_, {behind, line.to});
    const std::size_t colon = std::min(text_.substr(0, line.to).find(':', line.from), line.to);
    if (key == "premise" || key == "axiom") {
      if (premise_) source_.report(line.from, "found a second premise");
      premise_ = rest;
    } else if (key == "contextignore") {
      TracedText ignored;
      modules(rest, Role::pattern, ignored);
      put("/ignore", ignored.text(), ignored.runs());
    } else if (key.starts_with("rule")) {
      rules.push_back(rest);
    } else if (!key.empty()) {
      number(rest, values_.find(key)->second);
    } else if (houdini_equals(text_, line) < line.to) {
      rules.push_back(line);
    } else if (colon < line.to && is_label(line.from, colon)) {
      source_.warn(line.from, lang::in_quotes(text_.substr(line.from, colon - line.from)) +
                                  " is a parameter without a counterpart here");
    } else if (!premise_ && colon == line.to) {
      premise_ = line;
      is_bare_ = true;
    } else {
      source_.report(
          line.from,
          "found no parameter of the node and no rule; expected something such as `Angle: 28` or `A=FA`");
    }
  }

  /// Whether a text has the form of a parameter's label: words that begin with a letter.
  bool is_label(std::size_t from, std::size_t to) const {
    if (to - from < 2 || !is_letter(text_[from])) return false;
    for (std::size_t i = from; i < to; ++i) {
      if (!is_letter(text_[i]) && !is_digit(text_[i]) && !is_blank(text_[i]) && text_[i] != '/' &&
          text_[i] != '_')
        return false;
    }
    return true;
  }

  void put(const std::string& name, Json value, std::vector<TextRun> runs) {
    out_.origins.push_back({"/parameters" + name, std::move(runs)});
    parameters_[Json::json_pointer(name)] = std::move(value);
  }

  void number(Line line, HoudiniSetting& setting) {
    double& value = setting.value;
    setting.at = line.from;
    const bool negative = line.from < line.to && text_[line.from] == '-';
    std::size_t at = line.from + (negative ? 1 : 0);
    double found = 0;
    if (!take_number(text_, at, line.to, found) || at != line.to) {
      source_.report(line.from, "expected a number");
    } else {
      value = negative ? -found : found;
    }
  }

  void rule(Line line) {
    const HoudiniRule parts = houdini_rule(text_, line);
    if (parts.equals == line.to) {
      source_.report(line.from, "found a rule without `=`");
      return;
    }
    if (parts.equals + 1 < line.to && text_[parts.equals + 1] == '>') {
      source_.report(parts.equals, "found `=>`; expected `=` between the predecessor and the successor");
      return;
    }
    TracedText out;
    names_.begin_rule(text_.substr(parts.head.from, parts.head.to - parts.head.from),
                      positions_.reads(text_, parts));
    pattern(parts, out);
    const auto append = [&](std::string_view before, Line part) {
      out.write(before, part.from);
      names_.note(text_.substr(part.from, part.to - part.from), part.from);
      out.copy(text_, part.from, part.to);
    };
    if (parts.condition.from < parts.condition.to) append(" : ", parts.condition);
    out.write(" -> ", parts.equals);
    modules(parts.successor, Role::word, out);
    if (parts.weight.from < parts.weight.to) append(" : ", parts.weight);
    const std::string index = std::to_string(parameters_["productions"].size());
    out_.origins.push_back({"/parameters/productions/" + index, out.runs()});
    parameters_["productions"].push_back(out.text());
    names_.end_rule();
  }

  /// Whether a rule rewrites g, which names a group otherwise: then it is a mere variable.
  void find_group(const std::vector<Line>& rules) {
    for (const Line& each : rules) {
      const Line center = trimmed(text_, houdini_rule(text_, each).center);
      has_group_ = has_group_ || (center.from < center.to && text_[center.from] == 'g');
    }
    if (has_group_) parameters_["modules"] = {"var_g"};
  }

  void pattern(const HoudiniRule& rule, TracedText& out) {
    if (rule.has_left) {
      modules(rule.left, Role::pattern, out);
      out.write(" < ", rule.left.to);
    } else if (positions_.reads(text_, rule)) {
      out.write("?P(x,y,z) < ", rule.center.from);
    }
    modules(rule.center, Role::pattern, out);
    if (rule.has_right) {
      out.write(" > ", rule.center.to);
      modules(rule.right, Role::pattern, out);
    }
  }

  /// Writes the modules of text[line] in our symbols. Arguments keep their own source positions.
  void modules(Line line, Role role, TracedText& out) {
    std::size_t index = 0;
    for (std::size_t at = line.from; at < line.to;) {
      const std::size_t start = at;
      const char c = text_[at++];
      if (is_blank(c)) continue;
      const std::size_t number = index++;
      std::string arguments;
      std::size_t open = at;
      if (at < line.to && text_[at] == '(') {
        const std::size_t close = lsystem::closing(text_, at, line.to);
        if (close == line.to) {
          source_.report(at, "found `(` without its `)`");
          break;
        }
        arguments = text_.substr(at, close + 1 - at);
        if (role == Role::word) {
          arguments = names_.with_index(arguments, number);
          names_.note(arguments, at);
        }
        at = close + 1;
      }
      if (role == Role::word && positions_.has(c)) out.write("?P(0,0,0)", start);
      const std::string written = module(c, arguments, start, role);
      const std::size_t same = written.size() - std::min(written.size(), arguments.size());
      if (!arguments.empty() && written.substr(same) == arguments &&
          text_.substr(open, at - open) == arguments) {
        out.write(std::string_view(written).substr(0, same), start);
        out.copy(text_, open, at);
      } else {
        out.write(written, start);
      }
    }
  }

  std::string module(char c, const std::string& arguments, std::size_t at, Role role) {
    const std::string_view exchanged = "+-&^", with = "-+^&";
    const std::size_t turn = exchanged.find(c);
    if (turn != std::string_view::npos) return with[turn] + arguments;
    const bool own = std::string_view("\"!;_?@*~'#gTJKM").find(c) != std::string_view::npos;
    if (c == 'a' && arguments.find('"') != std::string::npos) {
      warn_once(at, c, " sets an attribute, which does not exist here");
      return "";
    }
    if (c == 'G') {  // moves without a vertex, and draws nothing
      arities_.note('g', arguments);
      return "g" + arguments;
    }
    if (c == 'g' && has_group_) return "var_g" + arguments;
    if (!own) {
      if (c == 'H' || c == 'h' || c == 'F' || c == 'f') arities_.note(c, arguments);
      if (c == '$' && !arguments.empty()) {
        warn_once(at, c, " rolls towards the sky here and not towards a point");
        return "$";
      }
      return c + arguments;
    }
    if (std::string_view("gJKM").find(c) != std::string_view::npos) {
      warn_once(at, c,
                c == 'g' ? " names a group, which does not exist here"
                         : " copies geometry of an input, which does not exist here");
      return c == 'g' ? "" : c + with_empty_arguments(arguments);
    }
    if (role == Role::pattern) {
      source_.report(at, lang::in_quotes(std::string_view(&c, 1)) +
                             " is replaced by other symbols here, so that no rule can match it");
      return "";
    }
    return written_out(c, arguments, at);
  }

  /// J(,,2): arguments that are not given are 0. The symbols that have them draw nothing here.
  static std::string with_empty_arguments(const std::string& arguments) {
    if (arguments == "()") return {};
    std::string out;
    for (const char c : arguments) {
      const bool is_empty =
          !out.empty() && (out.back() == '(' || out.back() == ',') && (c == ',' || c == ')');
      if (is_empty) out += '0';
      out += c;
    }
    return out;
  }

  /// Symbols that scale or turn by a parameter of the node if they have no argument.
  std::string written_out(char c, const std::string& arguments, std::size_t at) {
    const auto by = [&](const char* setting) {
      return arguments.empty() ? "(" + number_text(values_[setting].value) + ")" : arguments;
    };
    switch (c) {
      case '"':
        return "@Di" + by("stepsizescale");
      case '_':
        return "@Dd" + by("stepsizescale");
      case '!':
        return "@w" + by("thicknessscale");
      case '?':
        return "@w(1/" + by("thicknessscale") + ")";
      case ';':
        return "@a" + by("anglescale");
      case '@':
        return "@a(1/" + by("anglescale") + ")";
      case '*':
        return "\\(180)";
      case '~': {
        const std::string most = arguments.empty() ? "(180)" : arguments;
        const std::string angle = "(ran(-" + most + "," + most + "))";
        return "/" + angle + "&" + angle + "+" + angle;
      }
      default:
        warn_once(
            at, c,
            c == 'T' ? " is left out: give a `tropism`" : " moves textures, which is not supported here");
        return "";
    }
  }

  void warn_once(std::size_t at, char symbol, const char* text) {
    if (warned_.insert(symbol).second) source_.warn(at, lang::in_quotes(std::string_view(&symbol, 1)) + text);
  }

  /// A fraction of a generation becomes an age.
  void put_generations() {
    const HoudiniSetting& setting = values_["generations"];
    if (!(setting.value >= 0 && setting.value <= 1000)) {
      source_.report(setting.at, "expected generations from 0 to 1000");
      return;
    }
    const double whole = std::ceil(setting.value);
    put("/iterations", static_cast<int>(whole), {{0, setting.at, false}});
    if (whole != setting.value) put("/age", setting.value, {{0, setting.at, false}});
  }

  void put_seed() {
    const HoudiniSetting& setting = values_["randomseed"];
    if (!(setting.value >= 0 && setting.value <= 1e9) || setting.value != std::floor(setting.value)) {
      source_.report(setting.at, "expected a random seed that is a whole number up to 1e9");
      return;
    }
    out_.request["seed"] = static_cast<int>(setting.value);
  }

  Imported made() {
    Json rules = arities_.interpretation();
    if (!rules.empty()) parameters_["interpretation"] = std::move(rules);
    put_generations();
    put_seed();
    const auto put_number = [&](const char* name, const char* setting) {
      put(name, values_[setting].value, {{0, values_[setting].at, false}});
    };
    put_number("/angle", "angle");
    put_number("/step", "stepsize");
    put_number("/width", "thickness");
    put_number("/constants/a", "angle");
    for (const char* each : {"b", "c", "d"}) put_number((std::string("/constants/") + each).c_str(), each);
    out_.request["generator"] = "lsystem";
    out_.request["parameters"] = std::move(parameters_);
    return std::move(out_);
  }

  ForeignText& source_;
  std::string_view text_;
  std::map<std::string, HoudiniSetting> values_;
  std::optional<Line> premise_;
  bool is_bare_ = false;    ///< the premise has no name in the file
  bool has_group_ = false;  ///< g is a variable
  HoudiniNames names_;
  HoudiniPositions positions_;
  HoudiniArities arities_;
  std::set<char> warned_;
  Json parameters_ = Json::object();
  Imported out_;
};

}  // namespace

Result<Imported> import_houdini(std::string_view text, const ImportOptions& options) {
  if (std::optional<Error> error = entry_error(options, "a node contains one L-system"))
    return *std::move(error);
  ForeignText source(text);
  Imported imported = HoudiniReader(source).read();
  return source.finish(std::move(imported));
}

}  // namespace seedmesh
