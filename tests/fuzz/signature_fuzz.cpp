/// A target of any characters: no signature in it holds but those that were made here.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "server/signature.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seedmesh;
  constexpr std::int64_t now = 1'000;
  const std::string_view target(reinterpret_cast<const char*>(data), size);
  static const std::vector<SigningKey> keys = {{"a", "the first secret"}, {"b", "the second secret"}};
  const SignatureCheck check = check_signature(target, keys, now);
  if (check.state == SignatureState::good || check.state == SignatureState::expired) std::abort();
  if (check.target_size > target.size()) std::abort();

  const std::string link = sign_target(target, keys[1], now + 1);
  const SignatureCheck signed_check = check_signature(link, keys, now);
  if (signed_check.state != SignatureState::good || signed_check.target_size != target.size()) std::abort();
  if (check_signature(link, keys, now + 1).state != SignatureState::expired) std::abort();
  if (check_signature(link, {keys[0]}, now).state != SignatureState::wrong) std::abort();
  std::string changed = link;
  char& c = changed[size % changed.size()];
  c = static_cast<char>(c ^ 1);
  if (check_signature(changed, keys, now).state == SignatureState::good) std::abort();
  return 0;
}
