#include "server/service.h"

#include "server/compress.h"
#include "server/permalink.h"

namespace seedmesh {
namespace {

constexpr std::size_t smallest_compressed = 1'024;

Problem not_admitted(Service& service, Admission::Refused why) {
  switch (why) {
    case Admission::Refused::queue_full:
      service.metrics.rejected("queue_full");
      return problem(429, "All workers are busy and the queue is full.");
    case Admission::Refused::deadline_passed:
      service.metrics.rejected("deadline");
      return problem(503, "The time limit passed while the request waited for a worker.");
    case Admission::Refused::draining:
      service.metrics.rejected("draining");
      return problem(503, "The service is shutting down.");
    case Admission::Refused::client_gone:
      return problem(499, "The client closed the connection.");
  }
  return problem(503, "The service cannot accept the request.");
}

/// Makes a product with a worker, and records its times.
Cache::Outcome made_by(const RequestContext& call, const std::stop_token& stop, std::string token,
                       const std::function<Result<Product>(Job::Options)>& make) {
  Cache::Outcome outcome;
  const auto work = [&](Job::Options options) {
    Result<Product> product = make(std::move(options));
    if (!product) {
      outcome = problem_of(product.error());
      return;
    }
    auto made = std::make_shared<CachedModel>();
    made->product = std::move(*product);
    made->payload = std::make_shared<const Payload>(std::move(made->product.payload));
    made->product.warnings.clear();  // they are inside the model
    made->token = std::move(token);
    for (const Product::Span& span : made->product.timing)
      call.service.metrics.spent(span.name, span.milliseconds / 1e3);
    outcome = Cache::Entry(std::move(made));
  };
  if (auto refused = with_worker(call, stop, work)) return std::move(*refused);
  return outcome;
}

Cache::Outcome generate(const RequestContext& call, const TaggedRequest& wanted, const std::stop_token& stop,
                        const Job::Progress& progress) {
  SharedCache& shared = call.service.shared;
  if (Cache::Entry entry = shared.get(wanted.request.canonical(), token_of(wanted.request))) return entry;
  Cache::Outcome outcome = made_by(call, stop, token_of(wanted.request), [&](Job::Options options) {
    options.progress = progress;
    return produce(wanted.request, options, &call.service.textures);
  });
  if (const auto* entry = std::get_if<Cache::Entry>(&outcome)) {
    call.service.metrics.made((*entry)->product.statistics);
    shared.put(wanted.request.canonical(), *entry);
  }
  return outcome;
}

/// The fields of a response with a validator; 304 where the client has the body already.
http::Response validated(const RequestContext& call, const std::string& tag, Coding used,
                         std::string_view cache_control) {
  http::Response response;
  response.set("ETag", etag(tag, used));
  response.set("Cache-Control", std::string(cache_control));
  response.set("Vary", "Accept-Encoding");
  if (call.request.method != "POST" && matches(call.request.header("If-None-Match"), tag)) {
    response.status = 304;
  } else if (used != Coding::identity) {
    response.set("Content-Encoding", std::string(name_of(used)));
  }
  return response;
}

}  // namespace

TaggedRequest tagged(Request request) {
  std::string tag = tag_of(request.canonical(), engine_version());
  return {std::move(request), std::move(tag)};
}

std::string token_of(const Request& request) {
  std::string token = write_token(request.canonical(), engine_version());
  if (token.size() > longest_token) token.clear();
  return token;
}

std::optional<TaggedRequest> TargetCache::find(const std::string& target) const {
  const std::lock_guard lock(mutex_);
  const auto found = by_target_.find(target);
  if (found == by_target_.end()) return std::nullopt;
  return found->second;
}

void TargetCache::insert(const std::string& target, const TaggedRequest& wanted) {
  // Twice the canonical text: the rest of the request takes about as much.
  const std::size_t bytes = target.size() + wanted.token.size() + 2 * wanted.request.canonical().size() + 512;
  if (bytes > capacity / 16) return;
  const std::lock_guard lock(mutex_);
  if (bytes_ + bytes > capacity) {
    by_target_.clear();
    bytes_ = 0;
  }
  if (by_target_.emplace(target, wanted).second) bytes_ += bytes;
}

Clock::time_point deadline_of(const RequestContext& call) {
  return call.request.arrived + std::chrono::duration_cast<Clock::duration>(
                                    std::chrono::duration<double>(call.service.config.time_limit));
}

std::string origin_of(const RequestContext& call) {
  const bool is_secure =
      call.service.config.tls || call.request.header("X-Forwarded-Proto").starts_with("https");
  return (is_secure ? "https://" : "http://") + call.request.header("Host");
}

Job::Options options_without_worker(const RequestContext& call) {
  Job::Options options;
  options.limits = call.service.config.limits;
  options.stop = call.request.disconnect_token();
  options.deadline = deadline_of(call);
  return options;
}

using Entered = std::variant<Admission::Ticket, Admission::Refused>;

/// Calls `work` with the worker of a ticket.
static std::optional<Problem> with_ticket(const RequestContext& call, const std::stop_token& stop,
                                          const std::function<Entered()>& enter,
                                          const std::function<void(Job::Options)>& work) {
  Service& service = call.service;
  const auto before = Clock::now();
  const Entered entered = enter();
  if (const auto* why = std::get_if<Admission::Refused>(&entered)) return not_admitted(service, *why);
  const auto& ticket = std::get<Admission::Ticket>(entered);
  service.metrics.spent("queue", std::chrono::duration<double>(Clock::now() - before).count());
  Job::Options options;
  options.reserve = call.service.huge_pages;
  options.limits = service.config.limits;
  options.threads = ticket.threads();
  options.stop = stop;
  options.deadline = deadline_of(call);
  work(std::move(options));
  return std::nullopt;
}

std::optional<Problem> with_worker(const RequestContext& call, const std::stop_token& stop,
                                   const std::function<void(Job::Options)>& work) {
  return with_ticket(
      call, stop, [&] { return call.service.admission.enter(deadline_of(call), stop); }, work);
}

std::optional<Problem> with_tile_worker(const RequestContext& call, int level, const std::stop_token& stop,
                                        const std::function<void(Job::Options)>& work) {
  return with_ticket(
      call, stop, [&] { return call.service.admission.enter_tile(level, deadline_of(call), stop); }, work);
}

bool wait_for_memory(const RequestContext& call) {
  constexpr std::chrono::seconds longest_wait{2};
  return call.service.in_flight_memory.wait(std::min(deadline_of(call), Clock::now() + longest_wait));
}

Problem too_much_in_flight(Service& service) {
  service.metrics.rejected("memory_in_flight");
  return problem(503, "The responses that are being sent to other clients use all memory for responses.");
}

Cache::Lookup model_of(const RequestContext& call, const TaggedRequest& wanted,
                       const Job::Progress& progress) {
  return call.service.cache.get(
      wanted.request.canonical(), call.request.disconnect_token,
      [&](const std::stop_token& stop) { return generate(call, wanted, stop, progress); });
}

Cache::Lookup picture_of(const RequestContext& call, const Request& request, const PictureOptions& picture) {
  // No canonical request ends with a line.
  return call.service.cache.get(request.canonical() + '\n' + picture.text(), call.request.disconnect_token,
                                [&](const std::stop_token& stop) {
                                  Cache::Outcome outcome = made_by(call, stop, {}, [&](Job::Options options) {
                                    return draw_picture(request, picture, options, &call.service.textures);
                                  });
                                  if (std::holds_alternative<Cache::Entry>(outcome))
                                    call.service.metrics.drawn();
                                  return outcome;
                                });
}

std::shared_ptr<const StaticText> StaticTexts::get(const std::string& path, Coding coding,
                                                   const std::function<std::string()>& make) {
  const std::string key = std::string(name_of(coding)) + " " + path;
  const std::lock_guard lock(mutex_);
  auto& text = by_path_[key];
  if (!text) {
    StaticText made{make(), {}, {}};
    made.tag = tag_of(made.text, path);
    if (coding != Coding::identity && made.text.size() >= smallest_compressed)
      made.encoded = encode(coding, made.text, Effort::once);
    text = std::make_shared<const StaticText>(std::move(made));
  }
  return text;
}

http::Response json_response(const RequestContext& call, std::string text, std::string_view type,
                             std::string_view cache_control) {
  const auto coding = choose_coding(call.request.header("Accept-Encoding"));
  if (!coding) return refuse(call, not_acceptable());
  const Coding used = text.size() >= smallest_compressed ? *coding : Coding::identity;
  http::Response response = validated(call, tag_of(text, type), used, cache_control);
  if (response.status == 304) return response;
  response.type = type;
  if (used != Coding::identity) text = encode(used, text, Effort::fast);
  if (text.size() < InFlight::smallest) {
    response.body = std::move(text);
    return response;
  }
  auto payload = std::make_shared<Payload>();
  payload->add(std::move(text));
  auto held = call.service.in_flight_memory.hold(std::move(payload));
  if (!held) return refuse(call, too_much_in_flight(call.service));
  const std::uint64_t size = held->size();
  response.body = http::Slice{std::move(held), 0, size};
  return response;
}

http::Response static_response(const RequestContext& call, const std::string& path, std::string_view type,
                               const std::function<std::string()>& make) {
  const auto coding = choose_coding(call.request.header("Accept-Encoding"), small_codings);
  if (!coding) return refuse(call, not_acceptable());
  const auto fixed = call.service.texts.get(path, *coding, make);
  const Coding used = fixed->encoded.empty() ? Coding::identity : *coding;
  http::Response response = validated(call, fixed->tag, used, "no-cache");
  if (response.status == 304) return response;
  response.type = type;
  response.body = used == Coding::identity ? fixed->text : fixed->encoded;
  return response;
}

Problem not_acceptable() {
  return problem(406, "The client accepts neither gzip, br, zstd nor an unencoded response.");
}

http::Response refuse(const RequestContext& call, const Problem& problem) {
  if (problem.status == 499) call.service.metrics.cancelled("client_gone");
  if (problem.status == 504) call.service.metrics.cancelled("deadline");
  if (problem.word == "limit-exceeded") call.service.metrics.limited(limit_of(problem));
  return to_response(problem, call.request.id);
}

http::Response deny(const RequestContext& call, const Denial& denial) {
  if (denial.problem.status == 429) {
    call.service.metrics.rejected(denial.reason);
  } else {
    call.service.metrics.denied(denial.reason);
  }
  http::Response response = to_response(denial.problem, call.request.id);
  if (denial.problem.status == 401) response.set("WWW-Authenticate", "Bearer realm=\"seedmesh\"");
  response.log_text = denial.reason;
  return response;
}

std::optional<http::Response> check_allowed(const RequestContext& call, const Request& request) {
  const auto denial = call.service.access.forbid(request);
  if (!denial) return std::nullopt;
  return deny(call, *denial);
}

std::string_view RequestContext::query() const {
  const std::string_view whole = target();
  return whole.substr(std::min(std::min(whole.find('?'), whole.size()) + 1, whole.size()));
}

}  // namespace seedmesh
