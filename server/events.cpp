/// POST /v1/generate with Accept: text/event-stream: server-sent events.
///
/// The generation runs on a thread of its own and puts its progress into a mailbox. The connection's thread takes
/// it from there and writes an event, or a comment after ten seconds without progress. An error before the first
/// event is an ordinary response with its own status.
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "server/permalink.h"
#include "server/routes.h"

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::chrono::seconds heartbeat{10};
constexpr std::string_view comment = ": still working\n\n";

struct Progress {
  std::string stage;
  double share = 0;
};

/// Passes progress and result between the two threads. Later progress replaces progress that is not written yet.
struct Mailbox {
  std::mutex mutex;
  std::condition_variable filled;
  std::optional<Progress> progress;
  std::optional<Cache::Lookup> end;

  bool wait(std::unique_lock<std::mutex>& lock) {
    return filled.wait_for(lock, heartbeat, [this] { return progress || end; });
  }
};

std::string event(std::string_view name, const std::string& data) {
  std::string text = "event: ";
  text += name;
  text += "\ndata: ";
  text += data;  // JSON on one line
  text += "\n\n";
  return text;
}

std::string done_event(const RequestContext& call, const TaggedRequest& wanted, const CachedModel& made) {
  const Statistics& statistics = made.product.statistics;
  Json data = {{"permalink", nullptr},
               {"etag", "\"" + wanted.tag + "\""},
               {"media_type", made.product.media_type},
               {"statistics",
                {{"triangles", statistics.triangles},
                 {"vertices", statistics.vertices},
                 {"warnings", statistics.warnings},
                 {"bytes", made.payload->size()}}},
               {"timing", Json::object()}};
  if (!made.token.empty()) {
    const std::string link =
        call.service.access.signed_for(call.grant, permalink(made.token, made.product.extension));
    if (!link.empty() && link.size() <= 8'000) data["permalink"] = link;
  }
  for (const Product::Span& span : made.product.timing) data["timing"][span.name] = span.milliseconds;
  return event("done", data.dump());
}

/// A generation whose progress is being written. The destructor waits for the end of the work.
struct Generation {
  Generation(RequestContext given, TaggedRequest request)
      : call(std::move(given)), wanted(std::move(request)) {}
  ~Generation() {
    if (worker.joinable()) worker.join();
  }

  void start() {
    worker = std::thread([this] {
      const auto report = [this](std::string_view stage, double share) {
        const std::lock_guard lock(mailbox.mutex);
        mailbox.progress = Progress{std::string(stage), share};
        mailbox.filled.notify_one();
      };
      Cache::Lookup answer;
      try {
        answer = model_of(call, wanted, report);
      } catch (const std::exception& error) {
        answer.outcome = internal_error(error.what());
      }
      const std::lock_guard lock(mailbox.mutex);
      mailbox.end = std::move(answer);
      mailbox.filled.notify_one();
    });
  }

  void write(const http::Write& send) {
    bool connected = !silent || send(comment);
    std::unique_lock lock(mailbox.mutex);
    while (true) {
      const bool changed = mailbox.wait(lock);
      const std::optional<Progress> progress = std::exchange(mailbox.progress, std::nullopt);
      const bool ended = mailbox.end.has_value();
      lock.unlock();
      if (progress && connected) {
        connected =
            send(event("progress", Json{{"stage", progress->stage}, {"share", progress->share}}.dump()));
      }
      if (!changed && connected) connected = send(comment);
      if (ended) break;
      lock.lock();
    }
    if (const auto* entry = std::get_if<Cache::Entry>(&mailbox.end->outcome)) {
      send(done_event(call, wanted, **entry));
    } else {
      send(event("error", problem_json(std::get<Problem>(mailbox.end->outcome), call.request.id)));
    }
  }

  RequestContext call;
  TaggedRequest wanted;
  Mailbox mailbox;
  bool silent = false;  ///< the first comment is already due
  std::thread worker;
};

}  // namespace

http::Response generate_events(RequestContext& call, const TaggedRequest& wanted) {
  auto generation = std::make_shared<Generation>(call, wanted);
  generation->start();
  {
    std::unique_lock lock(generation->mailbox.mutex);
    generation->silent = !generation->mailbox.wait(lock);
    if (generation->mailbox.end) {
      if (const auto* refused = std::get_if<Problem>(&generation->mailbox.end->outcome))
        return refuse(call, *refused);
    }
  }
  http::Response response;
  response.type = "text/event-stream";
  response.set("Cache-Control", "no-store");
  response.set("Vary", "Accept, Accept-Encoding");
  response.set("X-Accel-Buffering", "no");  // nginx would buffer the events
  response.body = http::Stream([generation](const http::Write& send) { generation->write(send); });
  return response;
}

}  // namespace seedmesh
