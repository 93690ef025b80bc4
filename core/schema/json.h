#pragma once
/// JSON as the service takes and gives it: one strict way in, one canonical way out.
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace seedmesh {

/// Members of objects are sorted by their bytes, so that walking a value is deterministic.
using Json = nlohmann::json;

/// How far a text may go before it is refused unread.
struct JsonLimits {
  std::size_t depth = 64;          ///< nested lists and objects
  std::size_t values = 2'000'000;  ///< values of any kind: a value costs up to 80 bytes where the text has 2
};

/// Reads RFC 8259 and nothing more: duplicate members, bad UTF-8, text after the value, NaN and comments are
/// Code::malformed, at the line and column of the whole text where that is known. Never throws but for want
/// of memory, never recurses. Numbers: integers up to 64 bits are exact, -0 becomes 0, an integer beyond
/// becomes the nearest double; a number beyond a double (1e999) is Code::invalid at its own pointer. Cost:
/// linear.
Result<Json> parse_json(std::string_view text, const JsonLimits& limits = {});

/// The canonical text: no spaces, members sorted, numbers as ECMAScript prints them (7.0 is 7), only what
/// must be escaped escaped. Equal values give equal texts. A NaN or infinity is a broken promise of the
/// caller.
std::string canonical_text(const Json& value);

/// RFC 7396: `patch` over `target`; objects member by member, null removes, anything else replaces. Recurses
/// as deep as the patch, which parse_json has bounded.
void merge_patch(Json& target, const Json& patch);

/// One reference token of a JSON Pointer (RFC 6901) with its leading slash: "a/b" gives "/a~1b".
std::string pointer_token(std::string_view key);

/// The decimal digits ECMAScript's Number::toString gives (ECMA-262, 6.1.6.1.20): the shortest that read back
/// as the same double. 1e21 and more, and below 1e-6, get an exponent; -0 gives "0". Finite numbers only.
std::string number_text(double number);

/// Is it UTF-8 throughout (no overlong forms, no surrogates, nothing above U+10FFFF)? Gives the offset of the
/// first byte that is not, or std::string_view::npos.
std::size_t find_bad_utf8(std::string_view text);

/// The first `most` characters of UTF-8 `text`, with "…" where some were left off: for messages.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace seedmesh
