#pragma once
/// The interface of core: request text in, bytes out. The server and the program use core through this
/// header. All functions are thread-safe. The only global state is constants and tables, such as that of presets, which
/// are filled once.
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/gltf/payload.h"
#include "core/model/model.h"
#include "core/pipeline/formats.h"
#include "core/render/view.h"
#include "core/texture/texture_store.h"

namespace seedmesh {

/// A request that has been read and checked, with its preset resolved. Immutable; copies share it.
class Request {
 public:
  struct Body;
  explicit Request(std::shared_ptr<const Body> body) : body_(std::move(body)) {}
  const Body& body() const { return *body_; }
  std::string_view generator() const;
  std::string_view format() const;       ///< "glb", "gltf", "zip", ...
  const std::string& canonical() const;  ///< canonical JSON: without defaults, keys sorted
  std::uint64_t seed() const;
  const std::string& name() const;  ///< name of the model and its files; only characters that URLs allow

 private:
  std::shared_ptr<const Body> body_;
};

/// Reads a request body. Malformed JSON gives Code::malformed. Otherwise Code::invalid lists every error of
/// the schema and of the generator's own checks. The limits bound iterations and expression depth; stop and
/// deadline end the checks too.
Result<Request> read_request(std::string_view json, const Job::Options& options);
/// The same without a time limit.
Result<Request> read_request(std::string_view json, const Limits& limits);

/// Reads the request of a preset with the overrides of a query. Keys are `seed`, `output.<option>`, the name
/// of a parameter, or `<parameter>.<name>` for parameters that map names to values (such as `constants`).
/// Values are JSON where they parse as the type of the schema, otherwise text. Returns nullopt for an unknown
/// preset. Errors of an override have the pointer "/<key>".
using Overrides = std::vector<std::pair<std::string, std::string>>;
std::optional<Result<Request>> read_preset(std::string_view name, const Overrides& overrides,
                                           const Limits& limits);

/// The same request with another output.format. Returns an error if the generator or an option does not support the
/// format.
Result<Request> with_format(const Request& request, std::string_view format);

// The functions below run a request within `options`. The seed comes from the request alone.

/// Sums over the model.
struct Statistics {
  std::uint64_t triangles = 0, vertices = 0;
  std::uint32_t warnings = 0;
};
/// A finished file.
struct Product {
  Payload payload;
  std::string media_type;  ///< "model/gltf-binary", ...
  std::string extension;   ///< "glb", ...
  Statistics statistics;
  std::vector<Warning> warnings;  ///< the warnings in the model, with pointers into the request
  struct Span {
    std::string name;
    double milliseconds;
  };
  std::vector<Span> timing;  ///< one span for each stage, such as derive, mesh, render and encode
};
/// Makes the model of a request. `texture_store` is the caller's; may be null.
Result<Product> produce(const Request& request, const Job::Options& options,
                        TextureStore* texture_store = nullptr);

/// Options of a picture of a model: its size, the direction of view, and the ground plane.
struct PictureOptions {
  enum class Ground { auto_, none, plane };
  std::uint32_t width = 512, height = 512;  ///< pixels, each from 16 to 1024
  render::View view = {};
  Ground ground = Ground::auto_;  ///< auto_: a plane below plants, buildings and fractals
  std::string text() const;       ///< equal options give the same text
};
/// Reads `size`, `view` and `ground` of a query and removes them from it. Code::invalid lists every error, with
/// the pointer "/<key>".
Result<PictureOptions> read_picture_options(Overrides& query);

/// Returns a picture of the model of a request as WebP, drawn in software, with textures of at most 256 texels. The
/// options lods, animation and format of the request are ignored. Its bytes are the same on every machine.
Result<Product> draw_picture(const Request& request, const PictureOptions& picture,
                             const Job::Options& options, TextureStore* texture_store = nullptr);

/// Returns the image of a generated texture. `name` is the part after the engine version in the links that
/// `output.textures: "links"` writes (core/texture/link.h). An unknown name is Code::invalid.
Result<std::shared_ptr<const Image>> make_texture(std::string_view name, const Job::Options& options,
                                                  TextureStore* texture_store = nullptr);

/// Returns the abstract result from which the generator makes geometry (word, skeleton, shapes, heights), as JSON
/// text.
Result<std::string> derive(const Request& request, const Job::Options& options);

/// `{valid, warnings, estimate}` as JSON text. Makes no model.
Result<std::string> validate(const Request& request, const Job::Options& options);

/// The input of import_request(): a file of another program. If `format` is empty, it is detected from the text.
/// `entry` names one system of a file with several; empty means the only one.
struct ImportInput {
  std::string_view format, entry, text;
  std::map<std::string, std::string> files = {};  ///< further files beside the text, by name
};
struct ImportedRequest {
  Request request;
  std::string answer;             ///< the response: {format, request, warnings} as JSON text
  std::vector<Warning> warnings;  ///< what a request cannot express; line and column of the file
};
/// Turns a file of another program into a request. Text that is not UTF-8 gives Code::malformed. An unknown
/// format has the pointer "/format". What the reader does not understand is Code::invalid with pointer "" and
/// its line and column.
Result<ImportedRequest> import_request(const ImportInput& input, const Job::Options& options);
/// The same without a time limit.
Result<ImportedRequest> import_request(const ImportInput& input, const Limits& limits);
struct ImportFormatInfo {
  std::string name, title, text;
};
std::vector<ImportFormatInfo> import_format_list();

/// A request as a file of another program, with warnings about what such a file cannot state. `format`:
/// "proctree", with the names of listing 2.1 of Hutsko's thesis, or "proctree_js", with those of proctree.js.
struct ExportedFile {
  std::string text;
  std::vector<Warning> warnings;  ///< with pointers into the request
};
Result<ExportedFile> export_request(const Request& request, std::string_view format,
                                    const Job::Options& options);

/// The name of the format that import_request() detects in a text if the request names none; empty if it
/// detects none.
std::string_view likely_import_format(std::string_view text);

// The embedded texts: presets, schemas, vocabulary, OpenAPI.

/// What the gallery shows of a preset.
struct PresetInfo {
  std::string name, generator, title, description;
  std::vector<std::string> tags;
};
const std::vector<PresetInfo>& presets();
std::optional<std::string> preset_json(std::string_view name);  ///< one whole request
/// Returns the error message for an unknown preset, with the closest name: "There is no preset ...".
std::string no_preset(std::string_view name);
std::optional<std::string_view> schema_json(std::string_view name);  ///< "request", "lsystem", "output", ...
std::string no_schema(std::string_view name);  ///< the error message for an unknown schema
/// Returns the one of `names` that `name` most likely misspells, or an empty text.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> names);
std::vector<std::string_view> schema_names();
std::string vocabulary_json();
std::string_view openapi_json();
std::vector<std::string_view> generator_names();

/// Returns the engine number and a fingerprint of the libraries that affect bytes; part of every ETag and
/// permalink.
std::string_view engine_version();
std::string_view program_version();

}  // namespace seedmesh
