#include "server/docs_page.h"

#include <nlohmann/json.hpp>

#include "core/pipeline.h"
#include "server/html_text.h"
#include "server/problem.h"

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* style = R"(
body{font:16px/1.5 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#1c2420;background:#fff}
h2{margin-top:2.5rem;border-bottom:1px solid #ccd5cf} h3 code{font-size:1.1em}
code,pre{font-family:ui-monospace,monospace;font-size:.9em;background:#f1f5f2;border-radius:3px}
code{padding:.1em .3em} pre{padding:.7rem;overflow:auto} table{border-collapse:collapse;width:100%}
td,th{text-align:left;vertical-align:top;padding:.3rem .6rem;border-bottom:1px solid #e2e8e4}
.method{color:#fff;background:#2c6e49;padding:.1em .5em;border-radius:3px} nav a{margin-right:1rem}
@media(prefers-color-scheme:dark){body{background:#141a17;color:#dde5e0} code,pre{background:#222b26}
td,th,h2{border-color:#38443d} a{color:#8fd0a8}}
)";

std::string text_at(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? html_text(found->get<std::string>()) : "";
}

std::string code(const Json& value) {
  return "<code>" + html_text(value.is_string() ? value.get<std::string>() : value.dump()) + "</code>";
}

/// A link to the table of a schema on this page, or the name of what a reference refers to.
std::string reference(const std::string& target) {
  const std::string served = "/v1/schemas/";
  if (target.compare(0, served.size(), served) == 0) {
    const std::string name = html_text(target.substr(served.size(), target.find('#') - served.size()));
    return "<a href=\"#schema-" + name + "\">" + name + "</a>";
  }
  const auto slash = target.rfind('/');
  return "<code>" + html_text(slash == std::string::npos ? target : target.substr(slash + 1)) + "</code>";
}

std::string type_of(const Json& schema) {
  if (const auto target = schema.find("$ref"); target != schema.end())
    return reference(target->get<std::string>());
  if (const auto choices = schema.find("enum"); choices != schema.end()) {
    std::string all;
    for (const Json& choice : *choices) all += (all.empty() ? "" : ", ") + code(choice);
    return all;
  }
  if (const auto fixed = schema.find("const"); fixed != schema.end()) return code(*fixed);
  for (const char* key : {"oneOf", "anyOf"}) {
    const auto forms = schema.find(key);
    if (forms == schema.end()) continue;
    std::string all;
    for (const Json& form : *forms) all += (all.empty() ? "" : " or ") + type_of(form);
    return all;
  }
  const auto type = schema.find("type");
  if (type == schema.end()) return "any";
  std::string name = type->is_string() ? html_text(type->get<std::string>()) : code(*type);
  if (const auto items = schema.find("items"); items != schema.end() && items->is_object())
    name += " of " + type_of(*items);
  return name;
}

std::string range_of(const Json& schema) {
  std::string range;
  const auto low = schema.find("minimum"), high = schema.find("maximum");
  if (low != schema.end()) range += "from " + low->dump() + " ";
  if (high != schema.end()) range += "to " + high->dump() + " ";
  return range + text_at(schema, "x-unit");
}

/// Adds a row for each property of an object; those of a nested object follow it.
void add_properties(std::string& out, const Json& schema, const std::string& prefix, int depth) {
  const auto properties = schema.find("properties");
  if (properties == schema.end() || depth > 4) return;
  for (const auto& [name, property] : properties->items()) {
    const auto fallback = property.find("default");
    out += "<tr><td><code>" + html_text(prefix + name) + "</code></td><td>" + type_of(property) +
           "</td><td>" + (fallback == property.end() ? "" : code(*fallback)) + "</td><td>" +
           range_of(property) + "</td><td>" + text_at(property, "description") + "</td></tr>\n";
    add_properties(out, property, prefix + name + ".", depth + 1);
  }
}

void add_schema(std::string& out, const std::string& name, const Json& schema) {
  out += "<h3 id=\"schema-" + html_text(name) + "\">" + html_text(name) + "</h3>\n<p>" +
         text_at(schema, "description") + " <a href=\"/v1/schemas/" + html_text(name) +
         "\">JSON Schema</a></p>\n";
  std::string rows;
  add_properties(rows, schema, "", 0);
  if (rows.empty()) return;
  out += "<table><tr><th>Name</th><th>Type</th><th>Default</th><th>Range</th><th>Meaning</th></tr>\n" + rows +
         "</table>\n";
}

/// Follows one reference "#/a/b" inside the document.
const Json& resolved(const Json& document, const Json& object) {
  const auto target = object.find("$ref");
  if (target == object.end() || !target->is_string()) return object;
  const std::string text = target->get<std::string>();
  if (text.compare(0, 2, "#/") != 0) return object;
  const Json::json_pointer pointer(text.substr(1));
  return document.contains(pointer) ? document.at(pointer) : object;
}

void add_parameters(std::string& out, const Json& document, const Json& holder) {
  const auto parameters = holder.find("parameters");
  if (parameters == holder.end() || parameters->empty()) return;
  out += "<table><tr><th>Parameter</th><th>In</th><th>Type</th><th>Meaning</th></tr>\n";
  for (const Json& given : *parameters) {
    const Json& parameter = resolved(document, given);
    const Json schema = parameter.value("schema", Json::object());
    out += "<tr><td><code>" + text_at(parameter, "name") + "</code></td><td>" + text_at(parameter, "in") +
           "</td><td>" + type_of(schema) + "</td><td>" + text_at(parameter, "description") + "</td></tr>\n";
  }
  out += "</table>\n";
}

void add_contents(std::string& out, const char* label, const Json& holder) {
  const auto content = holder.find("content");
  if (content == holder.end()) return;
  for (const auto& [type, form] : content->items()) {
    const Json schema = form.value("schema", Json());
    out += std::string(out.empty() ? "" : " ") + label + "<code>" + html_text(type) + "</code>" +
           (schema.is_object() && !schema.empty() ? " " + type_of(schema) : "");
  }
}

void add_operation(std::string& out, const Json& document, const std::string& method, const Json& operation) {
  out += "<p>" + text_at(operation, "summary") + "</p>\n<p>" + text_at(operation, "description") + "</p>\n";
  add_parameters(out, document, operation);
  if (const auto body = operation.find("requestBody"); body != operation.end()) {
    std::string forms;
    add_contents(forms, "", resolved(document, *body));
    out += "<p>Body of the " + html_text(method) + ": " + forms + "</p>\n";
  }
  const auto responses = operation.find("responses");
  if (responses == operation.end()) return;
  out += "<table><tr><th>Status</th><th>Meaning</th><th>Body</th></tr>\n";
  for (const auto& [status, given] : responses->items()) {
    const Json& response = resolved(document, given);
    std::string forms;
    add_contents(forms, "", response);
    out += "<tr><td>" + html_text(status) + "</td><td>" + text_at(response, "description") + "</td><td>" +
           forms + "</td></tr>\n";
  }
  out += "</table>\n";
}

void add_paths(std::string& out, const Json& document) {
  const auto paths = document.find("paths");
  if (paths == document.end()) return;
  for (const auto& [path, item] : paths->items()) {
    for (const char* method : {"get", "post"}) {
      const auto operation = item.find(method);
      if (operation == item.end()) continue;
      const std::string shown = std::string(method) == "get" ? "GET" : "POST";
      out += "<h3><span class=\"method\">" + shown + "</span> <code>" + html_text(path) + "</code></h3>\n";
      add_parameters(out, document, item);
      add_operation(out, document, shown, *operation);
    }
  }
}

void add_problems(std::string& out) {
  out +=
      "<p>An error response is <code>application/problem+json</code> (RFC 9457). Its <code>type</code> links "
      "to a "
      "row of this table. <code>errors</code> lists every error with a JSON Pointer, and with line and "
      "column "
      "inside a grammar.</p>\n"
      "<table><tr><th>Status</th><th>Type ends with</th><th>Title</th></tr>\n";
  for (const ProblemKind& kind : problem_kinds()) {
    out += "<tr id=\"" + std::string(kind.word) + "\"><td>" + std::to_string(kind.status) +
           "</td><td><code>" + std::string(kind.word) + "</code></td><td>" + std::string(kind.title) +
           "</td></tr>\n";
  }
  out += "</table>\n";
}

}  // namespace

std::string docs_page() {
  const Json document = Json::parse(openapi_json());
  const Json info = document.value("info", Json::object());
  std::string out =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>Seedmesh reference</title><style>";
  out += style;
  out +=
      "</style></head><body>\n<h1>Seedmesh " + html_text(program_version()) + "</h1>\n<p>" +
      text_at(info, "description") +
      "</p>\n<nav><a href=\"/\">Start page</a><a href=\"#routes\">Routes</a><a href=\"#schemas\">Schemas</a>"
      "<a href=\"#problems\">Problems</a><a href=\"/openapi.json\">OpenAPI</a><a "
      "href=\"/v1/vocabulary\">Vocabulary</a></nav>\n"
      "<h2 id=\"routes\">Routes</h2>\n";
  add_paths(out, document);
  out += "<h2 id=\"schemas\">Schemas</h2>\n";
  for (const std::string_view name : schema_names()) {
    if (const auto text = schema_json(name)) add_schema(out, std::string(name), Json::parse(*text));
  }
  out += "<h2 id=\"problems\">Problems</h2>\n";
  add_problems(out);
  return out + "</body></html>\n";
}

}  // namespace seedmesh
