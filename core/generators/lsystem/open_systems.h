#pragma once
/// Open L-systems: several plants grow step by step in one environment. Between two steps every plant is drawn
/// and pruned where growth is not allowed. Query modules (?P ?H ?L ?U ?E) get their results as parameters, so a
/// production reads a result one step later, as in cpfg. Interpretation rules do not query. Source: Měch and
/// Prusinkiewicz, "Visual Models of Plants Interacting with Their Environment", SIGGRAPH 1996.
#include <memory>
#include <vector>

#include "core/generators/lsystem/draw.h"
#include "core/generators/lsystem/word.h"
#include "core/geom/plant/surroundings.h"

namespace seedmesh::lsystem {

/// Checks what the schema cannot express; pointers are relative to the parameters.
void check_environment(const LsystemParams& params, std::vector<Issue>& issues);

class OpenSystems {
 public:
  /// Creates the solids, including the models of mesh solids. `params` belong to the first plant; those of
  /// its companions are read here.
  OpenSystems(const LsystemParams& params, const GenerateContext& context);
  ~OpenSystems();

  /// Returns true where the environment affects the plant. Otherwise the caller derives without it.
  static bool needed(const Grammar& grammar, const LsystemParams& params);

  /// Derives all plants. `steps` is the number of whole steps of the first plant.
  void grow(const Grammar& grammar, std::uint32_t steps);

  /// Returns the word of the first plant.
  const Word& word() const;
  /// Draws the word of the first plant. If `share` is in (0, 1), it adds this share of the next step. If it
  /// is 1, it draws the word alone.
  void draw(const Grammar& grammar, Drawing& drawing, double share) const;
  void cut(Skeleton& skeleton) const;
  /// Returns true where cut() can remove something.
  bool cuts() const { return surroundings_->bounds_growth(); }
  /// Applies cut() to `skeleton` and returns the measures of what remains. `skeleton` is the turtle's output;
  /// it is read only where cuts() is true.
  TurtleReport report(const Turtle& turtle, Skeleton& skeleton) const;

  /// Adds the models of the companions and the visible hosts to `model`.
  void add_others(Model& model);

 private:
  struct Plant;
  struct Host;
  void answer_queries();
  void draw_and_prune(Plant& plant, std::vector<GrownInternode>& grown);
  static void follow(Plant& plant, const Turtle& turtle, const Limbs& limbs, std::size_t before);
  void write_answers(Plant& plant);
  GenerateContext context_of(Plant& plant) const;

  const LsystemParams& params_;
  const GenerateContext context_;
  Job& job_;
  std::vector<Host> hosts_;
  std::vector<std::unique_ptr<Plant>> plants_;  ///< the requested plant first, then its companions
  std::unique_ptr<Surroundings> surroundings_;
  std::unique_ptr<ShareCache> known_;  ///< of `surroundings_`
};

}  // namespace seedmesh::lsystem
