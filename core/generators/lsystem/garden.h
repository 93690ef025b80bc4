#pragma once
/// Open L-systems: plants that grow in one environment, step by step. Between two steps every plant's word is
/// drawn, what grew where nothing may be is cut away, and modules that ask (?P ?H ?L ?U ?E) are answered in
/// the word; so a production sees the answer one step later, as in cpfg. Interpretation rules draw but do not
/// ask.
#include <memory>
#include <vector>

#include "core/generators/lsystem/draw.h"
#include "core/generators/lsystem/word.h"
#include "core/geom/surroundings.h"

namespace seedmesh::lsystem {

/// What the schema cannot say of an environment; pointers relative to the parameters.
void check_environment(const LsystemParams& params, std::vector<Issue>& issues);

class Garden {
 public:
  /// Makes the solids, with the models of those that are meshes. `params` are those of the first plant; those
  /// of its companions are read here.
  Garden(const LsystemParams& params, Job& job);
  ~Garden();

  /// Is it needed? Else a plant grows without ever being looked at.
  static bool needed(const Grammar& grammar, const LsystemParams& params);

  /// Derives all plants to the end. `steps` are those of the first plant before its last, fractional one.
  void grow(const Grammar& grammar, std::uint32_t steps);

  /// The word of the first plant.
  const Word& word() const;
  /// Draws the word of the first plant, from which a step may be missing of which there is only a share.
  void draw(const Grammar& grammar, Drawing& drawing, double share) const;
  void cut(Skeleton& skeleton) const;
  /// May cut() take something away?
  bool cuts() const { return surroundings_->bounds_growth(); }
  /// What is left of a drawing after cut(), which it does. `skeleton` is what the turtle wrote; not read
  /// unless cuts().
  TurtleReport report(const Turtle& turtle, Skeleton& skeleton) const;

  /// The companions' models and the hosts, as they stand.
  void add_others(Model& model);

 private:
  struct Plant;
  struct Host;
  void answer();
  void look(Plant& plant, std::vector<Stretch>& grown);
  static void follow(Plant& plant, const Turtle& turtle, const Limbs& limbs, std::size_t before);
  void reply(Plant& plant);

  const LsystemParams& params_;
  Job& job_;
  std::vector<Host> hosts_;
  std::vector<std::unique_ptr<Plant>> plants_;  ///< the one that was asked for first, then its companions
  std::unique_ptr<Surroundings> surroundings_;
};

}  // namespace seedmesh::lsystem
