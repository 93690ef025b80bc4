#pragma once
/// Foreign texts and what becomes of them.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/pipeline.h"

namespace seedmesh {

inline Result<ImportedRequest> imported(std::string_view format, std::string_view text,
                                        std::string_view entry = "") {
  return import_request({format, entry, text}, Limits{});
}

/// The parameters of the request; null where it was refused.
inline nlohmann::json parameters_of(const Result<ImportedRequest>& result) {
  if (!result) return nullptr;
  return nlohmann::json::parse(result->request.canonical()).at("parameters");
}

/// The word that the request derives.
inline std::string derived(const Result<ImportedRequest>& result) {
  if (!result) return "refused: " + result.error().issues[0].message;
  const Result<std::string> answer = derive(result->request, {});
  if (!answer) return "refused: " + answer.error().issues[0].message;
  return nlohmann::json::parse(*answer).at("string").get<std::string>();
}

/// "line:column message" of every fault, or of every warning where there is none.
inline std::vector<std::string> reports(const Result<ImportedRequest>& result) {
  std::vector<std::string> texts;
  const auto tell = [&](const auto& each) {
    texts.push_back(std::to_string(each.line) + ":" + std::to_string(each.column) + " " + each.message);
  };
  if (!result) {
    for (const Issue& issue : result.error().issues) tell(issue);
  } else {
    for (const Warning& warning : result->warnings) tell(warning);
  }
  return texts;
}

}  // namespace seedmesh
