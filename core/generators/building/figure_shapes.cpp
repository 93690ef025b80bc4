#include "core/generators/building/figure_shapes.h"

#include <array>

#include "core/base/math.h"
#include "generated/params/building.h"

namespace seedmesh::building {
namespace {

constexpr std::array kind_names{"box", "cylinder", "cone", "sphere", "pyramid", "prism", "triangular_prism"};
constexpr std::uint32_t symbol_figure = 0, symbol_line = 1, symbol_kind = 2,
                        symbol_label = symbol_kind + kind_names.size();

class FigureWriter {
 public:
  FigureWriter(const FigureGrammar& figures, const BuildingShapeGrammar& given, Job& job)
      : figures_(figures), given_(given), key_(job.rng().at("shape grammar").key()), out_(job) {
    Shape root;
    root.symbol = symbol_figure;
    root.key = key_;
    root.is_active = false;
    root.size = glm::dvec3(0);
    out_.shapes.push_back(root);
    line_style_ = style_of(given.material);
    for (const std::string& name : figures.materials) styles_.push_back(style_of(name));
  }

  Shapes take() { return std::move(out_); }

  void line(const FigureLine& line) {
    const glm::dvec3 along = math::unit(line.to - line.from, glm::dvec3(1, 0, 0));
    const double half = 0.5 * given_.width;
    // y of the bar is as near to the vertical as the direction of the line allows.
    glm::dvec3 z = glm::cross(along, glm::dvec3(0, 1, 0));
    z = math::unit(z, glm::dvec3(0, 0, 1));
    const glm::dvec3 y = glm::cross(z, along);
    Shape& shape = add(symbol_line, {along, y, z});
    shape.size = {glm::length(line.to - line.from) + given_.width, given_.width, given_.width};
    shape.origin = line.from - along * half - z * half - (figures_.is_flat ? glm::dvec3(0) : y * half);
    shape.style = line_style_;
  }

  void solid(const FigureSolid& solid) {
    glm::dmat3 axes = solid.axes;
    // All kinds are symmetrical along their x axis.
    if (glm::determinant(axes) < 0) axes[0] = -axes[0];
    Shape& shape = add(symbol_kind + static_cast<std::uint32_t>(solid.kind), axes);
    shape.size = solid.size;
    if (figures_.is_flat) shape.size.y = given_.height;
    shape.origin = solid.base - axes * (glm::dvec3(0.5, 0, 0.5) * shape.size);
    shape.style = styles_[solid.material];
    shape.geometry = geometry_of(solid.kind);
  }

  void marker(const FigureMarker& marker) {
    const double size = given_.marker_size;
    Shape& shape = add(symbol_label + marker.label, glm::dmat3(1));
    shape.size = glm::dvec3(size);
    shape.origin = marker.points[0] - 0.5 * shape.size;
    if (figures_.is_flat) shape.origin.y = given_.width;
    shape.geometry = geometry_of(SolidKind::sphere);
  }

 private:
  Shape& add(std::uint32_t symbol, const glm::dmat3& axes) {
    Shape shape;
    shape.symbol = symbol;
    shape.parent = 0;
    shape.depth = 1;
    shape.is_leaf = true;
    shape.key = key_at(key_, out_.shapes.size());
    shape.axes = static_cast<std::uint32_t>(out_.axes.size());
    out_.axes.push_back(axes);
    out_.shapes.push_back(shape);
    return out_.shapes[out_.shapes.size() - 1];
  }

  std::uint32_t style_of(const std::string& material) {
    if (material.empty()) return 0;
    Style style;
    style.material = out_.texts.id_of(material);
    out_.styles.push_back(style);
    return static_cast<std::uint32_t>(out_.styles.size()) - 1;
  }

  std::uint32_t geometry_of(SolidKind kind) {
    if (kind == SolidKind::box) return box_geometry;
    std::uint32_t& made = geometry_[static_cast<std::size_t>(kind)];
    if (made != 0) return made;
    constexpr Solid (*makers[])() = {unit_box, cylinder, cone, sphere, pyramid, frustum, triangular_prism};
    out_.solids.push_back(std::make_unique<const Solid>(makers[static_cast<std::size_t>(kind)]()));
    made = static_cast<std::uint32_t>(out_.solids.size());
    return made;
  }

  const FigureGrammar& figures_;
  const BuildingShapeGrammar& given_;
  std::uint64_t key_;
  Shapes out_;
  std::uint32_t line_style_ = 0;
  std::vector<std::uint32_t> styles_;
  std::array<std::uint32_t, kind_names.size()> geometry_{};
};

}  // namespace

Grammar grammar_of_names(const FigureGrammar& figures) {
  Grammar grammar;
  const auto add = [&](const std::string& name) { grammar.symbols.push_back({name, {}, none}); };
  add("picture");
  add("line");
  for (const char* name : kind_names) add(name);
  for (const std::string& label : figures.labels) add(label);
  return grammar;
}

Shapes shapes_of_figure(const FigureGrammar& figures, const DerivedFigure& derived,
                        const BuildingShapeGrammar& given, Job& job) {
  FigureWriter writer(figures, given, job);
  for (const FigureLine& line : derived.figure.lines) writer.line(line);
  for (const FigureSolid& solid : derived.figure.solids) writer.solid(solid);
  if (given.marker_size > 0) {
    for (const FigureMarker& marker : derived.figure.markers) writer.marker(marker);
  }
  Shapes shapes = writer.take();
  for (const auto& [name, count] : derived.uses) {
    const auto uses = static_cast<double>(count);
    shapes.reports[name] = {count, uses, 1, 1};
  }
  if (derived.fits_nowhere)
    shapes.warnings.push_back({"/shape_grammar/rules", "no rule matches the initial shape", 0, 0});
  return shapes;
}

}  // namespace seedmesh::building
