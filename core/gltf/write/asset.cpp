#include "core/gltf/write/asset.h"

namespace seedmesh::gltf {
namespace {

void append_members(JsonWriter& json, const std::vector<Extra>& extras) {
  for (const Extra& extra : extras) {
    json.key(extra.name);
    json.json(extra.json);
  }
}

void append_warning(JsonWriter& json, const Warning& warning) {
  json.object([&] {
    json.member("pointer", warning.pointer);
    json.member("message", warning.message);
    if (warning.line > 0) json.member("line", warning.line);
    if (warning.column > 0) json.member("column", warning.column);
  });
}

}  // namespace

void append_asset(JsonWriter& json, const Model& model, const std::string& generator) {
  json.object("asset", [&] {
    if (!model.extras.empty() || !model.warnings.empty()) {
      json.object("extras", [&] {
        append_members(json, model.extras);
        if (model.warnings.empty()) return;
        json.array("warnings", [&] {
          for (const Warning& warning : model.warnings) append_warning(json, warning);
        });
      });
    }
    if (!generator.empty()) json.member("generator", generator);
    json.member("version", "2.0");
  });
}

void append_extras(JsonWriter& json, const std::vector<Extra>& extras) {
  if (extras.empty()) return;
  json.object("extras", [&] { append_members(json, extras); });
}

void append_extensions(JsonWriter& json, const std::vector<std::string>& variants,
                       const std::vector<int>& shapes) {
  if (variants.empty() && shapes.empty()) return;
  json.object("extensions", [&] {
    if (!variants.empty()) {
      json.object("KHR_materials_variants", [&] {
        json.array("variants", [&] {
          for (const std::string& name : variants) {
            json.object([&] { json.member("name", name); });
          }
        });
      });
    }
    if (shapes.empty()) return;
    json.object("OMI_physics_shape", [&] {
      json.array("shapes", [&] {
        for (const int mesh : shapes) {
          json.object([&] {
            json.object("convex", [&] { json.member("mesh", mesh); });
            json.member("type", "convex");
          });
        }
      });
    });
  });
}

}  // namespace seedmesh::gltf
