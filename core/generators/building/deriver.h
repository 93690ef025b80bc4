#pragma once
/// The interpreter behind derive.h, for the sources of this folder.
#include <array>
#include <unordered_map>

#include "core/generators/building/derive.h"
#include "core/generators/building/occlusion.h"

namespace seedmesh::building {

/// As few digits as tell the number: 3, 0.25, 1e+09.
std::string text_of_number(double number);

class Deriver {
 public:
  /// `first` is what the first pass made, or null in that pass.
  Deriver(const Task& plan, const Context* first, Job& job);
  Shapes run();
  std::vector<SnapPlane> take_snaps() { return std::move(snaps_); }

 private:
  /// The current shape of a successor, which operations change.
  struct State {
    glm::dvec3 origin{0}, size{0};
    std::uint32_t axes = 0, geometry = box_geometry, style = 0;
    std::uint32_t split_index = 0, split_total = 0, comp_index = 0, comp_total = 0;
    std::uint8_t tag = 0;  ///< of a face while a component split looks at it
    std::uint8_t roof_up = no_roof;
  };
  static State state_of(const Shape& shape);  ///< as its rule begins
  /// One successor on the way: whose it is, and where its random numbers hang.
  struct Frame {
    std::uint32_t shape = 0;  ///< whose rule this is
    std::uint64_t key = 0;
    State before;  ///< when the rule or the bracket began: for center()
    bool is_carried = false;
  };

  // Order (derive.cpp)
  void begin();
  void finish_all();
  void parallel(int rounds);
  void sequential(int steps);
  bool has_rule(const Shape& shape) const;
  bool expand(std::uint32_t shape);
  void evaluate_attributes();

  // Rules (interpret.cpp)
  const Choice* choose(std::uint32_t shape);
  const Choice* choose_in(std::span<const std::uint32_t> rules, std::uint32_t parameters, std::uint64_t key);
  void run_body(std::uint32_t body, const State& state, const Frame& frame);
  void run_choice(const Choice& choice, const State& state, const Frame& frame);
  void run_step(const Step& step, State& state, const Frame& frame, std::uint64_t key, bool& is_pending);
  void call(const Step& step, const State& state, const Frame& frame, std::uint64_t key);
  void leaf(const State& state, const Frame& frame, std::uint64_t key, std::uint32_t symbol);
  std::uint32_t add(const State& state, const Frame& frame, std::uint64_t key, std::uint32_t symbol);

  // Values (interpret.cpp)
  void look_at(const State& state, std::uint32_t shape);
  void fill_slots();
  double value(const Value& value);
  double number(const Value& value);
  double length(const Argument& argument, double whole);
  const std::string& text(const Argument& argument);
  double text_number(const Argument& argument);
  [[noreturn]] void reject(std::uint32_t offset, const std::string& message) const;
  void blame_attribute(std::uint32_t offset, double given, const std::string& message) const;
  void warn(std::uint32_t offset, const std::string& message);

  // Operations (operate.cpp, split.cpp, comp.cpp)
  void translate(const Step& step, State& state);
  void resize(const Step& step, State& state);
  void rotate(const Step& step, State& state);
  void center(const Step& step, State& state, const Frame& frame);
  void mirror(State& state);
  std::uint32_t prism_over(const State& state, int axis);
  void extrude(const Step& step, State& state);
  void taper(const Step& step, State& state);
  void insert(const Step& step, State& state);
  std::uint32_t options_of(const Step& step);
  void color(const Step& step, State& state);
  void set(const Step& step, State& state);
  void report(const Step& step);

  // Frames (frames.cpp)
  Solid solid_of(const State& state);
  void reframe(State& state, const glm::dmat3& axes);
  void align_to_axes(const Step& step, State& state);
  void align_to_geometry(const Step& step, State& state);
  void setup_projection(const Step& step, State& state);
  void project_uv(const Step& step, State& state);
  State along_texture(const Step& step, const State& state, int& axis, double& unit);

  // Areas (area.cpp)
  void split_area(const Step& step, const State& state, const Frame& frame, std::uint64_t key);
  void inner_rectangle(const Step& step, const State& state, const Frame& frame, std::uint64_t key);

  // Mass (mass.cpp)
  void take_solid(State& state, Solid solid);
  bool take_underside(State& state);
  void roof_over(const Step& step, State& state);
  void offset_face(const Step& step, State& state);
  void set_back(const Step& step, const State& state, const Frame& frame, std::uint64_t key);
  void snap(const Step& step, const State& state);
  void split(const Step& step, const State& state, const Frame& frame, std::uint64_t key);
  void repeat(const Step& step, const State& state, const Frame& frame, std::uint64_t key);
  /// The pieces of `whole`, in its unit; sizes are worked out once, before any piece comes to be.
  std::vector<Cut> cuts_of(const Step& step, double whole);
  void pieces(const Step& step, const State& state, const Frame& frame, std::uint64_t key,
              std::span<const Cut> cuts, int axis);
  void snapped(const Step& step, const State& state, std::vector<double>& lines) const;
  void comp(const Step& step, const State& state, const Frame& frame, std::uint64_t key);
  void components(const State& state, int kind, std::vector<State>& out);
  void box_faces(const State& state, std::vector<State>& out);
  void solid_faces(const State& state, std::vector<State>& out);
  void edges_and_corners(const State& state, int kind, std::vector<State>& out);
  std::uint32_t classes_of(const State& face) const;
  void merge(const State& state, std::span<const State> faces, State& out);

  // Tables
  std::uint32_t add_axes(const glm::dmat3& axes);
  std::uint32_t add_solid(Solid solid);
  std::uint32_t named_solid(std::string_view name);
  const Solid& flat_solid(const State& state);
  std::uint32_t style_with(Style style);
  double area(const State& state) const;
  double volume(const State& state) const;

  const Task& plan_;
  const Grammar& grammar_;
  const Context* first_;
  Job& job_;
  Meter meter_;
  Shapes out_;
  std::vector<double> slots_;
  const State* seen_ = nullptr;  ///< what the slots are to be filled for
  std::uint32_t seen_shape_ = none, filled_attributes_ = none, filled_parameters_ = none;
  bool is_filled_ = false;
  Rng draws_{0};
  bool is_finishing_ = false;
  std::map<Style, std::uint32_t> styles_;
  std::map<std::vector<double>, std::uint32_t> attribute_sets_;
  std::map<PartOptions, std::uint32_t> part_options_;
  std::map<std::string, std::uint32_t, std::less<>> named_;
  std::array<Solid, 3> squares_;
  std::unordered_map<std::uint64_t, std::uint32_t> turned_;  ///< axes and side: axes of the faces of boxes
  std::map<std::pair<std::uint32_t, int>, std::uint32_t>
      made_solids_;  ///< of extrusions, by what was extruded
  std::vector<SnapPlane> snaps_;
  std::vector<std::uint32_t> warned_;
  std::uint64_t solid_corners_ = 0;
  std::vector<Cell> cells_;
  std::vector<std::vector<Cut>> spare_cuts_;
};

}  // namespace seedmesh::building
