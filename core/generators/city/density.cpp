#include "core/generators/city/density.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/generators/city/geojson.h"
#include "core/lang/text_positions.h"
#include "core/texture/data_uri.h"
#include "generated/params/city.h"

namespace seedmesh::city {
std::optional<FieldMap> FieldMap::read(const MapValue& value, const std::string& pointer,
                                       const glm::dvec2& low, const glm::dvec2& high, const Job& job,
                                       std::vector<Issue>& issues) {
  FieldMap map;
  if (const auto* polygons = std::get_if<GeoJson>(&value)) {
    map.has_polygons_ = true;
    map.polygons_ = polygons_of(*polygons, pointer, {issues});
    return map;
  }
  const std::string& text = std::get<std::string>(value);
  if (text.starts_with("data:")) {
    Result<texture::Brightness> image = texture::brightness_of_png(text, job);
    if (!image) {
      issues.emplace_back(IssueKind::invalid_value, pointer, image.error().issues.front().message);
      return std::nullopt;
    }
    map.low_ = low;
    map.size_ = high - low;
    map.width_ = image->width;
    map.height_ = image->height;
    map.pixels_ = std::move(image->values);
    return map;
  }
  return read_text(text, pointer, issues);
}

std::optional<FieldMap> FieldMap::read_text(const std::string& text, const std::string& pointer,
                                            std::vector<Issue>& issues) {
  FieldMap map;
  std::vector<lang::TextError> errors;
  const auto tokens = lang::tokenize(text, 0, text.size(), errors);
  lang::Names names;
  names.bind_slot("x", 0);
  names.bind_slot("y", 1);
  std::size_t at = 0;
  map.expression_ = map.program_.parse(tokens, at, names, errors);
  if (tokens[at].kind != lang::TokenKind::end) {
    errors.push_back({tokens[at].offset,
                      "found " + lang::in_quotes(tokens[at]) + ", expected an operator or the end",
                      IssueKind::syntax});
  }
  if (errors.empty() && map.program_.draws(map.expression_)) {
    errors.push_back({0, "found a function of random numbers; a map has one value for each position",
                      IssueKind::invalid_value});
  }
  if (errors.empty()) return map;
  lang::add_issues(pointer, text, errors, issues);
  return std::nullopt;
}

double FieldMap::at(const glm::dvec2& metres) const { return std::clamp(value_at(metres), 0.0, 1.0); }

double FieldMap::value_at(const glm::dvec2& metres) const {
  if (has_polygons_) return is_in_any(polygons_, metres * 100.0) ? 1.0 : 0.0;
  if (width_ == 0) {
    Rng unused(0);
    const std::array<double, 2> slots = {metres.x, metres.y};
    const double value = program_.evaluate(expression_, slots.data(), unused);
    return std::isfinite(value) ? value : 0.0;
  }
  // Bilinear between the centres of pixels.
  const double u = std::clamp((metres.x - low_.x) / size_.x, 0.0, 1.0) * width_ - 0.5;
  const double v = std::clamp(1 - (metres.y - low_.y) / size_.y, 0.0, 1.0) * height_ - 0.5;
  const auto pixel = [this](double column, double row) {
    const auto x = static_cast<std::size_t>(std::clamp(column, 0.0, width_ - 1.0));
    const auto y = static_cast<std::size_t>(std::clamp(row, 0.0, height_ - 1.0));
    return static_cast<double>(pixels_[y * width_ + x]);
  };
  const double x = std::floor(u), y = std::floor(v), s = u - x, t = v - y;
  return (pixel(x, y) * (1 - s) + pixel(x + 1, y) * s) * (1 - t) +
         (pixel(x, y + 1) * (1 - s) + pixel(x + 1, y + 1) * s) * t;
}

}  // namespace seedmesh::city
