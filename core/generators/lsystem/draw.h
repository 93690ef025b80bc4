#pragma once
/// Words -> turtle: every module moves the turtle, through the interpretation rules where it has some.
#include <vector>

#include "core/generators/lsystem/code.h"
#include "core/geom/turtle.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

/// The sink of a derivation that draws. Spreads draw at the module's own place.
class Drawing {
 public:
  /// `skeleton` null: measures only.
  Drawing(const Grammar& grammar, const LsystemParams& params, Skeleton* skeleton, Job& job);

  /// True when somebody draws at random by the modules' keys, so that the derivation must make them.
  static bool needs_keys(const Grammar& grammar, const LsystemParams& params);

  void module(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t step);

  /// Where a module draws at random.
  struct Keys {
    std::uint64_t own = 0;
    std::uint64_t before = 0;  ///< of the module that it takes over from; 0: of none
  };
  struct Module {
    KindId kind;
    const double* parameters;
    Keys keys;
  };
  /// How much of a module there is yet: lengths, organs and turns have this share of themselves, turns only
  /// outside brackets that grow too; what a symbol sets leaves by it from the turtle's own.
  struct Grown {
    double share = 1;
    int brackets = 0;  ///< growing ones around the module
    double heir = 1;   ///< of what it draws at random; the rest is drawn where Keys::before says
  };
  /// A module that is not whole. `step` counts for the width rule decrement.
  void grow(const Module& module, double step, Grown grown);
  /// One that goes: what cannot change by degrees is afterwards as it was before.
  void fade(const Module& module, double step, double share);

  /// Where it starts, before anything is drawn.
  void start_at(const glm::dvec3& position) { turtle_.move_to(position); }
  const Turtle& turtle() const { return turtle_; }
  /// Braces that have no partner in what was drawn: { that are open still, and } that closed nothing.
  std::uint64_t open_polygons() const { return open_polygons_; }
  std::uint64_t stray_closings() const { return stray_closings_; }
  /// Stamps (core/geom/turtle.h) of what is drawn here; `begin_stamp` of a drawing of the stamp's own.
  bool can_stamp() const { return turtle_.can_stamp(); }
  bool matches(const Turtle::Stamp& stamp) const { return turtle_.matches(stamp); }
  void press(const Turtle::Stamp& stamp) { turtle_.press(stamp); }
  void begin_stamp(const Drawing& like, Turtle::Stamp& stamp) { turtle_.begin_stamp(like.turtle_, stamp); }
  void end_stamp(Turtle::Stamp& stamp) { turtle_.end_stamp(stamp); }
  void set_most_segments(std::uint64_t most) { turtle_.set_most_segments(most); }

 private:
  struct Angle {
    double degrees;
    math::SinCos bare;  ///< of `degrees`
  };
  /// Streams of a module's own place; apart, so that a spread added to one does not move another.
  enum class Spread : std::uint64_t { angle = 11, step = 12, width = 13 };
  static double spread(std::uint64_t key, Spread of, double amount);
  static double spread(const Keys& keys, Spread of, double amount, double heir);
  void interpret(KindId kind, const double* parameters, Keys keys, std::uint32_t depth);
  void write_interpreted(const Production& production, const double* parameters, Keys own,
                         std::uint32_t depth);

  // obey.cpp
  void enter_frame(const double* parameters);
  void obey(const Kind& kind, const double* parameters, Keys keys);
  void follow(const Kind& kind, const double* parameters, Keys keys);
  void close_polygon(std::uint64_t key);
  void begin_shape();
  void end_shape();
  void obey_wholly(const Kind& kind, const double* parameters, Keys keys);
  math::SinCos turn(const Kind& kind, const double* parameters, const Angle& angle, Keys keys);
  math::SinCos turn(const Kind& kind, const double* parameters, const Angle& angle, Keys keys, double share);
  math::SinCos leftward(const Kind& kind, const double* parameters, const Angle& angle, Keys keys);
  double length(const Kind& kind, const double* parameters, Keys keys) const;
  double turned_share() const { return grown_.brackets == 0 ? grown_.share : 1; }
  void place(const Kind& kind, const double* parameters, std::uint64_t key);
  void set_contour(double number);
  void set_width(const Kind& kind, const double* parameters, double change);

  const Grammar& grammar_;
  const LsystemParams& params_;
  Job& job_;
  CodeRunner code_;
  Turtle turtle_;
  Grown grown_;
  std::vector<Turtle::Pose> shapes_;             ///< where the open polygons of a growing module began
  std::vector<const LsystemSurface*> surfaces_;  ///< in the order of their names
  Angle yaw_, pitch_, roll_;
  double last_degrees_ = 0;  ///< angles given as arguments mostly repeat
  math::SinCos last_{0, 1};
  std::uint64_t interpreted_ = 0;
  std::uint64_t open_polygons_ = 0, stray_closings_ = 0;
};

}  // namespace seedmesh::lsystem
