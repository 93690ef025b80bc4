#pragma once
/// The state of one derivation, and the tables that all operators share. derive.h runs the derivation,
/// interpret.h chooses rules and executes successors, and operators.h has the operations.
#include <array>
#include <map>
#include <unordered_map>

#include "core/generators/building/cuts.h"
#include "core/generators/building/derive.h"
#include "core/generators/building/occlusion.h"
#include "core/generators/building/shape_meter.h"

namespace seedmesh::building {

/// What the steps of one successor have in common.
struct Frame {
  std::uint32_t shape = 0;  ///< the shape that is replaced
  std::uint64_t key = 0;    ///< key of the successor, for random numbers
  ShapeState before;        ///< the state when the rule or the bracket began, for center()
  bool is_carried =
      false;  ///< new shapes descend from a face, edge or vertex of a closed solid; see collision.h
};

/// The context of one step: its successor, and the key of its random numbers.
struct StepContext {
  const Frame& frame;
  std::uint64_t key;
};

/// The reason why a step is impossible, for an error that does not end the derivation.
struct StepError {
  std::uint32_t offset = 0;
  std::string message;
};

struct Component;

struct Derivation {
  Derivation(const Task& task, const FirstPassIndex* first_pass, Job& job);

  const Task& task;
  const Grammar& grammar;
  const FirstPassIndex* first_pass;  ///< result of the first pass; null during that pass
  Job& job;
  ShapeMeter meter;
  Shapes out;
  std::vector<SnapPlane> snap_planes;
  bool is_finishing = false;  ///< runs until no rule applies

  // Evaluation (evaluate.h)
  std::vector<lang::TaggedValue> slots;
  const ShapeState* seen = nullptr;  ///< state of the shape for which expressions are evaluated
  std::uint32_t seen_shape = none, filled_attributes = none;
  bool is_filled = false;  ///< the slots have the values of `seen`
  Rng random{0};
  const Component* component = nullptr;                            ///< the component that selectors classify
  std::map<std::uint32_t, std::vector<lang::TaggedValue>> locals;  ///< values of with(...), by shape
  int depth_of_inline = 0;
  int guarded_steps = 0;  ///< number of enclosing steps whose errors are warnings

  // Equal rows of the tables of `out` are stored once.
  std::map<Style, std::uint32_t> style_ids;
  std::map<std::vector<lang::TaggedValue>, std::uint32_t> attribute_set_ids;
  std::map<PartOptions, std::uint32_t> part_option_ids;
  std::map<ValueArray, std::uint32_t> array_ids;
  std::map<UvSets, std::uint32_t> uv_set_ids;
  std::map<std::vector<std::uint32_t>, std::uint32_t> tag_set_ids;
  std::map<std::string, std::uint32_t, std::less<>> named_solids;
  /// Unit squares, indexed by the axis of the normal.
  std::array<Solid, 3> squares;
  /// Index of the axes of a side of a box. The key is 8 * (index of the axes of the box) + (number of the side).
  std::unordered_map<std::uint64_t, std::uint32_t> side_axes;
  /// Index of a solid that was made from flat geometry. The key is the index of that geometry, and the operation with
  /// its axis.
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> raised_solids;

  EditSearch edits;
  std::vector<std::uint32_t> warned;  ///< byte offsets in the rules that already have a warning
  std::uint64_t solid_corners = 0;
  std::vector<Cell> cells;                   ///< working memory of splits
  std::vector<std::vector<Cut>> spare_cuts;  ///< working memory of splits
};

/// Ends the derivation with an error at a byte of the rules; in a rule file of CityEngine, ends the step.
[[noreturn]] void reject(const Derivation& d, std::uint32_t offset, const std::string& message);

/// Adds a warning at a byte of the rules: at most one for each byte, and 100 in all.
void warn(Derivation& d, std::uint32_t offset, const std::string& message);

/// Adds a row to a table and returns its number. add_solid() throws Stop (a limit) if all solids together
/// have too many corners.
std::uint32_t add_axes(Derivation& d, const glm::dmat3& axes);
std::uint32_t add_solid(Derivation& d, Solid solid);
/// Returns the number of a style, which is added unless an equal one exists.
std::uint32_t style_with(Derivation& d, Style style);

/// Applies the edit that the request has for a new shape, if there is one. It changes the style, symbol and activity
/// of the shape.
void edit_shape(Derivation& d, std::uint32_t index);

/// Returns the total area of the faces, in square metres.
double area_of(const Derivation& d, const ShapeState& state);
/// Returns the volume in cubic metres; 0 if the geometry is not closed.
double volume_of(const Derivation& d, const ShapeState& state);

/// Returns the geometry of a flat state; it lies in the unit square of its scope.
const Solid& flat_solid(const Derivation& d, const ShapeState& state);
/// Returns a copy of the geometry of a state, in the unit cube of its scope.
Solid solid_of(const Derivation& d, const ShapeState& state);
/// Sets the geometry to `solid` (coordinates in metres, along the axes of the scope), and the scope to its
/// bounding box.
void take_solid(Derivation& d, ShapeState& state, Solid solid);
/// Gives the state another scope around the same geometry. The columns of `axes` are its axes in the world.
void reframe(Derivation& d, ShapeState& state, const glm::dmat3& axes);

/// Returns a number as text with as few digits as it needs: 3, 0.25, 1e+09.
std::string text_of_number(double number);

}  // namespace seedmesh::building
