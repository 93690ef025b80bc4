#include "core/generators/building/materials.h"

#include <algorithm>
#include <array>

#include "core/generators/building/parts/parts.h"
#include "core/generators/material_members.h"
#include "core/schema/color.h"
#include "core/texture/data_uri.h"
#include "core/texture/file_size.h"
#include "generated/params/building.h"

namespace seedmesh::building {
namespace {

struct MaterialPreset {
  std::string_view name;
  Color color;
  double roughness, metallic, opacity;
};

// Weathered colours: nothing on a street is pure white or saturated.
constexpr MaterialPreset presets[] = {
    {"plaster", {222, 214, 200}, 0.95, 0, 1},  {"wall", {214, 203, 184}, 0.95, 0, 1},
    {"facade", {214, 203, 184}, 0.95, 0, 1},   {"brick", {150, 82, 64}, 0.95, 0, 1},
    {"stone", {176, 170, 158}, 0.9, 0, 1},     {"concrete", {158, 157, 152}, 0.9, 0, 1},
    {"marble", {228, 226, 220}, 0.5, 0, 1},    {"wood", {122, 84, 54}, 0.8, 0, 1},
    {"door", {94, 62, 42}, 0.7, 0, 1},         {"glass", {44, 50, 54}, 0.06, 0, 1},
    {"window", {44, 50, 54}, 0.06, 0, 1},      {"frame", {222, 219, 210}, 0.7, 0, 1},
    {"metal", {134, 138, 142}, 0.4, 1, 1},     {"steel", {134, 138, 142}, 0.4, 1, 1},
    {"copper", {104, 152, 132}, 0.6, 0, 1},    {"gold", {212, 168, 74}, 0.35, 1, 1},
    {"roof", {142, 74, 58}, 0.9, 0, 1},        {"roof_tile", {142, 74, 58}, 0.9, 0, 1},
    {"slate", {82, 88, 96}, 0.8, 0, 1},        {"zinc", {146, 152, 158}, 0.5, 0, 1},
    {"tar", {70, 70, 72}, 0.95, 0, 1},         {"ledge", {196, 188, 174}, 0.9, 0, 1},
    {"column", {206, 200, 188}, 0.85, 0, 1},   {"floor", {168, 160, 148}, 0.9, 0, 1},
    {"chimney", {132, 72, 58}, 0.95, 0, 1},    {"grass", {98, 128, 70}, 1, 0, 1},
    {"pavement", {150, 148, 144}, 0.95, 0, 1}, {"ground", {132, 120, 102}, 1, 0, 1},
    {"building", {222, 214, 200}, 0.95, 0, 1}, {"glass_room", {44, 50, 54}, 0.06, 0, 1},
};

// Two panes with a coating reflect about an eighth of the light that meets them straight on: three times as much as one
// surface of glass.
constexpr glm::vec3 reflection_of_panes{3};

// What shows behind the glass of windows, and dirt on walls. Their colours do not follow those of the request.
constexpr std::string_view rooms_surface = "rooms", grime_surface = "grime";

/// The kind of surface that materials of a name have.
struct Surface {
  std::string_view material, kind;
};
constexpr Surface surfaces[] = {
    {"brick", "brick"},
    {"plaster", "plaster"},
    {"wall", "plaster"},
    {"facade", "plaster"},
    {"stone", "ashlar"},
    {"concrete", "concrete"},
    {"wood", "planks"},
    {"roof", "roof_tile"},
    {"slate", "slate"},
    {"roof_tile", "roof_tile"},
    {"cladding", "sheet"},
    {"chimney", "brick"},
    {"building", "plaster"},
    {"dressed_stone", "dressed_stone"},
    {"painted", "paint"},
    {"panels", "panels"},
    {"joinery", "joinery"},
    {"glass_room", "rooms"},
    {"grime", grime_surface},
    {"brick_bay", "brick_bay"},
    {"plaster_bay", "plaster_bay"},
    {"wood_bay", "planks_bay"},
    {"stone_bay", "ashlar_bay"},
};

// Parts of blueprints: doors and frames are painted wood, and what has a colour of its own is one piece of stone.
constexpr Surface part_surfaces[] = {
    {"door", "joinery"}, {"frame", "paint"},       {"color", "dressed_stone"}, {"stone", "ashlar"},
    {"brick", "brick"},  {"wall", "plaster"},      {"roof", "roof_tile"},      {"concrete", "concrete"},
    {"wood", "planks"},  {"glass", rooms_surface},
};
// Flat bodies of blueprints with a colour alone.
constexpr std::string_view painted_surface = "plaster";

const texture::WallKind* surface_of_part(std::string_view role) {
  const auto* const found =
      std::ranges::find(part_surfaces, role.substr(0, role.find('_')), &Surface::material);
  return found == std::end(part_surfaces) ? nullptr : texture::wall_kind(found->kind);
}

const texture::WallKind* surface_named(std::string_view material) {
  const auto* const found = std::ranges::find(surfaces, material, &Surface::material);
  return found == std::end(surfaces) ? nullptr : texture::wall_kind(found->kind);
}

/// Whether a surface is one of walls, not of roofs, joinery or trim.
bool is_wall(std::string_view material) {
  constexpr std::array<std::string_view, 7> others = {"roof_tile", "slate", "paint",      "dressed_stone",
                                                      "joinery",   "rooms", grime_surface};
  const texture::WallKind* const kind = surface_named(material);
  return kind != nullptr && std::ranges::find(others, kind->name) == others.end();
}

const MaterialPreset* find_preset(std::string_view name) {
  const auto* const found = std::ranges::find(presets, name, &MaterialPreset::name);
  return found == std::end(presets) ? nullptr : found;
}

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::string name_of_color(const std::string& color) { return "color_" + lower(color.substr(1)); }

}  // namespace

std::vector<std::string_view> built_in_materials() {
  std::vector<std::string_view> names;
  for (const MaterialPreset& preset : presets) names.push_back(preset.name);
  return names;
}

void check_materials(const BuildingParams& params, std::vector<Issue>& issues) {
  for (const auto& entry : params.materials) {
    const std::string& name = entry.first;
    const BuildingMaterial& given = entry.second;
    if (!given.images) continue;
    const auto check = [&](const std::string& uri, const char* member) {
      if (uri.empty()) return;
      std::string error = texture::error_of_image_uri(uri);
      if (!error.empty()) {
        issues.emplace_back(IssueKind::invalid_value, "/materials/" + name + "/images/" + member,
                            std::move(error));
      }
    };
    check(given.images->color, "color");
    check(given.images->normal, "normal");
    check(given.images->surface, "surface");
  }
  if (params.facade_image.empty()) return;
  if (std::string error = texture::error_of_image_uri(params.facade_image); !error.empty())
    issues.emplace_back(IssueKind::invalid_value, "/facade_image", std::move(error));
}

MaterialTable::MaterialTable(Model& model, const BuildingParams& params, const Shapes& shapes,
                             const GenerateContext& context)
    : model_(model),
      params_(params),
      shapes_(&shapes),
      has_textures_(context.demand.textures > 0 && params.textures != BuildingTextures::none) {
  const Job& job = context.job;
  for (const auto& [name, given] : params.materials) {
    if (!given.images) continue;
    const std::string at = "/materials/" + name + "/images/";
    textures_[name] = {load(given.images->color, name + "_color", at + "color", job),
                       load(given.images->normal, name + "_normal", at + "normal", job),
                       load(given.images->surface, name + "_surface", at + "surface", job)};
  }
  facade_image_ = load(params.facade_image, "facade", "/facade_image", job);
}

int MaterialTable::load(const std::string& uri, const std::string& name, const std::string& pointer,
                        const Job& job) {
  return uri.empty() ? -1 : texture::add_image_of_uri(model_, uri, name, pointer, job);
}

int MaterialTable::material_of(const Shape& shape) {
  const bool may_have_image = facade_image_ >= 0 && is_upright(shape);
  const auto [found, is_new] = made_.try_emplace({shape.style, shape.symbol, may_have_image}, -1);
  if (!is_new) return found->second;
  const Style& style = shapes_->styles[shape.style];
  const std::string* const color = shapes_->texts.find(style.color);
  std::string name;
  if (const std::string* given = shapes_->texts.find(style.material)) {
    name = *given;
  } else if (color != nullptr) {
    name = name_of_color(*color);
  } else {
    const std::string& symbol = this->symbol(shape);
    if (params_.materials.contains(symbol)) {
      name = symbol;
    } else {
      name = find_preset(lower(symbol)) != nullptr || params_.materials.contains(lower(symbol))
                 ? lower(symbol)
                 : "building";
    }
  }
  const bool has_image = may_have_image && is_wall(name);
  found->second = has_image ? facade_material() : make({name, color, false});
  return found->second;
}

bool MaterialTable::is_upright(const Shape& shape) const {
  if (dimension(shape.size) != 2) return false;
  const glm::dvec3& normal = shapes_->axes[shape.axes][flat_axis(shape.size)];
  return std::abs(normal.y) < 1e-3;
}

int MaterialTable::facade_material() {
  if (facade_material_ >= 0) return facade_material_;
  Material material;
  material.name = "facade";
  material.roughness = 0.9F;
  material.base_color_texture = {facade_image_, 0, true};
  facade_material_ = static_cast<int>(model_.materials.size());
  tiles_[facade_material_] = {params_.facade_tile[0], params_.facade_tile[1]};
  model_.materials.push_back(std::move(material));
  return facade_material_;
}

std::optional<Warning> MaterialTable::unused_facade_image() const {
  if (facade_image_ < 0 || facade_material_ >= 0) return std::nullopt;
  return Warning{"/facade_image", "has no effect: no upright face has the material of a wall", 0, 0};
}

int MaterialTable::material_of_part(std::string_view role, const Style& style) {
  const std::string* const color = shapes_->texts.find(style.color);
  if (params_.materials.contains(std::string(role))) return make({std::string(role), nullptr, true});
  if (role.starts_with("glass_") && params_.materials.contains("glass"))
    return make({"glass", nullptr, true});
  if (color != nullptr && role == "stone") return make({name_of_color(*color), color, true});
  // The frames and leaves of parts in the material "painted" have the current colour.
  const std::string* const material = shapes_->texts.find(style.material);
  const bool is_painted = material != nullptr && *material == "painted";
  if (color != nullptr && is_painted && (role == "frame" || role == "door"))
    return make({std::string(role) + "_" + lower(color->substr(1)), color, true});
  return make({std::string(role), nullptr, true});
}

/// The kind of surface of the material if it has textures made by seed; else null.
const texture::WallKind* MaterialTable::surface_of(const MaterialRequest& request) const {
  if (!has_textures_) return nullptr;
  const auto given = params_.materials.find(request.name);
  if (given != params_.materials.end()) {
    const BuildingMaterial& own = given->second;
    if (own.images || own.texture == BuildingTexture::none) return nullptr;
    if (own.texture != BuildingTexture::auto_) return texture::wall_kind(text_of(own.texture));
  }
  const bool is_glass = request.name.starts_with("glass");
  if (request.is_role && is_glass && given != params_.materials.end()) return nullptr;
  const bool has_rooms = is_glass && params_.textures == BuildingTextures::made;
  if (request.is_role) return params_.blueprint || has_rooms ? surface_of_part(request.name) : nullptr;
  if (params_.blueprint && request.name.starts_with("color_")) return texture::wall_kind(painted_surface);
  const bool by_name = params_.textures == BuildingTextures::made || params_.blueprint.has_value();
  return by_name ? surface_named(request.name) : nullptr;
}

int MaterialTable::make(const MaterialRequest& request) {
  const auto& [name, color, is_role] = request;
  const auto given = params_.materials.find(name);
  const MaterialPreset* const known = find_preset(name);
  const texture::WallKind* const surface = surface_of(request);
  // A material that is not known takes the current colour, and a known one keeps its own. The surfaces of
  // blueprints have many colours.
  const bool is_tinted = surface != nullptr || (params_.blueprint && surface_named(name) != nullptr);
  const bool takes_color = color != nullptr && (known == nullptr || is_tinted) &&
                           (given == params_.materials.end() || !given->second.color);
  const std::string key = (surface != nullptr ? "of " : "") + (takes_color ? name + *color : name);
  const auto [found, is_new] = by_name_.try_emplace(key, static_cast<int>(model_.materials.size()));
  if (!is_new) return found->second;
  Material material;
  const bool is_named = color != nullptr && name.ends_with(lower(color->substr(1)));
  material.name = is_tinted && takes_color && !is_named ? name + "_" + lower(color->substr(1)) : name;
  MaterialPreset preset = known != nullptr ? *known : presets[0];
  for (const PartMaterial& part : part_materials()) {
    const bool is_painted = is_role && name.starts_with(std::string(part.role) + "_");
    if (known == nullptr && (part.role == name || is_painted)) {
      preset = {part.role, *color_of(part.color), static_cast<double>(part.roughness),
                static_cast<double>(part.metallic), 1};
    }
  }
  // "#rrggbbaa" has an opacity.
  Color main = takes_color ? *color_of(color->substr(0, 7)) : preset.color;
  if (given != params_.materials.end() && given->second.color) main = *given->second.color;
  material.base_color = linear_color(main);
  material.roughness = static_cast<float>(preset.roughness);
  material.metallic = static_cast<float>(preset.metallic);
  if (name.starts_with("glass")) material.specular_color = reflection_of_panes;
  if (takes_color && color->size() == 9) {
    material.base_color.w = static_cast<float>(color_of("#0000" + color->substr(7))->blue) / 255.0F;
    material.alpha_mode = AlphaMode::blend;
  }
  if (given != params_.materials.end()) {
    const BuildingMaterial& own = given->second;
    if (!own.color && own.images && !own.images->color.empty()) material.base_color = glm::vec4(1);
    material.roughness = static_cast<float>(own.roughness);
    material.metallic = static_cast<float>(own.metallic);
    if (own.opacity < 1) {
      material.base_color.w = static_cast<float>(own.opacity);
      material.alpha_mode = AlphaMode::blend;
    }
    set_emission(material, own.emission);
    set_specular(material, own.specular);
    if (const auto textures = textures_.find(name); textures != textures_.end()) {
      const Textures& p = textures->second;
      if (p.color >= 0) material.base_color_texture = {p.color, 0, true};
      if (p.normal >= 0) material.normal_texture = {p.normal, 0, true};
      if (p.surface >= 0)
        material.metallic_roughness_texture = material.occlusion_texture = {p.surface, 0, true};
      if (own.images->cut_out) {
        material.alpha_mode = AlphaMode::mask;
        material.double_sided = true;
      }
      tiles_[found->second] = {own.tile[0], own.tile[1]};
    }
  }
  if (surface != nullptr) {
    material.recipe.kind = surface->name;
    if (given != params_.materials.end())
      material.recipe.seed = static_cast<std::uint64_t>(given->second.texture_seed);
    if (surface->name == rooms_surface || surface->name == grime_surface) {
      material.recipe.has_own_sides = true;  // both are flat
      if (surface->name == grime_surface) material.alpha_mode = AlphaMode::blend;
    } else if (surface->is_grey) {
      material.recipe.factor = glm::min(glm::vec3(material.base_color) / texture::wall_grey(), glm::vec3(1));
    } else {
      material.recipe.color = {{main.red, main.green, main.blue}};
    }
    tiles_[found->second] = surface->tile;
  }
  model_.materials.push_back(std::move(material));
  return found->second;
}

bool MaterialTable::has_normal_map(int material) const {
  if (material < 0) return false;
  const Material& of = model_.materials[static_cast<std::size_t>(material)];
  return of.normal_texture.texture >= 0 || texture::has_normals(of.recipe);
}

const glm::dvec2* MaterialTable::tile_of(int material) const {
  const auto found = tiles_.find(material);
  return found == tiles_.end() ? nullptr : &found->second;
}

}  // namespace seedmesh::building
