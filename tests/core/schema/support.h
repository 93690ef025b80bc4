#pragma once
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/schema/issue_list.h"
#include "core/schema/json.h"

namespace seedmesh {

/// Parameters with what was found wrong on the way.
template <class Params>
struct Reading {
  Params params;
  std::vector<Issue> issues;

  std::vector<std::string> pointers() const {
    std::vector<std::string> all;
    for (const Issue& issue : issues) all.push_back(issue.pointer);
    return all;
  }
};

/// reading<read_lsystem>(R"({"axiom":"F"})")
template <auto read>
auto reading(std::string_view text) {
  IssueList faults;
  auto params = read(Json::parse(text), "", faults);
  return Reading<decltype(params)>{std::move(params), faults.take()};
}

}  // namespace seedmesh
