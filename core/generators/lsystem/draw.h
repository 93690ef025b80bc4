#pragma once
/// Draws words: every module moves the turtle, or is first rewritten by the interpretation rules.
#include <algorithm>
#include <vector>

#include "core/generators/api.h"
#include "core/generators/lsystem/code.h"
#include "core/geom/plant/turtle.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

/// Sink of a derivation that draws its modules. Random spreads use the key of the module.
class Drawing {
 public:
  /// `skeleton` may be null; then the drawing is only measured.
  Drawing(const Grammar& grammar, const LsystemParams& params, Skeleton* skeleton,
          const GenerateContext& context);

  /// Returns true where drawing uses random numbers, so that the derivation has to compute module keys.
  static bool needs_keys(const Grammar& grammar, const LsystemParams& params);

  void module(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t step);

  /// Keys of the random streams of a module.
  struct Keys {
    std::uint64_t own = 0;
    std::uint64_t before = 0;  ///< key of the module that it replaces; 0: none
  };
  struct Module {
    KindId kind;
    const double* parameters;
    Keys keys;
  };
  /// State of a module that is only partly grown. `share` scales lengths, organs and turns. A value that a
  /// symbol sets is interpolated between the current state of the turtle and that value. Turns are scaled
  /// only outside brackets that grow, too.
  struct PartialGrowth {
    double share = 1;
    int brackets = 0;      ///< number of growing brackets around the module
    double own_share = 1;  ///< weight of the random values of Keys::own; those of Keys::before have the rest
  };
  /// Draws a module that is partly grown. `step` is the depth for the width rule "decrement".
  void grow(const Module& module, double step, PartialGrowth grown);
  /// Draws a module that disappears. State that cannot change gradually is restored afterwards.
  void fade(const Module& module, double step, double share);

  /// Sets the variables of the grammar, which interpretation rules read. Call it before drawing.
  void set_variables(const std::vector<double>& variables) { variables_ = variables; }
  /// Sets the start position of the turtle. Call it before drawing.
  void start_at(const glm::dvec3& position) { turtle_.move_to(position); }
  const Turtle& turtle() const { return turtle_; }
  /// Number of unmatched braces in the drawing: { that are still open, and } without an open polygon.
  std::uint64_t open_polygons() const { return open_polygons_; }
  std::uint64_t stray_closings() const { return stray_closings_; }
  /// Recordings (core/geom/plant/turtle.h) of parts of this drawing. They are made by a separate drawing, on
  /// which begin_recording() is called.
  bool can_record() const { return turtle_.can_record(); }
  bool matches(const Turtle::Recording& recording) const { return turtle_.matches(recording); }
  void append_copy(const Turtle::Recording& recording) { turtle_.append_copy(recording); }
  void skip_copy(const Turtle::Recording& recording, bool is_measured) {
    turtle_.skip_copy(recording, is_measured);
  }
  const Job& job() const { return job_; }
  void begin_recording(const Drawing& like, Turtle::Recording& recording) {
    turtle_.begin_recording(like.turtle_, recording);
  }
  void end_recording(Turtle::Recording& recording) { turtle_.end_recording(recording); }
  void set_most_segments(std::uint64_t most) { turtle_.set_most_segments(most); }

 private:
  struct Angle {
    double degrees = 0;
    math::SinCos bare{0, 1};  ///< sine and cosine of `degrees`
  };
  /// Random streams of a module. They are separate, so that adding one spread does not change another.
  enum class Spread : std::uint64_t { angle = 11, step = 12, width = 13 };
  static double spread(std::uint64_t key, Spread of, double amount);
  static double spread(const Keys& keys, Spread of, double amount, double own_share);
  void interpret(KindId kind, const double* parameters, Keys keys, std::uint32_t depth);
  void write_interpreted(const Production& production, const double* parameters, Keys own,
                         std::uint32_t depth);
  void keep_variables(const std::vector<double>& slots) {
    std::copy_n(slots.begin(), variables_.size(), variables_.begin());
  }

  // interpret_modules.cpp
  void enter_frame(const double* parameters);
  void execute(const Kind& kind, const double* parameters, Keys keys);
  [[noreturn]] void refuse(const Kind& kind, const double* parameters, const std::string& message) const;
  double finite(double value, const Kind& kind, const double* parameters) const;
  void follow(const Kind& kind, const double* parameters, Keys keys);
  void close_polygon(std::uint64_t key);
  void begin_shape();
  void end_shape();
  void execute_whole(const Kind& kind, const double* parameters, Keys keys);
  /// The commands that set widths, colours, scales and positions, sweeps, organs and frames.
  void execute_state(const Kind& kind, const double* parameters, std::uint64_t key);
  math::SinCos turn(const Kind& kind, const double* parameters, const Angle& angle, Keys keys);
  math::SinCos turn(const Kind& kind, const double* parameters, const Angle& angle, Keys keys, double share);
  math::SinCos leftward(const Kind& kind, const double* parameters, const Angle& angle, Keys keys);
  double length(const Kind& kind, const double* parameters, Keys keys) const;
  double turned_share() const { return growth_.brackets == 0 ? growth_.share : 1; }
  void add_organ(const Kind& kind, const double* parameters, std::uint64_t key);
  void place_object(const Kind& kind, const double* parameters, double object, const glm::dvec3& scale,
                    std::uint64_t key);
  void place_organ(const Kind& kind, const double* parameters, std::uint32_t number, glm::dvec3 scale,
                   std::uint64_t key);
  void set_contour(const Kind& kind, const double* parameters);
  void set_width(const Kind& kind, const double* parameters, double change);

  const Grammar& grammar_;
  const LsystemParams& params_;
  Job& job_;
  CodeRunner code_;
  std::vector<double> variables_;
  Turtle turtle_;
  PartialGrowth growth_;
  std::vector<Turtle::Pose> shapes_;  ///< poses at which the open polygons of a growing module started
  std::vector<const LsystemSurface*> surfaces_;  ///< surfaces in the order of their names
  Angle yaw_, pitch_, roll_;
  std::uint64_t interpreted_ = 0;
  std::uint64_t open_polygons_ = 0, stray_closings_ = 0;
};

}  // namespace seedmesh::lsystem
