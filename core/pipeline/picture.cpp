/// Pictures of models.
#include "core/render/picture.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/pipeline.h"
#include "core/pipeline/guarded.h"
#include "core/pipeline/make_model.h"
#include "core/texture/webp_write.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t least_size = 16, greatest_size = 1024;
constexpr int least_textures = 64, most_textures = 256;
/// Of scenes, which choose coarser levels themselves.
constexpr std::uint64_t most_triangles = 1'500'000;

struct NamedView {
  std::string_view name;
  render::View view;
};
constexpr std::array<NamedView, 7> named_views = {{{"three_quarter", {}},
                                                   {"front", {0, 8.0}},
                                                   {"right", {90, 8.0}},
                                                   {"back", {180, 8.0}},
                                                   {"left", {270, 8.0}},
                                                   {"top", {0, 89.0}},
                                                   {"high", {35, 45.0}}}};

std::optional<double> read_decimal(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// "azimuth,elevation" in degrees.
std::optional<render::View> read_angles(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto azimuth = read_decimal(text.substr(0, comma)), elevation = read_decimal(text.substr(comma + 1));
  if (!azimuth || !elevation || std::abs(*azimuth) > 360 || std::abs(*elevation) > 89) return std::nullopt;
  return render::View{*azimuth, *elevation};
}

std::string view_names() {
  std::string names;
  for (const NamedView& each : named_views) names += std::string(each.name) + ", ";
  return names;
}

std::string quoted(std::string_view text) { return '"' + std::string(text.substr(0, 40)) + '"'; }

std::optional<Issue> read_view(std::string_view text, PictureOptions& picture) {
  std::optional<render::View> view = read_angles(text);
  for (const NamedView& each : named_views) {
    if (each.name == text) view = each.view;
  }
  if (!view) {
    return Issue{IssueKind::invalid_value, "/view",
                 "found " + quoted(text) + "; expected " + view_names() +
                     "or azimuth,elevation in degrees, as 35,18, from -360 to 360 and -89 to 89"};
  }
  picture.view = *view;
  return std::nullopt;
}

std::optional<std::uint32_t> read_pixels(std::string_view text) {
  std::uint32_t pixels = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), pixels);
  if (error != std::errc{} || end != text.data() + text.size() || pixels < least_size ||
      pixels > greatest_size) {
    return std::nullopt;
  }
  return pixels;
}

/// "512" for a square, or "640x360".
std::optional<Issue> read_size(std::string_view text, PictureOptions& picture) {
  const std::size_t cross = text.find('x');
  const auto width = read_pixels(text.substr(0, cross));
  const auto height = cross == std::string_view::npos ? width : read_pixels(text.substr(cross + 1));
  if (!width || !height) {
    const std::string range = std::to_string(least_size) + " to " + std::to_string(greatest_size);
    return Issue{IssueKind::out_of_range, "/size",
                 "found " + quoted(text) + "; expected a whole number of pixels from " + range +
                     ", or width and height, as 640x360"};
  }
  picture.width = *width;
  picture.height = *height;
  return std::nullopt;
}

std::optional<Issue> read_ground(std::string_view text, PictureOptions& picture) {
  if (text == "auto") {
    picture.ground = PictureOptions::Ground::auto_;
  } else if (text == "none" || text == "plane") {
    picture.ground = text == "none" ? PictureOptions::Ground::none : PictureOptions::Ground::plane;
  } else {
    return Issue{IssueKind::invalid_value, "/ground",
                 "found " + quoted(text) + "; expected auto, none or plane"};
  }
  return std::nullopt;
}

/// The request for what the picture shows: without coarser levels, animation, collision shapes and large textures.
Request for_picture(const Request& request, const PictureOptions& picture) {
  Request::Body body = request.body();
  const OutputParams given = body.output;
  body.output = OutputParams{};
  body.output.variants = given.variants;
  body.output.max_triangles = given.max_triangles;
  body.output.tangents = OutputTangents::none;
  const auto* choice = std::get_if<OutputTextures>(&given.textures);
  if (choice && *choice == OutputTextures::none) {
    body.output.textures = OutputTextures::none;
  } else {
    body.output.textures = static_cast<std::int32_t>(
        std::max(picture.width, picture.height) > 256 ? most_textures : least_textures);
  }
  if (body.generator->keeps_budget && !body.output.max_triangles)
    body.output.max_triangles = static_cast<std::int32_t>(most_triangles);
  return Request(std::make_shared<const Request::Body>(std::move(body)));
}

/// Land and places fill their ground themselves.
bool stands_on_ground(const Request& request, const PictureOptions& picture) {
  if (picture.ground != PictureOptions::Ground::auto_) return picture.ground == PictureOptions::Ground::plane;
  const std::string_view generator = request.generator();
  return generator == "tree" || generator == "lsystem" || generator == "building" || generator == "fractal";
}

}  // namespace

std::string PictureOptions::text() const {
  constexpr std::array<std::string_view, 3> grounds = {"auto", "none", "plane"};
  return "size=" + std::to_string(width) + "x" + std::to_string(height) +
         "&view=" + Json(view.azimuth).dump() + "," +
         (view.elevation ? Json(*view.elevation).dump() : "auto") +
         "&ground=" + std::string(grounds[static_cast<std::size_t>(ground)]);
}

Result<PictureOptions> read_picture_options(Overrides& query) {
  struct Key {
    std::string_view name;
    std::optional<Issue> (*read)(std::string_view, PictureOptions&);
  };
  constexpr std::array<Key, 3> keys = {{{"size", read_size}, {"view", read_view}, {"ground", read_ground}}};
  PictureOptions picture;
  std::vector<Issue> issues;
  for (const Key& key : keys) {
    const auto is_key = [&](const auto& pair) { return pair.first == key.name; };
    const auto times = std::ranges::count_if(query, is_key);
    if (times == 0) continue;
    if (times > 1) {
      issues.emplace_back(IssueKind::duplicate_key, "/" + std::string(key.name),
                          std::string(key.name) + " is given " + std::to_string(times) + " times");
    } else if (std::optional<Issue> issue = key.read(std::ranges::find_if(query, is_key)->second, picture)) {
      issues.push_back(*std::move(issue));
    }
    std::erase_if(query, is_key);
  }
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  return picture;
}

Result<Product> draw_picture(const Request& request, const PictureOptions& picture,
                             const Job::Options& options, TextureStore* texture_store) {
  return guarded<Product>([&]() -> Result<Product> {
    Job job(request.seed(), options);
    const Request plain = for_picture(request, picture);
    Result<Model> model = make_model(plain, texture_store, job);
    if (!model) return std::move(model).error();
    Product product;
    const ModelCounts counts = count(*model);
    product.statistics = {counts.triangles, counts.vertices,
                          static_cast<std::uint32_t>(model->warnings.size())};
    job.progress("render", 0);
    const texture::Picture pixels = render::draw_picture(
        *model, {picture.width, picture.height, picture.view, stands_on_ground(request, picture)}, job);
    job.progress("encode", 0);
    auto file = std::make_shared<const Array<std::uint8_t>>(
        texture::encode_webp(pixels.view(), texture::WebpQuality::quick, job));
    job.spend(Resource::output_bytes, file->size());
    const auto bytes = std::as_bytes(file->span());
    product.payload.add(std::move(file), bytes);
    product.media_type = "image/webp";
    product.extension = "webp";
    const std::vector<Job::Stage>& stages = job.stages();
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const auto end = i + 1 < stages.size() ? stages[i + 1].begun : Job::Clock::now();
      product.timing.push_back(
          {stages[i].name, std::chrono::duration<double, std::milli>(end - stages[i].begun).count()});
    }
    return product;
  });
}

}  // namespace seedmesh
