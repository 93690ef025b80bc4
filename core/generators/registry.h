#pragma once
/// Every generator has one row here. Nothing else in core, server or tests knows a generator by name.
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/job.h"
#include "core/generators/appraisal.h"
#include "core/generators/form.h"
#include "core/gltf/payload.h"
#include "core/schema/child.h"
#include "core/schema/faults.h"
#include "core/schema/json.h"

namespace seedmesh {

/// The functions of one generator, with its parameters behind a pointer that only they know the type of.
struct Generator {
  /// Parameters as read, of the generator's own struct. Immutable and shared by the copies of a request.
  using Params = std::shared_ptr<const void>;

  /// What is done with each request inside the parameters when they are read: see child.h.
  using Settle = std::function<void(const ChildPlace&)>;

  std::string_view name;       ///< in a request; its schema and its folder of presets have the same name
  bool grows = false;          ///< makes the animation "growth" where Job::demand() asks for it
  bool sways = false;          ///< writes wind weights where it asks for them
  bool has_collision = false;  ///< makes collision shapes where it asks for them
  bool has_impostor = false;   ///< its models can be shown by pictures of them
  bool keeps_budget = false;   ///< chooses levels of detail itself to have Job::demand().most_triangles
  bool parts = false;  ///< what it repeats are parts of one thing, which beyond 400 are merged by material
  /// Its meshes fit a budget of triangles better where triangles are joined than at a level of detail.
  bool joins_triangles = false;
  /// How a request gives its model levels of detail of its own, for who wants more than there are; empty:
  /// they have them in any case, or never.
  std::string_view own_levels = {};

  /// From JSON that stands at `pointer`. Gives parameters even where there are faults: refused members have
  /// defaults. An empty `settle` leaves requests inside as they are. Callers use read_parameters of child.h.
  Params (*read)(const Json& json, std::string_view pointer, Faults& faults, const Settle& settle);
  /// The canonical JSON of the parameters.
  Json (*write)(const Params& params);
  /// Faults that no schema can tell, such as those of a grammar; pointers are relative to the parameters.
  std::vector<Issue> (*check)(const Params& params, const Limits& limits);

  Result<Model> (*generate)(const Params& params, Job& job);
  Result<Json> (*derive)(const Params& params, Job& job);
  Result<Appraisal> (*appraise)(const Params& params, const Job& job);
  /// The words of its notation, by group: {"turtle": [{symbol, parameters, text, example}]}.
  Json (*vocabulary)();

  /// Forms beside those of models, and what makes one of them; null where there are none.
  std::span<const OwnForm> forms = {};
  Result<Payload> (*encode)(const Params& params, const WantedForm& form, Job& job) = nullptr;
  /// Faults between parameters and one of these forms; pointers relative to the parameters, or below
  /// "/output/". Null: there are none.
  std::vector<Issue> (*check_form)(const Params& params, const WantedForm& form) = nullptr;
};

/// In the order of the menu.
std::span<const Generator> generators();

/// Null: there is none of this name.
const Generator* find_generator(std::string_view name);

}  // namespace seedmesh
