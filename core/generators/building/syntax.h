#pragma once
/// The rules of a building as data, for both notations: flat arrays that refer to each other by index.
///
///   grammar = rules
///   rule    = symbol, parameters, body
///   body    = branches, each with a condition
///   branch  = choices, each with a weight
///   choice  = steps
///   step    = operation, arguments, parts (cells of a split, selectors of a component split)
///   part    = size or selector, body
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/generators/building/rule_text.h"
#include "core/generators/building/texts.h"
#include "core/lang/expression.h"
#include "core/model/model.h"

namespace seedmesh::building {

constexpr std::uint32_t none = 0xFFFFFFFFU;
inline bool is_array(const lang::TaggedValue& value) { return (value.text & array_bit) != 0; }

/// What an expression can read of its shape; the names are in parser.cpp.
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

/// A query to other shapes: Scope.occ("noparent"), overlaps(), ...
struct Query {
  enum class Kind : std::uint8_t { occlusion, inside, overlaps, touches, visible, count, distance };
  Kind kind = Kind::occlusion;
  std::string target;  ///< "all", "active", "noparent", or a symbol or label
  std::uint32_t slot = 0;
};

/// A node of an expression that lang::Program cannot represent: joined texts, arrays, recursion, geometry. Its
/// operands are in Grammar::value_operands.
struct ValueNode {
  enum class Kind : std::uint8_t {
    constant,  ///< `constant`
    slot,      ///< `id`: the slot
    local,     ///< `id`: the parameter of the function around it
    negate,
    invert,
    binary,      ///< `operation`
    mask,        ///< the same for each value of an array
    both,        ///< logical and (&&), which stops at the first that is false
    either,      ///< logical or (||)
    choose,      ///< choice by conditions: condition, value, condition, value, ..., value otherwise
    weigh,       ///< at random: percentage, value, percentage, value, ..., value otherwise
    call,        ///< `id`: index into lang::functions()
    function,    ///< `id`: index into Grammar::functions
    special,     ///< `id`: index into value_functions()
    query,       ///< `id`: index into Grammar::queries
    index,       ///< array, row, and perhaps column
    array,       ///< values; `id` is the number of columns, or 0
    range,       ///< first, step, last
    components,  ///< `id`: index into Grammar::component_values
    selector,    ///< whether the component belongs to the classes `id`
  };
  Kind kind = Kind::constant;
  lang::Operation operation = lang::Operation::add;
  std::uint8_t frame = 0;  ///< SelectorFrame of a selector
  std::uint32_t first = 0, count = 0, id = 0, offset = 0;
  lang::TaggedValue constant;
};

/// A function of the rules that is not expanded where it is called.
struct FunctionTree {
  std::uint32_t root = none, parameter_count = 0;
};

struct Value {
  lang::Expression expression;
  std::uint32_t tree = none;  ///< a ValueNode; none: it is in `expression`
  /// True: `expression` is tried first; the tree is used only if a parameter is a text or an array at run
  /// time.
  bool is_fallback = false;
  std::uint32_t offset = 0;  ///< byte of the rules where it begins
  std::uint32_t first_query = 0, query_count = 0;
  bool is_given = false;
};

/// The unit of a number: 3 is absolute, '0.5 a share of the scope, ~3 or 3r a share of what is left. For
/// roofs, byHeight(3) is a height.
enum class Measure : std::uint8_t { absolute, relative, floating, height };

struct Argument {
  Value value;
  Measure measure = Measure::absolute;
  std::uint32_t word = none;  ///< index into Grammar::words of an argument that is a word
};

enum class Op : std::uint8_t {
  symbol,
  nil,
  push,
  pop,
  body,
  ignored,
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
  inner_rect,  ///< innerRect
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
  translate_in,
  rotate_in,
  rotate_scope,
  set_pivot,
  mirror,
  reverse_normals,
  cleanup,
  convexify,
  delete_holes,
  rectify,
  reduce,
  set_normals,
  trim,
  reset_geometry,
  reset_material,
  set_material,
  footprint,
  envelope,
  primitive_quad,
  primitive_disk,
  primitive_cube,
  primitive_sphere,
  primitive_cylinder,
  primitive_cone,
  primitive_fitted,
  primitive_polygon,
  insert_along_uv,
  roof_ridge,
  setback_per_edge,
  setback_to_area,
  split_perimeter,
  scatter,
  inline_shapes,
  modify,
  unite,
  subtract,
  intersect,
  tag,
  delete_tags,
  edge_tags,
  texture,
  normalize_uv,
  scale_uv,
  rotate_uv,
  translate_uv,
  tile_uv,
  copy_uv,
  delete_uv,
  print,
};

struct Step {
  Op op = Op::symbol;
  std::uint32_t first_argument = 0, argument_count = 0;
  std::uint32_t first_part = 0, part_count = 0;
  std::uint32_t symbol = none;
  std::uint32_t offset = 0;
  bool is_leaf = false;         ///< of a symbol: written as `Name.`, which makes a leaf
  bool stays_whole = false;     ///< of a symbol: its rule always splits it off again, so it becomes a leaf
  bool keeps_slab = false;      ///< of a split: noAdjust, cells do not get a scope fitted to their geometry
  bool keeps_to_snaps = false;  ///< of a split: its borders move to snap lines
  bool is_2006 = false;         ///< of a repeat: written as Repeat(...), in the notation of 2006
  bool is_repeated = false;     ///< of a split of the perimeter: { ... }*
  bool in_metres = false;       ///< of a split along u or v: unitSpace
  std::uint8_t axis = 0;        ///< x, y, z, or of a split axis_u, axis_v; of comp a ComponentKind
};

/// The components into which a component split divides a shape.
enum ComponentKind : std::uint8_t {
  component_faces,
  component_edges,
  component_vertices,
  component_face_edges,
  component_face_vertices,
  component_groups,
  component_materials,
  component_holes,
};

/// The frame in which a selector classifies a component. The first shape has the axes of the world.
enum SelectorFrame : std::uint8_t { frame_scope, frame_world };

/// The axes of texture space, as axes of a split.
constexpr std::uint8_t axis_u = 3, axis_v = 4;

/// The classes of faces and edges that a selector of a component split can test; bits of Part::classes.
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
  face_border = 8192,
  edge_eave = 1U << 14U,
  edge_hip = 1U << 15U,
  edge_valley = 1U << 16U,
  edge_ridge = 1U << 17U,
  never = 1U << 18U  ///< matches no component: a property that no shape has, such as that of a street
};

/// A cell of a split, or a selector of a component split.
struct Part {
  Argument size;
  std::uint32_t body = none;
  std::uint32_t first_part = 0, part_count = 0;  ///< parts of a group that is repeated
  bool is_group = false;
  std::uint32_t classes = 0;         ///< of a selector
  std::int32_t index = -1;           ///< number of the only component of a selector, or -1
  bool is_merged = false;            ///< of a selector: `=` makes one shape of all faces
  bool is_by_set = false;            ///< of a selector: `=:` makes one shape of faces that touch
  std::uint8_t frame = frame_scope;  ///< of a selector
  Value condition;                   ///< of a selector that is an expression
  std::uint32_t word = none;         ///< of a selector: how it is written, index into Grammar::words
  Argument depth;                    ///< of a split of the perimeter
  bool is_remainder = false;         ///< of a selector: `remainder`
  std::uint32_t offset = 0;
};

struct Choice {
  Value weight;                ///< not given: 1 minus the sum of the other weights
  bool is_percentage = false;  ///< the weight is an expression in percent
  std::uint32_t first_step = 0, step_count = 0;
  bool is_stack = false;  ///< symbols side by side, which may be a stack (slabs.h)
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
  std::vector<Value> locals;  ///< values of with(...), in the slots behind those of the parameters
  std::vector<std::pair<std::uint32_t, Value>> fixed;  ///< A(0): parameters that must have a value
  std::int32_t priority = 0;
  std::uint32_t offset = 0;
};

/// The left side of rules of several shapes, A(x) + [B] ~> ...
struct Joint {
  struct Left {
    std::uint32_t symbol = 0, parameter_count = 0;
    bool is_kept = false;  ///< whether it is in brackets: it must be there and stays
    bool operator==(const Left&) const = default;
  };
  std::vector<Left> lefts;   ///< the first is not kept
  std::uint32_t symbol = 0;  ///< "A + [B]", whose rules replace the joined shape
};

struct Symbol {
  std::string name;
  std::vector<std::uint32_t> rules;
  std::uint32_t first_use = none;  ///< byte of the rules
  bool is_in_joint = false;        ///< part of a left side of several shapes
};

struct Attribute {
  std::string name;
  Value value;
  std::uint32_t slot = 0;
  std::uint32_t offset = 0;
  bool is_constant = false;
  bool has_range = false;
  double low = 0, high = 0;
  double step = 0;                         ///< step of @Range; 0: any
  std::vector<lang::TaggedValue> choices;  ///< values of @Enum
  bool is_restricted = true;               ///< values outside of the range or the choices are errors
  /// Values of other annotations; the widget is color, angle, percent, ...
  std::string group, description, widget;
  bool is_hidden = false;
  double order = 0;
};

/// A component split inside an expression: comp(fe){ front = 3 | all : 1 }, an array.
struct ComponentValue {
  std::uint8_t kind = 0;
  std::vector<Part> parts;  ///< the value is in `size`
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
  std::vector<Joint> joints;              ///< left sides of several shapes, in the order of the text
  std::vector<Attribute> attributes;      ///< those that others need come first
  std::vector<Query> queries;             ///< queries to other shapes, without duplicates
  std::vector<std::uint32_t> query_uses;  ///< indices into `queries` of the queries that values use
  std::uint32_t start = none;
  std::uint32_t first_attribute_slot = first_free_slot, first_parameter_slot = first_free_slot;
  std::uint32_t most_parameters = 0;
  bool has_snap_splits = false;
  std::vector<ValueNode> value_nodes;
  std::vector<std::uint32_t> value_operands;  ///< indices into value_nodes
  std::vector<FunctionTree> functions;
  std::vector<ComponentValue> component_values;
  bool uses_selectors = false;  ///< comp.sel is read somewhere
  bool uses_tags = false;       ///< tags are read somewhere, so that operations tag what they make
  /// Whether scopes behave as in CityEngine (see stand_up and lift_face); false after @KeepScopes.
  bool turns_scopes = false;
  bool keeps_scopes = false;   ///< has @KeepScopes: not even the scopes of level faces turn (see stand_up)
  bool is_cityengine = false;  ///< has `version`, `import`, `@StartRule`: errors of steps are warnings
  std::vector<Warning> warnings;

  std::uint32_t symbol_named(std::string_view name) const;  ///< none if there is no such symbol
};

/// The least number of parameters of the rules of a symbol; 0 if it has no rule.
std::uint32_t least_parameters(const Grammar& grammar, std::uint32_t symbol);

/// Reads rules in both notations. Adds every error at its byte of the joined text. `start` is a symbol, perhaps
/// with a style before it (Modern$Lot); if it is empty, that of the rule after @StartRule or `start`, or of the
/// first rule. Cost: linear. Brackets may be nested 100 deep.
Grammar read_rules(const RuleText& text, std::string_view start, std::vector<lang::TextError>& errors);

}  // namespace seedmesh::building
