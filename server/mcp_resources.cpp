/// Resources: presets, schemas, vocabulary and the pages of the documentation.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/mcp.h"
#include "server/pages.h"

namespace seedmesh::mcp {
namespace {

constexpr std::string_view scheme = "seedmesh://";

Json resource(std::string uri, std::string name, std::string text, std::string_view type) {
  return {{"uri", std::move(uri)},
          {"name", std::move(name)},
          {"description", std::move(text)},
          {"mimeType", type}};
}

/// The page without its ending: "/lsystem.md" -> "lsystem".
std::string page_name(std::string_view path) { return std::string(path.substr(1, path.size() - 4)); }

std::string first_heading(std::string_view page) {
  if (page.starts_with("# ")) page.remove_prefix(2);
  return std::string(page.substr(0, page.find('\n')));
}

/// The text behind an address and its type; nothing where there is none.
std::optional<std::pair<std::string, std::string>> text_of(const Context& context, std::string_view uri) {
  if (!uri.starts_with(scheme)) return std::nullopt;
  const std::string_view path = uri.substr(scheme.size());
  const std::string name(path.substr(std::min(path.find('/'), path.size() - 1) + 1));
  if (path == "presets") {
    const PresetQuery all{.query = {}, .generator = {}, .tag = {}, .limit = presets().size()};
    return {{find_presets(context.call.service.access, all).dump(), "application/json"}};
  }
  if (path == "vocabulary") return {{vocabulary_json(), "application/json"}};
  if (path.starts_with("presets/")) {
    if (auto text = preset_json(name)) return {{*std::move(text), "application/json"}};
  } else if (path.starts_with("schemas/")) {
    if (const auto text = schema_json(name)) return {{std::string(*text), "application/schema+json"}};
  } else if (path.starts_with("docs/")) {
    for (const Asset& page : embedded_docs()) {
      if (page_name(page.path) == name) return {{std::string(page.bytes), "text/markdown"}};
    }
  }
  return std::nullopt;
}

}  // namespace

RpcResult list_resources(Context&, const Json&) {
  Json list = Json::array();
  list.push_back(resource("seedmesh://presets", "presets", "All presets with title, description and tags.",
                          "application/json"));
  list.push_back(resource("seedmesh://vocabulary", "vocabulary",
                          "Turtle symbols, operations of buildings and functions of expressions.",
                          "application/json"));
  for (const std::string_view name : schema_names()) {
    list.push_back(resource("seedmesh://schemas/" + std::string(name), std::string(name) + " schema",
                            "JSON Schema of " + std::string(name) + ".", "application/schema+json"));
  }
  for (const Asset& page : embedded_docs()) {
    const std::string name = page_name(page.path);
    list.push_back(resource("seedmesh://docs/" + name, name, first_heading(page.bytes), "text/markdown"));
  }
  return Json{{"resources", std::move(list)}};
}

RpcResult list_templates(Context&, const Json&) {
  const auto row = [](const char* uri, const char* name, const char* text, const char* type) {
    return Json{{"uriTemplate", uri}, {"name", name}, {"description", text}, {"mimeType", type}};
  };
  return Json{
      {"resourceTemplates",
       {row("seedmesh://presets/{name}", "preset", "The whole request of a preset.", "application/json"),
        row("seedmesh://schemas/{name}", "schema", "The JSON Schema of a generator.",
            "application/schema+json"),
        row("seedmesh://docs/{page}", "page", "A page of the documentation.", "text/markdown")}}};
}

RpcResult read_resource(Context& context, const Json& parameters) {
  const std::string uri = text_in(parameters, "uri");
  auto found = text_of(context, uri);
  if (!found) {
    const bool is_old = context.protocol_mode == ProtocolMode::handshake;
    return Failure{is_old ? Code::unknown_resource_of_handshake : Code::wrong_parameters,
                   "There is no resource \"" + uri.substr(0, 200) + "\".",
                   Json{{"uri", uri}}.dump(-1, ' ', false, Json::error_handler_t::replace)};
  }
  Json row = {{"uri", uri}, {"mimeType", found->second}, {"text", std::move(found->first)}};
  return Json{{"contents", Json::array({std::move(row)})}};
}

}  // namespace seedmesh::mcp
