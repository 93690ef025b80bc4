#pragma once
/// The interface of a generator, and everything that is passed to one. core/registry lists the generators;
/// a generator itself includes only this header.
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/job.h"
#include "core/generators/estimate.h"
#include "core/gltf/payload.h"
#include "core/model/demand.h"
#include "core/model/model.h"
#include "core/schema/child.h"
#include "core/schema/issue_list.h"
#include "core/schema/json.h"

namespace seedmesh {

/// What a generator reports about a request without making its model.
struct Appraisal {
  std::vector<Warning> warnings;
  std::optional<Estimate> estimate;  ///< empty where the size is not known in advance
};

/// An output format that is not a model, such as a height map or a point cloud.
struct OwnFormat {
  std::string_view format;    ///< the value of output.format; core/pipeline/formats.h has its media type
  bool has_profiles = false;  ///< output.profile selects among conventions of the format
  bool has_models = false;    ///< the file contains models, so output.textures and output.tangents apply
};

/// The format and profile that a request selects.
struct WantedFormat {
  std::string_view format;
  std::string_view profile = "core";
};

struct Generator;

/// All generators, in the order of the menu. A generator needs the list for requests inside its own request
/// (core/generators/child.h). The list exists as long as the program.
using GeneratorList = std::span<const Generator>;

struct CheckContext;
struct GenerateContext;

/// The functions of one generator. Only they depend on the type of its parameters.
struct Generator {
  /// Parameters of the generator's own struct. Immutable; copies of a request share them.
  using Params = std::shared_ptr<const void>;

  /// What requests with some equal parameters have in common, such as rules that were read. Immutable; threads may
  /// share it.
  using Prepared = std::shared_ptr<const void>;

  /// Called with each request inside the parameters while they are read.
  using VisitChild = std::function<void(const ChildLocation&)>;

  std::string_view name;       ///< in requests; also the name of its schema and its directory of presets
  bool grows = false;          ///< makes the animation "growth"
  bool sways = false;          ///< writes wind weights
  bool has_collision = false;  ///< makes collision shapes
  bool has_impostor = false;   ///< an impostor can replace its models
  bool keeps_budget = false;   ///< keeps Demand::most_triangles itself by choosing levels of detail
  bool repeats_parts = false;  ///< repeats parts of one object; beyond 400 copies they are merged by material
  bool prefers_simplification =
      false;  ///< simplification fits a triangle budget better than a level of detail does
  /// A sentence on how a request can give its model levels of detail. It is appended to warnings about missing levels.
  /// Empty if models of the generator always have levels, or never.
  std::string_view own_levels = {};

  /// Reads JSON at `pointer` and adds what is wrong to `errors`. Always returns parameters: refused members
  /// have their defaults. An empty `visit` leaves requests inside unread. Callers use read_parameters().
  Params (*read)(const Json& json, std::string_view pointer, IssueList& errors,
                 const VisitChild& visit) = nullptr;
  /// The canonical JSON of the parameters.
  Json (*write)(const Params& params) = nullptr;
  /// Errors that the schema cannot express. Pointers are relative to the parameters.
  std::vector<Issue> (*check)(const Params& params, const CheckContext& context) = nullptr;

  Result<Model> (*generate)(const Params& params, const GenerateContext& context) = nullptr;
  /// Work that generate() can use for many requests. The result may be null, as may the function.
  Prepared (*prepare)(const Params& params, const CheckContext& context) = nullptr;
  /// The result before geometry, for example the word of an L-system.
  Result<Json> (*derive)(const Params& params, const GenerateContext& context) = nullptr;
  Result<Appraisal> (*appraise)(const Params& params, const GenerateContext& context) = nullptr;
  /// The words of its notation, by group: {"turtle": [{symbol, parameters, text, example}]}.
  Json (*vocabulary)() = nullptr;

  /// Output formats beside models, and the function that writes them; null where there are none.
  std::span<const OwnFormat> formats = {};
  Result<Payload> (*encode)(const Params& params, const WantedFormat& format,
                            const GenerateContext& context) = nullptr;
  /// Conflicts between the parameters and such a format. Pointers are relative to the parameters, or begin
  /// with "/output/". Null: no conflict is possible.
  std::vector<Issue> (*check_format)(const Params& params, const WantedFormat& format) = nullptr;
};

/// What check() needs besides the parameters. Loops over the parameters check the job's stop and deadline.
struct CheckContext {
  const Job& job;
  GeneratorList generators = {};
};

/// What the other functions need besides the parameters. `{job}` alone means a plain model without requests
/// inside.
struct GenerateContext {
  Job& job;
  Demand demand = {};
  GeneratorList generators = {};
  Generator::Prepared prepared = {};  ///< of this generator, perhaps of other parameters; may be null
};

/// Returns null where the list has no generator of this name.
const Generator* find_generator(GeneratorList generators, std::string_view name);

}  // namespace seedmesh
