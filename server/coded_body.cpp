#include "server/coded_body.h"

#include <algorithm>

#include "server/compress.h"
#include "server/http/text.h"

namespace seedmesh {
namespace {

using Piece = std::span<const std::byte>;

constexpr std::uint64_t encoded_at_once = 256U << 10U;  ///< larger models are encoded while they are sent
constexpr std::uint64_t largest_kept = 64U << 20U;
constexpr std::size_t part_size = 256U << 10U, sent_size = 64U << 10U;
constexpr double least_saving = 0.15;

/// The right to compress. There are as many as workers, so that compression cannot take all cores from the work on
/// models. A holder never waits for a client.
class Slot {
 public:
  explicit Slot(Service& service) : service_(service), begun_(Clock::now()) { service.compressors.acquire(); }
  Slot(const Slot&) = delete;
  Slot& operator=(const Slot&) = delete;
  ~Slot() {
    service_.compressors.release();
    service_.metrics.spent("compress", std::chrono::duration<double>(Clock::now() - begun_).count());
  }

 private:
  Service& service_;
  const Clock::time_point begun_;
};

/// Whether a response may be sent without coding.
bool takes_identity(const RequestContext& call) {
  return choose_coding(call.request.header("Accept-Encoding"), {}).has_value();
}

bool stays_plain(const RequestContext& call, const Payload& payload, Coding best) {
  if (best == Coding::identity) return true;
  if (!takes_identity(call)) return false;
  const Config& config = call.service.config;
  return payload.size() < config.compress_from || call.request.has_header("Range") ||
         (config.plain_for_private && is_private_address(call.request.remote));
}

/// The model encoded into memory, or null where that does not save enough.
Cache::Entry encoded(const RequestContext& call, const Cache::Entry& model, Coding coding) {
  const Slot slot(call.service);
  std::string bytes = encode(coding, model->payload->pieces(), Effort::fast);
  const double limit = (1 - least_saving) * static_cast<double>(model->payload->size());
  auto made = std::make_shared<CachedModel>();
  if (static_cast<double>(bytes.size()) <= limit || !takes_identity(call)) {
    auto payload = std::make_shared<Payload>();
    payload->add(std::move(bytes));
    made->payload = std::move(payload);
  }
  return made;
}

/// One encoding that is sent while it runs.
struct Encoding {
  Service& service;
  const std::shared_ptr<const Payload> plain;
  const Coding coding;
  const std::string key;
  const bool keep;  ///< in the cache

  void run(const http::Write& write) const;
};

void Encoding::run(const http::Write& write) const {
  auto kept = std::make_shared<Payload>();
  const std::unique_ptr<Encoder> encoder = encoder_of(coding, Effort::fast, plain->size());
  std::string out;
  const auto send = [&] {
    if (!write(out)) return false;
    if (keep) kept->add(std::move(out));
    out = {};
    return true;
  };
  for (Piece piece : plain->pieces()) {
    while (!piece.empty()) {
      const Piece part = piece.first(std::min(piece.size(), part_size));
      piece = piece.subspan(part.size());
      {
        const Slot slot(service);
        encoder->add(part, out);
      }
      if (out.size() >= sent_size && !send()) return;
    }
  }
  encoder->end(out);
  if (!out.empty() && !send()) return;
  if (!keep) return;
  auto made = std::make_shared<CachedModel>();
  made->payload = std::move(kept);
  service.cache.put(key, std::move(made));
}

/// The plain model as a body.
std::optional<CodedBody> plain_body(const RequestContext& call, const std::shared_ptr<const Payload>& payload,
                                    Coding coding) {
  auto held = call.service.in_flight_memory.hold(payload);
  if (!held) return std::nullopt;
  const std::uint64_t size = held->size();
  return CodedBody{coding, http::Slice{std::move(held), 0, size}};
}

}  // namespace

std::optional<CodedBody> coded_body(const RequestContext& call, const TaggedRequest& wanted,
                                    const Cache::Entry& model, Coding best) {
  Service& service = call.service;
  const std::shared_ptr<const Payload>& plain = model->payload;
  if (stays_plain(call, *plain, best)) return plain_body(call, plain, Coding::identity);
  const std::string key = std::string(name_of(best)) + " " + wanted.request.canonical();
  Cache::Entry known = service.cache.find(key);
  if (known && !known->payload && !takes_identity(call)) known = nullptr;  // the client refuses a plain body
  // HTTP/1.0 has no bodies of unknown length.
  if (!known && (plain->size() <= encoded_at_once || call.request.minor == 0)) {
    known = encoded(call, model, best);
    service.cache.put(key, known);
  }
  if (!known && takes_identity(call)) {
    const Slot slot(service);
    if (likely_saving(plain->pieces()) < least_saving) {
      known = std::make_shared<CachedModel>();  // without a payload: it stays plain
      service.cache.put(key, known);
    }
  }
  if (known) {
    return known->payload ? plain_body(call, known->payload, best)
                          : plain_body(call, plain, Coding::identity);
  }
  const bool keep = plain->size() <= std::min(largest_kept, service.config.cache_bytes / 2);
  auto held = service.in_flight_memory.hold(plain, encoder_memory + (keep ? plain->size() : 0));
  if (!held) return std::nullopt;
  const auto encoding = std::make_shared<const Encoding>(Encoding{service, std::move(held), best, key, keep});
  return CodedBody{best, http::Stream([encoding](const http::Write& write) { encoding->run(write); })};
}

bool is_private_address(std::string_view address) {
  if (address.find(':') != std::string_view::npos) {
    return address == "::1" || address.starts_with("fc") || address.starts_with("fd") ||
           address.starts_with("fe80:");
  }
  const auto first = http::parse_number<int>(http::take_part(address, '.'));
  const auto second = http::parse_number<int>(http::take_part(address, '.'));
  if (!first || !second) return false;
  return *first == 10 || *first == 127 || (*first == 192 && *second == 168) ||
         (*first == 169 && *second == 254) || (*first == 172 && *second >= 16 && *second <= 31);
}

}  // namespace seedmesh
