#include "server/shared_cache.h"

#include <hiredis/hiredis.h>
#include <sys/time.h>
#include <xxhash.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "server/http/text.h"
#include "server/signature.h"

namespace seedmesh {
namespace {

constexpr std::string_view magic = "seedmesh model 1\n";
constexpr std::uint64_t most_queued = 64U << 20U;
constexpr std::chrono::milliseconds pause{1'000};  ///< after a failed attempt to connect

struct FreeReply {
  void operator()(redisReply* reply) const { freeReplyObject(reply); }
};
using Reply = std::unique_ptr<redisReply, FreeReply>;

Reply as_reply(void* given) { return Reply(static_cast<redisReply*>(given)); }

bool succeeded(const Reply& reply) { return reply && reply->type != REDIS_REPLY_ERROR; }

timeval time_of(double seconds) {
  const double whole = std::floor(seconds);
  return {static_cast<time_t>(whole), static_cast<suseconds_t>((seconds - whole) * 1e6)};
}

/// The first lines of the stored form: a magic line, then one line of JSON with statistics, type, size and hash.
std::string header_of(const CachedModel& made) {
  const Statistics& statistics = made.product.statistics;
  XXH3_state_t* state = XXH3_createState();
  XXH3_64bits_reset(state);
  for (const auto piece : made.payload->pieces()) XXH3_64bits_update(state, piece.data(), piece.size());
  const XXH64_hash_t hash = XXH3_64bits_digest(state);
  XXH3_freeState(state);
  const nlohmann::json header = {{"type", made.product.media_type},
                                 {"extension", made.product.extension},
                                 {"triangles", statistics.triangles},
                                 {"vertices", statistics.vertices},
                                 {"warnings", statistics.warnings},
                                 {"bytes", made.payload->size()},
                                 {"hash", hash}};
  return std::string(magic) + header.dump() + "\n";
}

}  // namespace

std::string pack(const CachedModel& made) { return header_of(made) + made.payload->text(); }

Cache::Entry unpack(std::shared_ptr<const void> owner, std::string_view bytes, const std::string& token) {
  if (bytes.substr(0, magic.size()) != magic) return nullptr;
  bytes.remove_prefix(magic.size());
  const auto end = bytes.substr(0, 4'096).find('\n');
  if (end == std::string_view::npos) return nullptr;
  const nlohmann::json header = nlohmann::json::parse(bytes.substr(0, end), nullptr, false);
  bytes.remove_prefix(end + 1);
  try {
    if (header.at("bytes").get<std::uint64_t>() != bytes.size() ||
        header.at("hash").get<std::uint64_t>() != XXH3_64bits(bytes.data(), bytes.size()))
      return nullptr;
    auto made = std::make_shared<CachedModel>();
    made->product.media_type = header.at("type");
    made->product.extension = header.at("extension");
    made->product.statistics.triangles = header.at("triangles");
    made->product.statistics.vertices = header.at("vertices");
    made->product.statistics.warnings = header.at("warnings");
    auto payload = std::make_shared<Payload>();
    if (!bytes.empty()) payload->add(std::move(owner), std::as_bytes(std::span(bytes)));
    made->payload = std::move(payload);
    made->token = token;
    made->shared = true;
    return made;
  } catch (const nlohmann::json::exception&) {  // the header lacks a member
    return nullptr;
  }
}

void SharedCache::Close::operator()(redisContext* context) const { redisFree(context); }

SharedCache::SharedCache(const Config& config, const Log& log)
    : address_(config.redis),
      timeout_(config.redis_timeout),
      lifetime_(std::llround(config.redis_lifetime)),
      largest_(config.redis_value),
      pool_size_(static_cast<std::size_t>(config.threads) + 2),
      log_(log) {
  if (address_) thread_ = std::thread([this] { maintain(); });
}

SharedCache::~SharedCache() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::string SharedCache::key_of(const std::string& canonical) const {
  return "seedmesh:" + std::string(engine_version()) + ":" + http::hex(sha256(canonical));
}

Cache::Entry SharedCache::get(const std::string& canonical, const std::string& token) {
  if (!address_) return nullptr;
  Connection connection = take();
  if (!connection) return nullptr;
  const std::string key = key_of(canonical);
  std::shared_ptr<redisReply> reply =
      as_reply(redisCommand(connection.get(), "GET %b", key.data(), key.size()));
  if (!reply) {
    count_error(connection->errstr);
    return nullptr;
  }
  put_back(std::move(connection));
  Cache::Entry entry;
  if (reply->type == REDIS_REPLY_STRING) entry = unpack(reply, {reply->str, reply->len}, token);
  const std::lock_guard lock(mutex_);
  ++(entry ? counters_.hits : reply->type == REDIS_REPLY_ERROR ? counters_.errors : counters_.misses);
  return entry;
}

void SharedCache::put(const std::string& canonical, const Cache::Entry& entry) {
  const std::uint64_t bytes = entry->payload->size();
  if (!address_ || bytes > largest_) return;
  Write write{key_of(canonical), entry};
  {
    const std::lock_guard lock(mutex_);
    if (failing_ || queued_bytes_ + bytes > most_queued) {
      ++counters_.skips;
      return;
    }
    queued_bytes_ += bytes;
    writes_.push_back(std::move(write));
  }
  changed_.notify_all();
}

SharedCache::Connection SharedCache::take() {
  const std::lock_guard lock(mutex_);
  if (ready_.empty()) {
    ++counters_.skips;
    return nullptr;
  }
  Connection connection = std::move(ready_.back());
  ready_.pop_back();
  return connection;
}

void SharedCache::put_back(Connection connection) {
  const std::lock_guard lock(mutex_);
  ready_.push_back(std::move(connection));
}

/// Counts a lost connection. Closes the connections that are ready, because they have most likely failed too.
void SharedCache::count_error(const std::string& what) {
  bool first = false;
  {
    const std::lock_guard lock(mutex_);
    ++counters_.errors;
    open_ -= 1 + ready_.size();
    ready_.clear();
    first = !std::exchange(failing_, true);
  }
  changed_.notify_all();
  if (first) {
    log_.write(Log::Level::warn, "the shared cache does not respond",
               {{"address", shown_address(*address_)}, {"reason", what}});
  }
}

SharedCache::Connection SharedCache::connect() const {
  const timeval patience = time_of(std::max(timeout_, 0.25));
  Connection connection(address_->path.empty()
                            ? redisConnectWithTimeout(address_->host.c_str(), address_->port, patience)
                            : redisConnectUnixWithTimeout(address_->path.c_str(), patience));
  if (!connection || connection->err != 0) return nullptr;
  redisSetTimeout(connection.get(), time_of(timeout_));
  redisContext* context = connection.get();
  const RedisAddress& a = *address_;
  if (!a.password.empty()) {
    const Reply reply =
        as_reply(a.user.empty() ? redisCommand(context, "AUTH %s", a.password.c_str())
                                : redisCommand(context, "AUTH %s %s", a.user.c_str(), a.password.c_str()));
    if (!succeeded(reply)) return nullptr;
  }
  if (a.database != 0 && !succeeded(as_reply(redisCommand(context, "SELECT %d", a.database)))) return nullptr;
  // A Redis that hangs still accepts connections.
  if (!succeeded(as_reply(redisCommand(context, "PING")))) return nullptr;
  return connection;
}

bool SharedCache::write(redisContext& connection, const Write& write) const {
  const std::string value = pack(*write.entry);
  const std::string seconds = std::to_string(lifetime_);
  return succeeded(as_reply(redisCommand(&connection, "SET %b %b EX %s", write.key.data(), write.key.size(),
                                         value.data(), value.size(), seconds.c_str())));
}

void SharedCache::maintain() {
  std::unique_lock lock(mutex_);
  Connection own;  // for writing
  while (!ending_) {
    if (!own || open_ < pool_size_) {
      lock.unlock();
      Connection made = connect();
      lock.lock();
      if (!made) {
        failing_ = true;
        own.reset();
        writes_.clear();
        queued_bytes_ = 0;
        ++counters_.errors;
        changed_.wait_for(lock, pause, [this] { return ending_; });
        continue;
      }
      if (failing_ || (!own && open_ == 0)) {
        lock.unlock();
        log_.write(Log::Level::info, "the shared cache responds", {{"address", shown_address(*address_)}});
        lock.lock();
      }
      failing_ = false;
      if (!own) {
        own = std::move(made);
      } else {
        ready_.push_back(std::move(made));
        ++open_;
      }
      continue;
    }
    if (writes_.empty()) {
      changed_.wait(lock, [this] { return ending_ || open_ < pool_size_ || !writes_.empty(); });
      continue;
    }
    const Write next = std::move(writes_.front());
    writes_.pop_front();
    queued_bytes_ -= next.entry->payload->size();
    lock.unlock();
    const bool written = write(*own, next);
    const bool lost = own->err != 0;  // else Redis refused, for example without memory
    if (lost) own.reset();
    lock.lock();
    ++(written ? counters_.writes : counters_.errors);
    if (lost) failing_ = true;
  }
}

SharedCache::Counters SharedCache::counters() const {
  const std::lock_guard lock(mutex_);
  Counters counters = counters_;
  counters.connections = open_;
  return counters;
}

}  // namespace seedmesh
