/// Follows the interpreter of cpfg (Virtual Laboratory, "CPFG Version 4.0 User's Manual", tables of symbols).
#include "core/import/cpfg_words.h"

#include <algorithm>

#include "core/lang/lexer.h"

namespace seedmesh {

using lsystem::Slice;

/// A module as the turtle of cpfg reads it: `@Gs`, `~l` and `?P` are one.
struct CpfgWords::Module {
  std::string symbol;
  std::size_t at = 0;      ///< of the symbol in the text
  std::size_t behind = 0;  ///< behind the symbol; blanks may follow before its `(`
  std::size_t open = 0;    ///< of its `(`; equal to `end` without parameters
  std::size_t end = 0;     ///< behind it
  std::size_t count = 0;   ///< of its parameters
  bool is_closed = true;
};

namespace {

/// Symbols behind `@` that take one more character if they have no parameters.
constexpr std::string_view with_second = "PTGmDb";

struct LeftOut {
  std::string_view symbol, why;
};
constexpr std::string_view tropism =
    "bends by a tropism of cpfg's view file and is left out; give a `tropism`";
constexpr std::string_view twist = "keeps or removes the twist of a branch and is left out";
constexpr std::string_view circle =
    "draws a contour of Bezier curves and is left out; a surface may stand for it";
constexpr std::string_view patch = "draws a patch of control points and is left out";
constexpr std::string_view curve = "shapes a generalized cylinder and is left out; its curve is smooth here";
constexpr std::string_view back = "colours the back and is left out: front and back have one colour";
constexpr std::string_view ray = "is for rayshade's files and is left out";
constexpr LeftOut left_out[] = {
    {"@Ti", tropism},
    {"@Td", tropism},
    {"@Ts", tropism},
    {"@Tp", twist},
    {"@Tf", twist},
    {"@Tx", "chooses a texture of cpfg's view file and is left out; `materials` can have one"},
    {"@bo", circle},
    {"@bc", circle},
    {"@PS", patch},
    {"@PC", patch},
    {"@PD", patch},
    {"@Gt", curve},
    {"@Gr", curve},
    {"@#", "chooses a cross-section of cpfg's view file and is left out; give `contours`"},
    {"@!", "sets the sides of the following limbs and is left out; `sides` applies to all"},
    {"@,", back},
    {"@;", back},
    {"@L", "prints a label and is left out"},
    {"@S", "runs a command of the shell and is left out"},
    {"@I", ray},
    {"@J", ray},
    {"@mo", ray},
    {"@mc", "cuts on a condition when it is drawn and is left out"},
};
constexpr std::string_view kept[] = {"@v", "@Gs", "@Gc", "@Ge", "@M", "@R", "@D", "@Di", "@Dd"};

/// Circles and spheres of a given diameter.
struct Round {
  std::string_view symbol, surface;
};
constexpr Round round_symbols[] = {{"@o", "_o"}, {"@c", "_c"}, {"@O", "_O"}};

const Round* round_of(std::string_view symbol) {
  const auto* const found = std::find_if(std::begin(round_symbols), std::end(round_symbols),
                                         [&](const Round& each) { return each.symbol == symbol; });
  return found == std::end(round_symbols) ? nullptr : found;
}

std::size_t next_at(const TracedText& text, std::size_t at, std::size_t to) {
  return lsystem::skip_spaces(text.text(), at, to);
}

/// Bytes of the code point that begins with `lead`.
std::size_t length_of(char lead) {
  const auto byte = static_cast<unsigned char>(lead);
  return byte < 0xC0U ? 1 : byte < 0xE0U ? 2 : byte < 0xF0U ? 3 : 4;
}

/// Whether the argument is a literal number other than 0.
bool is_a_number_but_0(std::string_view argument) {
  std::size_t at = 0;
  double value = 0;
  return take_number(argument, at, argument.size(), value) && at == argument.size() && value != 0;
}

}  // namespace

std::string CpfgWords::surface_name(char symbol) {
  return is_letter(symbol) ? std::string(1, symbol) : std::string("_") + symbol;
}

std::string CpfgWords::listed(std::string_view characters) const {
  std::string list;
  for (const char c : characters) {
    if (!is_blank(c) && std::string_view("@~?").find(c) == std::string_view::npos) list += c;
  }
  for (const std::string& symbol : longer_) {
    if (characters.find(symbol[0]) != std::string_view::npos) list += symbol;
  }
  return list;
}

void CpfgWords::warn_once(std::size_t at, const std::string& symbol, const std::string& text) {
  if (warned_.insert(symbol).second) source_.warn(at, lang::in_quotes(symbol) + " " + text);
}

CpfgWords::Module CpfgWords::read(const TracedText& text, std::size_t at, std::size_t to) const {
  Module module;
  module.at = at;
  std::size_t end = std::min(at + length_of(text[at]), to);
  module.symbol = text.text().substr(at, end - at);
  const auto has_parameters = [&] { return end < to && text[end] == '('; };
  const auto take_next = [&] {
    const std::size_t from = next_at(text, end, to);
    if (from == to || text[from] == '(' || has_parameters()) return;
    end = std::min(from + length_of(text[from]), to);
    module.symbol += text.text().substr(from, end - from);
  };
  const char first = text[at];
  if (first == '@' || first == '~' || first == '?') take_next();
  if (first == '@' && module.symbol.size() == 2 &&
      with_second.find(module.symbol[1]) != std::string_view::npos)
    take_next();
  module.behind = module.open = module.end = end;
  const std::size_t next = next_at(text, end, to);
  if (next < to && text[next] == '(') module.open = end = next;
  if (!has_parameters()) return module;
  const std::size_t close = lsystem::closing(text.text(), end, to);
  module.is_closed = close < to;
  module.end = std::min(close + 1, to);
  int depth = 0;
  module.count = 1;
  for (std::size_t i = end; i < module.end; ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (text[i] == ',' && depth == 1) ++module.count;
  }
  return module;
}

std::size_t CpfgWords::count(const TracedText& text) {
  lsystem::Symbols symbols;
  for (const Round& each : round_symbols) symbols.declare("~" + std::string(each.surface));
  std::vector<lang::TextError> errors;
  // A surface's name is one character, or `_` and one.
  std::size_t modules = 0;
  const std::vector<lsystem::WrittenModule> all =
      lsystem::read_modules(text.text(), {0, text.size()}, symbols, errors);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].symbol == "~" && i + 1 < all.size()) i += all[i + 1].symbol == "_" ? 2 : 1;
    ++modules;
  }
  return modules;
}

TracedText CpfgWords::modules(const TracedText& text, Slice slice, Role role) {
  TracedText out;
  in_curve_ = false;
  for (std::size_t at = next_at(text, slice.from, slice.to); at < slice.to;) {
    const Module module = read(text, at, slice.to);
    if (!module.is_closed) {
      source_.report(text.origin(module.open), "found `(` without its `)`");
      break;
    }
    write(module, text, role, out);
    const std::size_t next = next_at(text, module.end, slice.to);
    if (next > module.end && next < slice.to && out.size() > 0) out.copy(text, module.end, module.end + 1);
    at = next;
  }
  return out;
}

void CpfgWords::copy_arguments(const Module& module, const TracedText& text, Role role, TracedText& out) {
  if (role == Role::pattern) {
    out.copy(text, module.open, module.end);
    return;
  }
  const TracedText arguments = expression(text, {module.open, module.end});
  out.copy(arguments, 0, arguments.size());
}

void CpfgWords::copy(const Module& module, const TracedText& text, Role role, TracedText& out) {
  if (module.symbol.size() == module.behind - module.at) {
    out.copy(text, module.at, module.behind);
  } else {
    out.write(module.symbol, text.origin(module.at));  // there were blanks inside
  }
  copy_arguments(module, text, role, out);
  const bool is_command = std::string_view("@~?").find(module.symbol[0]) != std::string_view::npos;
  if (!is_command || module.symbol.size() < 2) return;
  longer_.insert(module.symbol);
  for (const char c : module.symbol.substr(1)) inside_.emplace(c, module.symbol);
}

/// Writes three parameters; cpfg allows to omit the last ones.
void CpfgWords::pad(const Module& module, const TracedText& text, Role role, TracedText& out) {
  if (module.count == 0 || module.count >= 3) return copy(module, text, role, out);
  Module open = module;
  --open.end;
  copy(open, text, role, out);
  for (std::size_t i = module.count; i < 3; ++i) {
    out.write(role == Role::word ? ",0" : ",unnamed_" + std::to_string(++unnamed_),
              text.origin(module.end - 1));
  }
  out.copy(text, module.end - 1, module.end);
}

void CpfgWords::leave_out(const Module& module, Role role, const std::string& why) {
  if (role == Role::pattern) {
    source_.report(module.at,
                   "found " + lang::in_quotes(module.symbol) + " in a predecessor or context; it " + why);
  } else {
    warn_once(module.at, module.symbol, why);
  }
}

void CpfgWords::write(const Module& module, const TracedText& text, Role role, TracedText& out) {
  const char first = module.symbol[0];
  Module placed = module;
  placed.at = text.origin(module.at);
  if (first == '$' || (module.symbol == "?" && module.count > 0)) {
    source_.report(placed.at, "found a sub-L-system, which has no counterpart");
  } else if (first == '@') {
    write_command(module, text, role, out);
  } else if (first == '~') {
    write_surface(module, text, out);
  } else if (first == '?') {
    write_query(module, text, role, out);
  } else if (first == '\'' || first == '"') {
    leave_out(placed, role, "has no meaning in cpfg and is left out");
  } else if (std::string_view("{}.").find(first) != std::string_view::npos && role == Role::word) {
    write_curve(module, text, out);
  } else {
    if (first == '_' && role == Role::word)
      warn_once(placed.at, "_",
                "sets an elasticity for cpfg's old tropism and has no effect here; give a `tropism`");
    if (first == '%' && module.count > 0)
      warn_once(placed.at, "%", "with parameters moves the cut part in cpfg; here it cuts");
    copy(module, text, role, out);
  }
}

void CpfgWords::write_command(const Module& module, const TracedText& text, Role role, TracedText& out) {
  const std::size_t at = text.origin(module.at);
  Module placed = module;
  placed.at = at;
  if (const Round* const round = round_of(module.symbol))
    return write_round(module, round->surface, text, out);
  for (const LeftOut& row : left_out) {
    if (row.symbol == module.symbol) return leave_out(placed, role, std::string(row.why));
  }
  if (std::find(std::begin(kept), std::end(kept), module.symbol) == std::end(kept)) {
    if (module.symbol == "@") {
      source_.report(at, "found `@` alone; expected a symbol after it, as in `@v`");
      return;
    }
    warn_once(at, module.symbol, "is not a command of cpfg, which ignores the `@`");
    const std::size_t next = next_at(text, module.at + 1, module.end);
    const bool was_in_curve = in_curve_;
    const TracedText rest = modules(text, {next, module.end}, role);
    in_curve_ = was_in_curve;
    return out.copy(rest, 0, rest.size());
  }
  if (module.symbol[1] == 'D' && module.count == 0)
    return leave_out(placed, role, "scales by a factor of cpfg's view file and is left out");
  if (module.symbol == "@R" && module.count > 3) {
    warn_once(at, "@R", "with an up vector rolls to it in cpfg; here it rolls upright");
    std::size_t end = module.open;
    for (int commas = 0, depth = 0; end < module.end; ++end) {
      if (text[end] == '(') ++depth;
      if (text[end] == ')') --depth;
      if (text[end] == ',' && depth == 1 && ++commas == 3) break;
    }
    Module three = module;
    three.end = end;
    three.count = 3;
    copy(three, text, role, out);
    return out.write(")", text.origin(end));
  }
  if (module.symbol == "@Ge" && module.count > 0 && role == Role::word) {
    warn_once(at, "@Ge", "has no number of strips here: the last part is drawn in 8");
    Module bare = module;
    bare.end = bare.open;
    return copy(bare, text, role, out);
  }
  if (module.symbol == "@R" || module.symbol == "@M") return pad(module, text, role, out);
  copy(module, text, role, out);
}

/// A circle or sphere becomes a surface. Without a diameter it is as wide as the line at the start.
void CpfgWords::write_round(const Module& module, std::string_view surface, const TracedText& text,
                            TracedText& out) {
  const std::size_t at = text.origin(module.at);
  rounds_.emplace(surface, at);
  longer_.insert("~" + std::string(surface));
  if (module.symbol == "@o")
    warn_once(at, "@o",
              "faces the viewer in cpfg; here it lies in the plane of heading and left, as `@c` does");
  if (module.count == 0)
    warn_once(at, module.symbol, "without a diameter is as wide as a line in cpfg; here it is 0.1");
  out.write("~" + std::string(surface), at);
  if (module.count == 0) {
    out.write("(0.1)", at);
  } else {
    copy_arguments(module, text, Role::word, out);
  }
}

void CpfgWords::write_surface(const Module& module, const TracedText& text, TracedText& out) {
  const std::size_t at = text.origin(module.at);
  const char symbol = module.symbol.size() == 2 ? module.symbol[1] : ' ';
  if (!is_letter(symbol) && !is_digit(symbol)) {
    source_.report(at, "found `~` without the letter of a surface behind it");
    return;
  }
  add_surface(symbol, at);
  longer_.insert("~" + surface_name(symbol));
  out.write("~" + surface_name(symbol), at);
  out.copy(text, module.open, module.end);
}

void CpfgWords::write_query(const Module& module, const TracedText& text, Role role, TracedText& out) {
  const std::size_t at = text.origin(module.at);
  const std::string_view what = std::string_view(module.symbol).substr(1);
  if (what == "E") {
    if (role == Role::word)
      warn_once(at, "?E", "queries a separate program in cpfg; here it queries `environment`");
    return copy(module, text, role, out);
  }
  if (what == "P" || what == "H" || what == "L" || what == "U") return pad(module, text, role, out);
  if (role == Role::word) warn_once(at, module.symbol, "is a query without a result here");
  copy(module, text, role, out);
}

/// `{` with a number is the older form of a generalized cylinder, whose control points are `.`.
void CpfgWords::write_curve(const Module& module, const TracedText& text, TracedText& out) {
  const std::size_t at = text.origin(module.at);
  const char symbol = module.symbol[0];
  const std::string argument =
      module.count == 0 ? "" : text.text().substr(module.open + 1, module.end - module.open - 2);
  if (symbol == '.') {
    if (!in_curve_ && module.count == 0) return copy(module, text, Role::word, out);
    if (!in_curve_)
      warn_once(at, ".(n)",
                "is a control point of a generalized cylinder, `@Gc`, here and no vertex of a polygon");
    longer_.insert("@Gc");
    out.write("@Gc", at);
    return copy_arguments(module, text, Role::word, out);
  }
  const bool is_curve = is_a_number_but_0(argument) || (symbol == '}' && in_curve_);
  if (is_curve) {
    if (symbol == '{')
      warn_once(at, "{(" + argument + ")",
                "is a generalized cylinder by `@Gs`, `@Gc` and `@Ge` here, whose ends and joints may differ");
    in_curve_ = symbol == '{';
    longer_.insert(symbol == '{' ? "@Gs" : "@Ge");
    return out.write(symbol == '{' ? "@Gs" : "@Ge", at);
  }
  if (module.count > 0 && argument.find_first_not_of("0. ") != std::string::npos)
    warn_once(at, std::string(1, symbol) + "(...)",
              "may be a generalized cylinder in cpfg; here it is a polygon");
  Module bare = module;
  bare.end = bare.open;
  copy(bare, text, Role::word, out);
}

}  // namespace seedmesh
