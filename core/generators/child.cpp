#include "core/generators/child.h"

#include <nlohmann/json.hpp>

#include "core/model/widen.h"
#include "core/schema/nearest.h"

namespace seedmesh {
namespace {

Generator::Params read_at_depth(const Generator& generator, const Json& json, const std::string& pointer,
                                const Limits& limits, Faults& faults, int depth);

/// Reads the parameters of a child and puts their canonical form in their place.
void settle(Child& child, const std::string& pointer, const Limits& limits, Faults& faults, int depth) {
  if (child.generator.empty() || faults.covers(pointer)) return;
  if (depth > deepest_child) {
    faults.add({pointer, "found a request inside " + std::to_string(depth) + " others, expected at most " +
                             std::to_string(deepest_child)});
    return;
  }
  const Generator* generator = find_generator(child.generator);
  if (!generator) {
    faults.add({pointer + "/generator", unknown_generator(child.generator)});
    return;
  }
  const Json json = Json::parse(child.parameters);
  const Generator::Params params =
      read_at_depth(*generator, json, pointer + "/parameters", limits, faults, depth);
  child.parameters = canonical_text(generator->write(params));
}

/// Schema faults and grammar faults come together, but not the second as an echo of the first.
void add_grammar_faults(const Generator& generator, const Generator::Params& params,
                        const std::string& pointer, const Limits& limits, Faults& faults) {
  std::vector<Issue> found = generator.check(params, limits);
  for (Issue& issue : found) issue.pointer.insert(0, pointer);
  std::erase_if(found, [&faults](const Issue& issue) { return faults.covers(issue.pointer); });
  for (Issue& issue : found) faults.add(std::move(issue));
}

Generator::Params read_at_depth(const Generator& generator, const Json& json, const std::string& pointer,
                                const Limits& limits, Faults& faults, int depth) {
  const Generator::Settle settle_child = [&](const ChildPlace& place) {
    settle(*place.child, pointer + place.pointer, limits, faults, depth + 1);
  };
  Generator::Params params = generator.read(json, pointer, faults, settle_child);
  if (json.is_object()) add_grammar_faults(generator, params, pointer, limits, faults);
  return params;
}

/// A child on its way to a model: what it is made by, and where its faults belong.
struct Call {
  const Generator* generator;
  Generator::Params params;
  std::string pointer;
  Job job;

  Call(const Child& child, const std::string& at, Rng place, const Job& around)
      : generator(find_generator(child.generator)),
        pointer(at + "/parameters"),
        job(around.for_child(child.seed.value_or(place.key()))) {
    Faults faults;
    params = generator->read(Json::parse(child.parameters), "", faults, {});
    assert(faults.empty());  // read_parameters has seen them
  }

  /// What `work` gives, its faults pointing to the child.
  template <class T, class Work>
  Result<T> run(const Work& work) {
    try {
      Result<T> result = work(params, job);
      if (result) return result;
      Error error = std::move(result).error();
      for (Issue& issue : error.issues) issue.pointer.insert(0, pointer);
      return error;
    } catch (const Stop& stop) {  // the same stop, told of where it belongs
      Issue issue = stop.issue();
      if (!issue.pointer.empty()) issue.pointer.insert(0, pointer);
      throw Stop(stop.code(), std::move(issue));
    }
  }

  void point(std::vector<Warning>& warnings) const {
    for (Warning& warning : warnings) warning.pointer.insert(0, pointer);
  }
};

}  // namespace

Generator::Params read_parameters(const Generator& generator, const Json& json, const std::string& pointer,
                                  const Limits& limits, Faults& faults) {
  return read_at_depth(generator, json, pointer, limits, faults, 0);
}

Result<Model> generate_child(const Child& child, const std::string& pointer, Rng place, const Job& job,
                             const Demand& demand) {
  Call call(child, pointer, place, job);
  Demand own = demand;
  own.tangents = false;  // whoever has the whole makes those of all meshes that stay
  call.job.set_demand(own);
  Result<Model> model = call.run<Model>(call.generator->generate);
  if (!model) return model;
  widen(*model, job);
  call.point(model->warnings);
  return model;
}

Result<Appraisal> appraise_child(const Child& child, const std::string& pointer, Rng place, const Job& job) {
  Call call(child, pointer, place, job);
  Result<Appraisal> appraisal = call.run<Appraisal>(call.generator->appraise);
  if (appraisal) call.point(appraisal->warnings);
  return appraisal;
}

std::string unknown_generator(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Generator& generator : generators()) names.push_back(generator.name);
  std::string message = schema::unknown_word("generator", name, names);
  if (!message.ends_with('?')) {
    message += "; there are ";
    for (std::size_t i = 0; i < names.size(); ++i) message.append(i > 0 ? ", " : "").append(names[i]);
  }
  return message;
}

}  // namespace seedmesh
