/// x-applies-when: the condition under which a parameter has an effect, as C++ and as words.
#include <algorithm>
#include <map>

#include "api_schema/codegen/emit.h"

namespace codegen {
namespace {

/// The target of a path in a condition.
struct Target {
  const Member* member = nullptr;
  std::string value;  ///< in C++: "root.leaf.build"
  std::string name;   ///< in messages: "`leaf.build`"
};

/// Whether a value is the text without characters. `empty()` of a JSON text is false.
bool is_empty_text(const Schema& value) {
  return value.is_string() && value.get_ref<const std::string&>().empty();
}

/// Translates the conditions of the members of one structure.
class Translator {
 public:
  /// `prefix` is put before the names of siblings: "leaf.".
  Translator(const Unit& unit, const Type& owner, std::string prefix)
      : unit_(unit), owner_(owner), prefix_(std::move(prefix)) {}

  void translate(Member& member) {
    member.shown_name = prefix_ + member.name;
    where_ = unit_.name + ".schema.json: x-applies-when of " + prefix_ + member.name;
    if (member.required) refuse("a required parameter always has an effect");
    member.applies_when = clauses(member.type.schema["x-applies-when"]);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw SchemaError(where_ + ": " + what); }

  std::vector<Clause> clauses(const Schema& condition) const {
    if (!condition.is_object() || condition.empty()) refuse("a condition is an object with members");
    std::vector<Clause> all;
    for (const auto& [key, value] : condition.items()) {
      if (key == "allOf") {
        for (const Schema& each : list(value)) {
          for (Clause& clause : clauses(each)) all.push_back(std::move(clause));
        }
      } else {
        all.push_back(key == "anyOf" ? any_of(list(value)) : comparison(find(key), value));
      }
    }
    return all;
  }

  const Schema& list(const Schema& value) const {
    if (!value.is_array() || value.size() < 2) refuse("anyOf and allOf list two conditions or more");
    return value;
  }

  Clause any_of(const Schema& alternatives) const {
    Clause any;
    bool is_long = false;
    for (const Schema& each : alternatives) {
      Clause all;
      for (const Clause& clause : clauses(each)) {
        all.holds += (all.holds.empty() ? "" : " && ") + clause.holds;
        all.words += (all.words.empty() ? "" : " and ") + clause.words;
      }
      is_long = is_long || all.words.find(" or ") != std::string::npos;
      any.holds += (any.holds.empty() ? "(" : " || (") + all.holds + ")";
      any.words += any.words.empty() ? all.words : (is_long ? ", or " : " or ") + all.words;
    }
    any.holds = "(" + any.holds + ")";
    any.reason = "unless " + any.words;
    return any;
  }

  /// "build" is a sibling, "sway/wind" a member of a sibling, "/model" a member of the parameters.
  Target find(const std::string& path) const {
    const bool is_absolute = path.starts_with('/');
    const Type* structure = is_absolute ? &unit_.root : &owner_;
    Target target{nullptr, is_absolute ? "root" : "value", is_absolute ? "" : prefix_};
    for (std::size_t at = is_absolute ? 1 : 0; at <= path.size();) {
      const std::size_t end = std::min(path.find('/', at), path.size());
      const std::string name = path.substr(at, end - at);
      if (structure->kind != Kind::structure || (target.member && target.member->optional))
        refuse("nothing can be found in " + target.name);
      const auto found = std::ranges::find(structure->members, name, &Member::name);
      if (found == structure->members.end()) refuse("there is no parameter " + path);
      target = {&*found, target.value + "." + found->cpp_name,
                target.name + (target.member ? "." : "") + name};
      structure = &found->type;
      at = end + 1;
    }
    target.name = "`" + target.name + "`";
    return target;
  }

  Clause comparison(const Target& target, const Schema& test) const {
    if (!test.is_object()) return one_of(target, test, false);
    if (test.size() == 1 && test.contains("not")) return one_of(target, test["not"], true);
    if (test.size() != 1 || !test.contains("above")) refuse("a test is a value, a list, not or above");
    const Kind kind = target.member->type.kind;
    if ((kind != Kind::number && kind != Kind::integer) || !test["above"].is_number())
      refuse("above goes with numbers");
    const std::string bound = test["above"].dump();
    const std::string words = target.name + " is greater than " + bound;
    return {"(" + target.value + " > " + bound + ")", words, "unless " + words};
  }

  /// True where the target is one of the values, or where it is none of them.
  Clause one_of(const Target& target, const Schema& values, bool is_none) const {
    const Schema list = values.is_array() && !values.empty() ? values : Schema::array({values});
    Clause clause;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string equal = equals(target, list[i]);
      clause.holds += (i ? " || " : "") + equal;
      clause.words += (i == 0 ? "" : i + 1 < list.size() ? ", " : " or ") + words_of(list[i]);
    }
    clause.holds = (is_none ? "!(" : "(") + clause.holds + ")";
    const bool is_absence = list[0].is_null() || list[0].empty() || is_empty_text(list[0]);
    const std::string positive = target.name + " is " + clause.words;
    if (is_absence) {
      clause.words = target.name + (is_none ? " is given" : " is left out");
    } else {
      clause.words = is_none ? target.name + " is not " + clause.words : positive;
    }
    clause.reason = is_none && !is_absence ? "if " + positive : "unless " + clause.words;
    return clause;
  }

  static std::string words_of(const Schema& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  }

  std::string equals(const Target& target, const Schema& value) const {
    if (target.member->optional && value.is_null()) return "!" + target.value;
    const std::string name = target.member->optional ? "(*" + target.value + ")" : target.value;
    if (std::string test = equals(target.member->type, name, value); !test.empty())
      return target.member->optional ? "(" + target.value + " && " + test + ")" : test;
    refuse(target.name + " is never " + value.dump());
  }

  /// Empty where a value of the type is never equal to this one.
  static std::string equals(const Type& type, const std::string& name, const Schema& value) {
    switch (type.kind) {
      case Kind::flag:
        return value.is_boolean() ? name + " == " + value.dump() : "";
      case Kind::number:
        return value.is_number() ? name + " == " + value.dump() : "";
      case Kind::integer:
        return value.is_number_integer() ? name + " == " + value.dump() : "";
      case Kind::text:
        return is_empty_text(value) ? name + ".empty()"
               : value.is_string()  ? name + " == " + quoted(value.get<std::string>())
                                    : "";
      case Kind::list:
        return value.is_array() && value.empty() ? name + ".empty()" : "";
      case Kind::choice:
        if (std::ranges::find(type.schema["enum"], value) == type.schema["enum"].end()) return "";
        return name + " == " + type.cpp + "::" + enumerator(value.get<std::string>());
      case Kind::variant:
        return equals_alternative(type, name, value);
      default:
        return "";
    }
  }

  static std::string equals_alternative(const Type& type, const std::string& name, const Schema& value) {
    for (std::size_t i = 0; i < type.parts.size(); ++i) {
      const std::string index = std::to_string(i);
      const std::string test = equals(type.parts[i], "std::get<" + index + ">(" + name + ")", value);
      if (!test.empty()) return "(" + name + ".index() == " + index + " && " + test + ")";
    }
    return "";
  }

  const Unit& unit_;
  const Type& owner_;
  std::string prefix_, where_;
};

using Prefixes = std::map<std::string, std::string>;

/// The path to each structure: "leaf."; "" for one that is in a list or at several positions.
void find_prefixes(const Type& type, const std::string& prefix, Prefixes& prefixes) {
  const bool is_structure = type.kind == Kind::structure;
  if (is_structure && !prefixes.insert({type.cpp, prefix}).second) prefixes[type.cpp] = "";
  for (const Type& part : type.parts) find_prefixes(part, "", prefixes);
  for (const Member& member : type.members)
    find_prefixes(member.type, is_structure ? prefix + member.name + "." : "", prefixes);
}

void translate_all(const Unit& unit, const Prefixes& prefixes, Type& type) {
  std::vector<Member> translated = type.members;
  for (Member& member : translated) {
    translate_all(unit, prefixes, member.type);
    if (!member.type.schema.contains("x-applies-when")) continue;
    if (type.kind != Kind::structure)
      throw SchemaError(unit.name + ".schema.json: x-applies-when inside a shorthand: " + member.name);
    Translator(unit, type, prefixes.at(type.cpp)).translate(member);
  }
  type.members = std::move(translated);
  for (Type& part : type.parts) translate_all(unit, prefixes, part);
}

bool has_conditions(const Type& type) {
  const auto is_conditional = [](const Member& member) {
    return !member.applies_when.empty() || has_conditions(member.type);
  };
  return std::ranges::any_of(type.members, is_conditional) || std::ranges::any_of(type.parts, has_conditions);
}

/// Statements that look for unused parameters inside a value.
std::string descend(const Type& type, const std::string& value, const std::string& pointer, int depth) {
  if (!has_conditions(type)) return "";
  const std::string number = std::to_string(depth);
  switch (type.kind) {
    case Kind::structure:
      return "find_unused(root, " + value + ", " + pointer + ", unused);\n";
    case Kind::list: {
      const std::string i = "i" + number;
      return "for (std::size_t " + i + " = 0; " + i + " < " + value + ".size(); ++" + i + ") {\n" +
             descend(type.parts[0], value + "[" + i + "]", pointer + " + \"/\" + std::to_string(" + i + ")",
                     depth + 1) +
             "}\n";
    }
    case Kind::map:
      return "for (const auto& [key" + number + ", entry" + number + "] : " + value + ") {\n" +
             descend(type.parts[0], "entry" + number, pointer + " + pointer_token(key" + number + ")",
                     depth + 1) +
             "}\n";
    case Kind::variant: {
      std::string text;
      for (std::size_t i = 0; i < type.parts.size(); ++i) {
        const std::string inside = descend(type.parts[i], "(*part" + number + ")", pointer, depth + 1);
        if (!inside.empty()) {
          text += "if (const auto* part" + number + " = std::get_if<" + std::to_string(i) + ">(&" + value +
                  ")) {\n" + inside + "}\n";
        }
      }
      return text;
    }
    default:
      return "";
  }
}

std::string check_member(const Member& member) {
  const std::string value = "value." + member.cpp_name;
  const std::string pointer = "at + " + quoted("/" + member.name);
  const std::string inside = descend(member.type, member.optional ? "(*" + value + ")" : value, pointer, 0);
  if (member.applies_when.empty() && inside.empty()) return "";
  const std::string is_given = member.required   ? "true"
                               : member.optional ? value + ".has_value()"
                                                 : "!(" + value + " == plain." + member.cpp_name + ")";
  if (member.applies_when.empty()) return "  if (" + is_given + ") {\n" + inside + "  }\n";
  std::string text = "  if (" + is_given + ") {\n    ";
  for (const Clause& clause : member.applies_when) {
    const bool is_negation = clause.holds.starts_with('!');
    text += (text.ends_with('}') ? " else if (" : "if (") +
            (is_negation ? clause.holds.substr(1) : "!" + clause.holds) + ") {\n      unused.push_back({" +
            pointer + ", " + quoted("`" + member.shown_name + "` has no effect " + clause.reason + ".") +
            "});\n    }";
  }
  return text + (inside.empty() ? "" : " else {\n" + inside + "    }") + "\n  }\n";
}

}  // namespace

void translate_conditions(Unit& unit) {
  Prefixes prefixes;
  find_prefixes(unit.root, "", prefixes);
  translate_all(unit, prefixes, unit.root);
  for (Type& type : unit.declared) translate_all(unit, prefixes, type);
}

std::string emit_unused_header(const Unit& unit) {
  const std::string& params = unit.root.cpp;
  return "#pragma once\n// Made from api_schema/" + unit.name +
         ".schema.json. Do not edit: edit the schema.\n#include <vector>\n\n#include "
         "\"core/schema/unused.h\"\n\n"
         "namespace seedmesh {\n\nstruct " +
         params +
         ";\n\n/// Parameters that are given and have no effect, in the order of the schema. A parameter is "
         "given\n"
         "/// where it differs from its default. Pointers are relative to the parameters.\n"
         "std::vector<UnusedParameter> unused_parameters(const " +
         params + "& params);\n\n}  // namespace seedmesh\n";
}

std::string emit_unused(const Unit& unit) {
  const std::string& params = unit.root.cpp;
  const std::string head = "std::vector<UnusedParameter> unused_parameters(const " + params + "&";
  if (!has_conditions(unit.root)) return head + ") { return {}; }\n\n";
  std::string text = "namespace {\n\n";
  for (const Type& type : unit.declared) {
    if (type.kind != Kind::structure || !has_conditions(type)) continue;
    text += "void find_unused([[maybe_unused]] const " + params + "& root, const " + type.cpp +
            "& value, const std::string& at,\n                 std::vector<UnusedParameter>& unused) {\n"
            "  [[maybe_unused]] static const " +
            type.cpp + " plain;\n";
    for (const Member& member : type.members) text += check_member(member);
    text += "}\n\n";
  }
  return text + "}  // namespace\n\n" + head +
         " params) {\n  std::vector<UnusedParameter> unused;\n  find_unused(params, params, \"\", unused);\n"
         "  return unused;\n}\n\n";
}

}  // namespace codegen
