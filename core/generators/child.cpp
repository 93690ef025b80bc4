#include "core/generators/child.h"

#include <algorithm>
#include <cassert>
#include <nlohmann/json.hpp>

#include "core/model/index_width.h"
#include "core/schema/nearest.h"

namespace seedmesh {
namespace {

/// Where the reading of a request has come to.
struct Reading {
  const CheckContext& context;
  IssueList& errors;
  int depth;
};

Generator::Params read_at(const Generator& generator, const Json& json, const std::string& pointer,
                          const Reading& reading);

/// Reads the parameters of a child and replaces them by their canonical form.
void read_child(Child& child, const std::string& pointer, const Reading& reading) {
  auto& [context, errors, depth] = reading;
  if (child.generator.empty() || errors.covers(pointer)) return;
  if (depth > deepest_child) {
    errors.add(limit_issue({Resource::depth, deepest_child, static_cast<std::uint64_t>(depth)},
                           "found a request inside " + std::to_string(depth) + " others, expected at most " +
                               std::to_string(deepest_child),
                           pointer));
    return;
  }
  const Generator* generator = find_generator(context.generators, child.generator);
  if (!generator) {
    errors.add({IssueKind::unknown_name, pointer + "/generator",
                unknown_generator(context.generators, child.generator)});
    return;
  }
  const Json json = Json::parse(child.parameters);
  const Generator::Params params = read_at(*generator, json, pointer + "/parameters", reading);
  child.parameters = canonical_text(generator->write(params));
}

/// Whether the schema has refused `member` of `object`, or what holds it, or a name that is nearly the same.
bool is_refused(const std::string& object, const std::string& member, const IssueList& errors) {
  const std::string pointer = object + "/" + member;
  if (errors.covers(pointer)) return true;
  const std::size_t start = pointer.rfind('/') + 1;
  const std::string_view name = std::string_view(pointer).substr(start);
  return std::ranges::any_of(errors.issues(), [&](const Issue& refused) {
    const std::string_view at = refused.pointer;
    return refused.kind == IssueKind::unknown_key && at.rfind('/') + 1 == start &&
           pointer.starts_with(at.substr(0, start)) &&
           !schema::nearest_word(at.substr(start), {&name, 1}).empty();
  });
}

/// Whether an error exists only because of the default of another member: the schema has refused the value of that
/// member, or its name is spelled wrongly.
bool is_about_default(const Issue& issue, const IssueList& errors) {
  if (errors.empty() || issue.members.empty()) return false;
  std::string object = issue.pointer;
  while (true) {
    const auto refused = [&](const std::string& member) { return is_refused(object, member, errors); };
    if (std::ranges::any_of(issue.members, refused)) return true;
    const std::size_t end = object.rfind('/');
    if (end == std::string::npos) return false;
    object.resize(end);
  }
}

/// Adds the errors of check(), but not where the schema has refused a value already.
void add_checked(std::vector<Issue> found, const std::string& pointer, IssueList& errors) {
  for (Issue& issue : found) issue.pointer.insert(0, pointer);
  std::erase_if(found, [&errors](const Issue& issue) {
    return errors.covers(issue.pointer) || is_about_default(issue, errors);
  });
  for (Issue& issue : found) errors.add(std::move(issue));
}

Generator::Params read_at(const Generator& generator, const Json& json, const std::string& pointer,
                          const Reading& reading) {
  const Generator::VisitChild visit = [&](const ChildLocation& place) {
    read_child(*place.child, pointer + place.pointer, {reading.context, reading.errors, reading.depth + 1});
  };
  Generator::Params params = generator.read(json, pointer, reading.errors, visit);
  reading.context.job.check();
  if (json.is_object()) add_checked(generator.check(params, reading.context), pointer, reading.errors);
  return params;
}

/// The making of a child's model.
struct Call {
  const Generator* generator;
  Generator::Params params;
  std::string pointer;
  Job job;

  Call(const Child& child, const std::string& at, Rng stream, const GenerateContext& around)
      : generator(find_generator(around.generators, child.generator)),
        pointer(at + "/parameters"),
        job(around.job.for_child(child.seed.value_or(stream.key()), at + "/parameters")) {
    IssueList errors;
    params = generator->read(Json::parse(child.parameters), "", errors, {});
    assert(errors.empty());  // read_parameters() has reported them
  }

  /// The result of `work`; pointers of its errors lead to the child.
  template <class T, class Work>
  Result<T> run(const Work& work, const GenerateContext& context) {
    Result<T> result = work(params, context);
    if (result) return result;
    Error error = std::move(result).error();
    for (Issue& issue : error.issues) issue.pointer.insert(0, pointer);
    return error;
  }

  void prefix_pointers(std::vector<Warning>& warnings) const {
    for (Warning& warning : warnings) warning.pointer.insert(0, pointer);
  }
};

}  // namespace

const Generator* find_generator(GeneratorList generators, std::string_view name) {
  const auto found = std::ranges::find(generators, name, &Generator::name);
  return found == generators.end() ? nullptr : &*found;
}

Generator::Params read_parameters(const Generator& generator, const Json& json, const std::string& pointer,
                                  const CheckContext& context, IssueList& errors) {
  return read_at(generator, json, pointer, {context, errors, 0});
}

Result<Model> generate_child(const Child& child, const std::string& pointer, Rng stream,
                             const GenerateContext& around, const Demand& demand) {
  return generate_prepared(child, pointer, stream, around, demand, nullptr);
}

Result<Model> generate_prepared(const Child& child, const std::string& pointer, Rng stream,
                                const GenerateContext& around, const Demand& demand,
                                Generator::Prepared prepared) {
  Call call(child, pointer, stream, around);
  Demand own = demand;
  own.tangents = false;
  Result<Model> model =
      call.run<Model>(call.generator->generate, {call.job, own, around.generators, std::move(prepared)});
  if (!model) return model;
  widen(*model, around.job);
  call.prefix_pointers(model->warnings);
  return model;
}

Generator::Prepared prepare_child(const Child& child, const GenerateContext& around) {
  const Generator* generator = find_generator(around.generators, child.generator);
  if (!generator || !generator->prepare) return nullptr;
  IssueList errors;
  const Generator::Params params = generator->read(Json::parse(child.parameters), "", errors, {});
  return generator->prepare(params, {around.job, around.generators});
}

Result<Json> derive_child(const Child& child, const std::string& pointer, Rng stream,
                          const GenerateContext& around) {
  Call call(child, pointer, stream, around);
  return call.run<Json>(call.generator->derive, {call.job, {}, around.generators});
}

Result<Appraisal> appraise_child(const Child& child, const std::string& pointer, Rng stream,
                                 const GenerateContext& around) {
  Call call(child, pointer, stream, around);
  const Demand demand{.two_sided_leaves = around.demand.two_sided_leaves,
                      .wind = around.demand.wind,
                      .textures = around.demand.textures,
                      .tangents = around.demand.tangents};
  Result<Appraisal> appraisal =
      call.run<Appraisal>(call.generator->appraise, {call.job, demand, around.generators});
  if (appraisal) call.prefix_pointers(appraisal->warnings);
  return appraisal;
}

std::string unknown_generator(GeneratorList generators, std::string_view name) {
  std::vector<std::string_view> names;
  for (const Generator& generator : generators) names.push_back(generator.name);
  return schema::unknown_word_of_few("generator", name, names);
}

}  // namespace seedmesh
