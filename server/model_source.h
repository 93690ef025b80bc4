#pragma once
/// The source of the models of `seedmesh sync`: this program, or a server over HTTP.
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/gltf/payload.h"
#include "server/config.h"

namespace seedmesh {

/// The result of one request to a source.
struct SourceResponse {
  enum class Kind {
    made,         ///< `payload` and `etag`
    same,         ///< the model is unchanged: it has the validator `etag`
    refused,      ///< `issues`, at least one
    stopped,      ///< stopped by the stop token
    unreachable,  ///< `reason`; other requests would fail, too
  };
  Kind kind = Kind::made;
  Payload payload;
  std::string etag;  ///< "" if there is none
  std::vector<Issue> issues;
  std::string reason;
};

/// The engine version; empty where it is not known, with the reason.
struct SourceEngine {
  std::string version;
  std::string reason;
};

/// All functions may run on any number of threads at once.
class ModelSource {
 public:
  virtual ~ModelSource() = default;
  virtual SourceEngine engine() = 0;
  /// Returns the model of a request (JSON). `etag` is the validator of the file that already exists, or "".
  /// `threads` is the number of threads that this program may use for the model.
  virtual SourceResponse make(const std::string& request, const std::string& etag, int threads,
                              const std::stop_token& stop) = 0;
};

/// Makes models here. `config` has to outlive the source.
std::unique_ptr<ModelSource> local_source(const Config& config);

/// Requests models from a server: "http://127.0.0.1:8080", or https, with or without a path. While the server is
/// busy, it waits for the time of Retry-After and tries again, for at most a minute. Returns null where the address
/// is not valid. `key`: an API key; "" for none.
std::unique_ptr<ModelSource> remote_source(const std::string& url, const std::string& key);

}  // namespace seedmesh
