/// Writes requests as files of other programs. What such a file cannot state is found by reading it again.
#include <nlohmann/json.hpp>

#include "core/import/proctree_file.h"
#include "core/pipeline.h"
#include "core/schema/json.h"

namespace seedmesh {

Result<ExportedFile> export_request(const Request& request, std::string_view format,
                                    const Job::Options& options) {
  if (format != "proctree" && format != "proctree_js") {
    return Error{Code::invalid,
                 {{IssueKind::unknown_name, "/to",
                   "found `" + shortened(std::string(format), 40) +
                       "`; requests can be saved for proctree and proctree_js"}}};
  }
  const Json whole = Json::parse(request.canonical());
  const Json parameters = whole.value("parameters", Json::object());
  if (request.generator() != "tree" || parameters.value("model", "weber_penn") != "proctree") {
    return Error{Code::invalid,
                 {{IssueKind::not_available, "/parameters/model",
                   "only trees of the model proctree can be saved for proctree"}}};
  }
  IssueList issues;
  const TreeParams params = read_tree(parameters, "", issues);
  const auto names = format == "proctree" ? ProctreeNames::translation : ProctreeNames::original;
  ExportedFile file{proctree_file(params, names), {}};
  const Result<ImportedRequest> again = import_request({"proctree", "", file.text}, options);
  if (!again) return again.error();
  const Json kept = Json::parse(again->request.canonical()).value("parameters", Json::object());
  if (parameters.value("sequence", "") != "original") {
    file.warnings.push_back(
        {"/parameters/sequence",
         "proctree has its own random numbers; only with the sequence original is its tree the same", 0, 0});
  }
  for (const auto& [name, value] : parameters.items()) {
    if (name == "sequence" || name == "mSeed" || (kept.contains(name) && kept.at(name) == value)) continue;
    file.warnings.push_back({"/parameters/" + name, "has no counterpart in proctree", 0, 0});
  }
  return file;
}

}  // namespace seedmesh
