#pragma once
/// The one door into core: request text in, bytes out. The server and the program include this header of core
/// only. Pure: everything here may run on any number of threads at once; nothing is global.
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/base/texture_store.h"
#include "core/gltf/payload.h"
#include "core/model/model.h"

namespace seedmesh {

/// A request read, checked and with its preset resolved. Cheap to copy (shared, immutable).
class Request {
 public:
  struct Body;
  explicit Request(std::shared_ptr<const Body> body) : body_(std::move(body)) {}
  const Body& body() const { return *body_; }
  std::string_view generator() const;
  std::string_view format() const;       ///< "glb", "gltf", "zip", ...
  const std::string& canonical() const;  ///< canonical JSON: preset resolved, defaults left out, keys sorted
  std::uint64_t seed() const;

 private:
  std::shared_ptr<const Body> body_;
};

/// Reads a request body. Malformed JSON gives Code::malformed; otherwise every fault of schema and grammar at
/// once, as Code::invalid. `limits` bound iterations and expression depth.
Result<Request> read_request(std::string_view json, const Limits& limits);

/// A preset's request with a query's overrides: keys are `seed`, `output.x`, `constants.x` or the name of a
/// parameter; values are JSON where they parse as such, else text. Unknown preset: nullopt. A bad override
/// points at "/<key>".
using Overrides = std::vector<std::pair<std::string, std::string>>;
std::optional<Result<Request>> read_preset(std::string_view name, const Overrides& overrides,
                                           const Limits& limits);

/// The same request in another format (the extension of a URL wins over output.format); an Issue where it has
/// no such form.
Result<Request> with_format(const Request& request, std::string_view format);

/// The model that a request describes. `texture_store` is the caller's; may be null.
struct Statistics {
  std::uint64_t triangles = 0, vertices = 0;
  std::uint32_t warnings = 0;
};
struct Product {
  Payload payload;
  std::string media_type;  ///< "model/gltf-binary", ...
  std::string extension;   ///< "glb", ...
  Statistics statistics;
  std::vector<Warning> warnings;  ///< those that the model carries, with pointers into the request
  struct Span {
    std::string name;
    double milliseconds;
  };
  std::vector<Span> timing;  ///< derive, mesh, encode
};
Result<Product> produce(const Request& request, Job& job, TextureStore* texture_store = nullptr);

/// The generator's own result before geometry, as JSON text.
Result<std::string> derive(const Request& request, Job& job);

/// `{valid, warnings, estimate}` as JSON text; makes no geometry.
Result<std::string> validate(const Request& request, Job& job);

/// A foreign file, and what became of it. `format` empty: the one that the text has most marks of. `entry`
/// names the system of a file that holds several; empty: the only one.
struct ImportQuestion {
  std::string_view format, entry, text;
};
struct ImportedRequest {
  Request request;
  std::string answer;             ///< {format, request, warnings} as JSON text
  std::vector<Warning> warnings;  ///< what the file says and a request cannot; line and column of the file
};
/// Reads a file of another program as a request of ours. Bytes that are no UTF-8 give Code::malformed; an
/// unknown format points at "/format"; what the format's reader does not understand is Code::invalid with
/// pointer "" at its line and column.
Result<ImportedRequest> import_request(const ImportQuestion& question, const Limits& limits);
struct ImportFormatInfo {
  std::string name, title, text;
};
std::vector<ImportFormatInfo> import_format_list();

/// What is shipped inside: presets, schemas, vocabulary, OpenAPI. All JSON text, made once.
struct PresetInfo {
  std::string name, generator, title, description;
  std::vector<std::string> tags;
};
const std::vector<PresetInfo>& presets();
std::optional<std::string> preset_json(std::string_view name);  ///< one whole request
/// "There is no preset "ferm"; did you mean "fern"?"
std::string no_preset(std::string_view name);
std::optional<std::string_view> schema_json(std::string_view name);  ///< "request", "lsystem", "output", ...
std::vector<std::string_view> schema_names();
std::string vocabulary_json();
std::string_view openapi_json();
std::vector<std::string_view> generator_names();

/// Our own number plus a fingerprint of the libraries that touch bytes; part of every ETag and permalink.
std::string_view engine_version();
std::string_view program_version();

}  // namespace seedmesh
