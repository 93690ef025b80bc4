#pragma once
/// Helpers for grammars: words as text, errors as text.
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/generators/lsystem/context_free_derivation.h"
#include "core/generators/lsystem/lsystem.h"
#include "core/generators/lsystem/text.h"
#include "core/generators/lsystem/word.h"
#include "generated/params/lsystem.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {

inline LsystemParams grammar_of(std::string axiom, std::vector<std::string> productions, int iterations = 1) {
  LsystemParams params;
  params.axiom = std::move(axiom);
  params.productions = std::move(productions);
  params.iterations = iterations;
  return params;
}

/// Returns the errors of the texts, as "pointer line:column message".
inline std::vector<std::string> errors_of(const LsystemParams& params) {
  std::vector<std::string> texts;
  for (const Issue& issue : check(params, Limits{})) {
    texts.push_back(issue.pointer + " " + std::to_string(issue.line) + ":" + std::to_string(issue.column) +
                    " " + issue.message);
  }
  return texts;
}

inline Job job_of(std::uint64_t seed, Limits limits = {}) {
  Job::Options options;
  options.limits = limits;
  return Job(seed, options);
}

/// Returns the last word, derived by the method that the engine chooses.
inline std::string derived(const LsystemParams& params, std::uint64_t seed = 0) {
  Job job = job_of(seed);
  const Result<Json> answer = derive(params, context_of(job));
  return answer ? answer->at("string").get<std::string>() : "refused: " + answer.error().issues[0].message;
}

/// Returns the same word, derived by rewriting whole words.
inline std::string derived_as_word(const LsystemParams& params, std::uint64_t seed = 0) {
  Job job = job_of(seed);
  std::vector<Issue> issues;
  const Grammar grammar = compile(params, seed, Limits{}, issues);
  const Word word = derive_word(grammar, static_cast<std::uint32_t>(params.iterations), true, job);
  TextWriter writer(grammar, std::size_t{1} << 26U);
  for (std::size_t i = 0; i < word.size(); ++i) {
    writer.module(word.kind[i], word.at.empty() ? nullptr : word.parameter.data() + word.at[i]);
  }
  return writer.text;
}

}  // namespace seedmesh::lsystem
