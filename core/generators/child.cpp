#include "core/generators/child.h"

#include <algorithm>
#include <cassert>
#include <iterator>
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

/// The words of a message that can be names.
std::vector<std::string_view> names_in(std::string_view message) {
  const auto is_part = [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  std::vector<std::string_view> names;
  while (!message.empty()) {
    const auto begin = std::ranges::find_if(message, is_part);
    const auto end = std::find_if_not(begin, message.end(), is_part);
    if (begin != end) names.emplace_back(&*begin, static_cast<std::size_t>(end - begin));
    message.remove_prefix(static_cast<std::size_t>(end - message.begin()));
  }
  return names;
}

/// Whether an error is a conflict with the default of a member beside it: the schema has refused the value of that
/// member, or its name is spelled wrongly. A missing member that only the default of a refused one needs counts too.
bool is_conflict_with_default(const Issue& issue, const IssueList& errors) {
  constexpr std::size_t shortest = 5;  // shorter names are similar to too many words
  const bool is_missing = issue.kind == IssueKind::missing;
  if ((issue.kind != IssueKind::conflict && !is_missing) || errors.empty()) return false;
  const std::string object =
      is_missing ? issue.pointer + "/" : issue.pointer.substr(0, issue.pointer.rfind('/') + 1);
  const std::vector<std::string_view> names = names_in(issue.message);
  std::vector<std::string_view> long_names;
  std::ranges::copy_if(names, std::back_inserter(long_names),
                       [](auto name) { return name.size() >= shortest; });
  return std::ranges::any_of(errors.issues(), [&](const Issue& refused) {
    const std::string_view at = refused.pointer;
    if (!at.starts_with(object) || at.find('/', object.size()) != std::string_view::npos) return false;
    const std::string_view member = at.substr(object.size());
    return std::ranges::find(names, member) != names.end() ||
           (!is_missing && member.size() >= shortest && !schema::nearest_word(member, long_names).empty());
  });
}

/// Adds the errors of check(), but not where the schema has refused a value already.
void add_checked(std::vector<Issue> found, const std::string& pointer, IssueList& errors) {
  for (Issue& issue : found) issue.pointer.insert(0, pointer);
  std::erase_if(found, [&errors](const Issue& issue) {
    return errors.covers(issue.pointer) || is_conflict_with_default(issue, errors);
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
  Result<Appraisal> appraisal =
      call.run<Appraisal>(call.generator->appraise, {call.job, {}, around.generators});
  if (appraisal) call.prefix_pointers(appraisal->warnings);
  return appraisal;
}

std::string unknown_generator(GeneratorList generators, std::string_view name) {
  std::vector<std::string_view> names;
  for (const Generator& generator : generators) names.push_back(generator.name);
  return schema::unknown_word_of_few("generator", name, names);
}

}  // namespace seedmesh
