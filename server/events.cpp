/// POST /v1/generate with Accept: text/event-stream.
///
/// The work runs on a thread of its own and leaves what it has to tell in a box; the connection's thread
/// takes it out and writes it, or a comment when there has been nothing for ten seconds. A refusal that comes
/// before anything was written is an ordinary answer with its own status.
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
constexpr std::string_view comment = ": still at work\n\n";

struct Progress {
  std::string stage;
  double share = 0;
};

/// Between the two threads. Progress that was not yet written is replaced by later progress.
struct Box {
  std::mutex mutex;
  std::condition_variable filled;
  std::optional<Progress> progress;
  std::optional<Cache::Answer> end;

  bool wait(std::unique_lock<std::mutex>& lock) {
    return filled.wait_for(lock, heartbeat, [this] { return progress || end; });
  }
};

std::string event(std::string_view name, const std::string& data) {
  std::string text = "event: ";
  text += name;
  text += "\ndata: ";
  text += data;  // JSON on one line has no line break
  text += "\n\n";
  return text;
}

std::string done_event(const Call& call, const Known& known, const Made& made) {
  const Statistics& statistics = made.product.statistics;
  Json data = {{"permalink", nullptr},
               {"etag", "\"" + known.tag + "\""},
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

/// Everything a stream needs while it is being written; the work ends before this does.
struct Generation {
  Generation(Call given, Known wanted) : call(std::move(given)), known(std::move(wanted)) {}
  ~Generation() {
    if (worker.joinable()) worker.join();
  }

  void start() {
    worker = std::thread([this] {
      const auto tell = [this](std::string_view stage, double share) {
        const std::lock_guard lock(box.mutex);
        box.progress = Progress{std::string(stage), share};
        box.filled.notify_one();
      };
      Cache::Answer answer;
      try {
        answer = model_of(call, known, tell);
      } catch (const std::exception& error) {
        Problem fault = problem(500, "Something went wrong here. The instance names the request in the log.");
        fault.log_text = error.what();
        answer.outcome = std::move(fault);
      }
      const std::lock_guard lock(box.mutex);
      box.end = std::move(answer);
      box.filled.notify_one();
    });
  }

  void write(const http::Write& send) {
    bool reading = !silent || send(comment);
    std::unique_lock lock(box.mutex);
    while (true) {
      const bool news = box.wait(lock);
      const std::optional<Progress> progress = std::exchange(box.progress, std::nullopt);
      const bool ended = box.end.has_value();
      lock.unlock();
      if (progress && reading) {
        reading =
            send(event("progress", Json{{"stage", progress->stage}, {"share", progress->share}}.dump()));
      }
      if (!news && reading) reading = send(comment);
      if (ended) break;
      lock.lock();
    }
    if (const auto* entry = std::get_if<Cache::Entry>(&box.end->outcome)) {
      send(done_event(call, known, **entry));
    } else {
      send(event("error", problem_json(std::get<Problem>(box.end->outcome), call.request.id)));
    }
  }

  Call call;
  Known known;
  Box box;
  bool silent = false;  ///< the first heartbeat is due already
  std::thread worker;
};

}  // namespace

http::Response generate_events(Call& call, const Known& known) {
  auto generation = std::make_shared<Generation>(call, known);
  generation->start();
  {
    std::unique_lock lock(generation->box.mutex);
    generation->silent = !generation->box.wait(lock);
    if (generation->box.end) {
      if (const auto* refused = std::get_if<Problem>(&generation->box.end->outcome))
        return refuse(call, *refused);
    }
  }
  http::Response response;
  response.type = "text/event-stream";
  response.set("Cache-Control", "no-store");
  response.set("Vary", "Accept, Accept-Encoding");
  response.set("X-Accel-Buffering", "no");  // nginx would hold the events back
  response.body = http::Stream([generation](const http::Write& send) { generation->write(send); });
  return response;
}

}  // namespace seedmesh
