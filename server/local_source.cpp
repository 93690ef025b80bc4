/// Models that this program makes.
#include <chrono>
#include <exception>

#include "core/base/huge_page_cache.h"
#include "core/pipeline.h"
#include "server/model_source.h"
#include "server/negotiate.h"
#include "server/texture_cache.h"

namespace seedmesh {
namespace {

SourceResponse refusal(const Error& error) {
  SourceResponse answer;
  answer.kind = error.code == Code::cancelled ? SourceResponse::Kind::stopped : SourceResponse::Kind::refused;
  answer.issues = error.issues;
  return answer;
}

class LocalSource final : public ModelSource {
 public:
  explicit LocalSource(const Config& config) : config_(config), textures_(config.texture_bytes) {}

  SourceEngine engine() override { return {std::string(engine_version()), ""}; }

  SourceResponse make(const std::string& text, const std::string& known, int threads,
                      const std::stop_token& stop) override {
    Job::Options options;
    options.limits = config_.limits;
    options.threads = threads;
    options.stop = stop;
    options.reserve = reserve_;
    options.deadline = Job::Clock::now() + std::chrono::duration_cast<Job::Clock::duration>(
                                               std::chrono::duration<double>(config_.time_limit));
    const Result<Request> request = read_request(text, options);
    if (!request) return refusal(request.error());
    SourceResponse answer;
    answer.etag = etag(tag_of(request->canonical(), engine_version()), Coding::identity);
    if (answer.etag == known) {
      answer.kind = SourceResponse::Kind::same;
      return answer;
    }
    Result<Product> product = produced(*request, options);
    if (!product) return refusal(product.error());
    answer.payload = std::move(product->payload);
    return answer;
  }

 private:
  Result<Product> produced(const Request& request, const Job::Options& options) {
    try {
      return produce(request, options, &textures_);
    } catch (const std::exception& error) {  // an error in one request does not end the others
      return Error{Code::internal, {{IssueKind::internal, "", error.what()}}};
    }
  }

  const Config& config_;
  TextureCache textures_;
  const std::shared_ptr<HugePageCache> reserve_ = std::make_shared<HugePageCache>();
};

}  // namespace

std::unique_ptr<ModelSource> local_source(const Config& config) {
  return std::make_unique<LocalSource>(config);
}

}  // namespace seedmesh
