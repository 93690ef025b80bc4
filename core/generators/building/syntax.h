#pragma once
/// The rules of a building as data: what both notations are read into, and what the derivation runs. Flat
/// arrays that name each other by index.
///
///   grammar = rules; rule = symbol, parameters, body
///   body = branches, each with a condition; branch = choices, each with a weight
///   choice = steps; step = operation with arguments and, where it cuts, parts; part = size or selector, body
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/lang/expression.h"
#include "core/model/model.h"

namespace seedmesh::building {

constexpr std::uint32_t none = 0xFFFFFFFFU;

/// Texts in expressions are numbers, so that one small code works out both: text_base + place in the table.
class Texts {
 public:
  static constexpr double text_base =
      1125899906842624.0;  // 2^50: no length or count of a building is so large
  double number_of(std::string_view text);
  /// Null: the number stands for no text.
  const std::string* of(double number) const;

 private:
  std::map<std::string, std::uint32_t, std::less<>> places_;
  std::vector<std::string> texts_;
};

/// What an expression can read of the shape that it is worked out for; the names are in names.cpp.
enum Slot : std::uint32_t {
  slot_sx,
  slot_sy,
  slot_sz,
  slot_tx,
  slot_ty,
  slot_tz,
  slot_split_index,
  slot_split_total,
  slot_comp_index,
  slot_comp_total,
  slot_area,
  slot_volume,
  slot_depth,
  first_free_slot
};

/// A question to the other shapes: Scope.occ("noparent"), overlaps(), ...
struct Query {
  enum class Kind : std::uint8_t { occlusion, inside, overlaps, touches, visible };
  Kind kind = Kind::occlusion;
  std::string target;  ///< "all", "active", "noparent", or a symbol or label
  std::uint32_t slot = 0;
};

struct Value {
  lang::Expression expression;
  std::uint32_t offset = 0;  ///< byte of the rules where it begins
  std::uint32_t first_query = 0, query_count = 0;
  bool is_given = false;
};

/// How a number is meant: 3, '0.5 (of the scope), ~3 or 3r (a share of what is left); of a roof, byHeight(3).
enum class Measure : std::uint8_t { absolute, relative, floating, height };

struct Argument {
  Value value;
  Measure measure = Measure::absolute;
  std::uint32_t word = none;  ///< where a word was asked for: its place in Grammar::words
};

enum class Op : std::uint8_t {
  symbol,
  nil,
  push,
  pop,
  translate,
  size,
  rotate,
  center,
  mirror_scope,
  align_to_axes,
  align_to_geometry,
  align_to_box,
  split,
  split_area,
  repeat,
  comp,
  snap,
  extrude,
  taper,
  offset,
  setback,
  shape_l,
  shape_u,
  shape_o,
  inner_rectangle,
  roof_hip,
  roof_gable,
  roof_pyramid,
  roof_shed,
  roof_mansard,
  roof_gambrel,
  roof,
  insert,
  place,
  color,
  material,
  set,
  setup_projection,
  project_uv,
  report,
  label,
};

struct Step {
  Op op = Op::symbol;
  std::uint32_t first_argument = 0, argument_count = 0;
  std::uint32_t first_part = 0, part_count = 0;
  std::uint32_t symbol = none;
  std::uint32_t offset = 0;
  bool is_leaf = false;      ///< of a symbol: written with a point
  bool stays_whole = false;  ///< of a symbol: only a leaf can end what it would begin; see Reading
  bool keeps_slab = false;   ///< of a split: noAdjust
  bool listens = false;      ///< of a split: to snap lines
  bool is_2006 = false;      ///< of a repeat: written as Repeat(...)
  bool in_metres = false;    ///< of a split along u or v: unitSpace
  std::uint8_t axis = 0;     ///< x, y, z, or of a split axis_u, axis_v
};

/// The axes of texture space, as axes of a split.
constexpr std::uint8_t axis_u = 3, axis_v = 4;

/// What a selector of a component split takes; bits of Selector::classes.
enum FaceClass : std::uint32_t {
  face_front = 1,
  face_back = 2,
  face_left = 4,
  face_right = 8,
  face_top = 16,
  face_bottom = 32,
  face_horizontal = 64,
  face_aslant = 128,
  face_vertical = 256,
  face_nutant = 512,
  face_side = 1024,
  face_all = 2048,
  face_inside = 4096,
  face_border = 8192
};

/// A cell of a split, or a selector of a component split.
struct Part {
  Argument size;
  std::uint32_t body = none;
  std::uint32_t first_part = 0, part_count = 0;  ///< of a group that is repeated
  bool is_group = false;
  std::uint32_t classes = 0;  ///< of a selector
  std::int32_t index = -1;    ///< of a selector: the one component of this number
  bool is_merged = false;     ///< of a selector: `=`, one shape of all
  bool is_remainder = false;  ///< of a selector: `remainder`
  std::uint32_t offset = 0;
};

struct Choice {
  Value weight;  ///< not given: what the others leave
  std::uint32_t first_step = 0, step_count = 0;
};

struct Branch {
  Value condition;  ///< not given: always
  std::uint32_t first_choice = 0, choice_count = 0;
};

struct Body {
  std::uint32_t first_branch = 0, branch_count = 0;
};

struct Rule {
  std::uint32_t symbol = 0, body = 0, parameter_count = 0;
  std::int32_t priority = 0;
  std::uint32_t offset = 0;
};

struct Symbol {
  std::string name;
  std::vector<std::uint32_t> rules;
  std::uint32_t first_use = none;  ///< byte of the rules
};

struct Attribute {
  std::string name;
  Value value;
  std::uint32_t slot = 0;
  std::uint32_t offset = 0;
  bool is_constant = false;
  bool has_range = false;
  double low = 0, high = 0;
  std::vector<double> choices;  ///< of @Enum
};

struct Grammar {
  lang::Program program;
  Texts texts;
  std::vector<std::string> words;
  std::vector<Step> steps;
  std::vector<Argument> arguments;
  std::vector<Part> parts;
  std::vector<Body> bodies;
  std::vector<Branch> branches;
  std::vector<Choice> choices;
  std::vector<Rule> rules;
  std::vector<Symbol> symbols;
  std::vector<Attribute> attributes;      ///< those that others need stand before them
  std::vector<Query> queries;             ///< each once
  std::vector<std::uint32_t> query_uses;  ///< of values, into `queries`
  std::uint32_t start = none;
  std::uint32_t first_attribute_slot = first_free_slot, first_parameter_slot = first_free_slot;
  std::uint32_t most_parameters = 0;
  bool listens_to_snaps = false;
  std::vector<Warning> warnings;

  std::uint32_t symbol_named(std::string_view name) const;  ///< none: there is no such symbol
};

/// The fewest parameters that a rule of the symbol has; 0 where it has no rule.
std::uint32_t least_parameters(const Grammar& grammar, std::uint32_t symbol);

/// Reads rules in both notations. Adds every fault that the text has, at its byte. `start` empty: the first
/// rule, or the one after @StartRule. Cost: linear; expressions and brackets go at most 200 deep.
Grammar read_rules(std::string_view text, std::string_view start, std::vector<lang::Fault>& faults);

}  // namespace seedmesh::building
