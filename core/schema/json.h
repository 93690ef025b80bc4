#pragma once
/// JSON of the service: one strict parser, and one canonical text.
#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/base/json_pointer.h"
#include "core/base/result.h"

namespace seedmesh {

/// Members of objects are sorted by the bytes of their keys, so that iteration is deterministic.
using Json = nlohmann::json;

class Job;

/// The limits of parse_json.
struct JsonLimits {
  std::size_t depth = 64;  ///< depth of nested lists and objects
  /// Number of values of any type. A value takes up to 80 bytes of memory, but its text can be as short as 2
  /// bytes.
  std::size_t values = 2'000'000;
  const Job* job = nullptr;  ///< checked for stop and deadline, so that Stop is thrown; may be null
};

/// Parses a JSON text strictly after RFC 8259. Duplicate members, invalid UTF-8, text after the value, NaN and
/// comments are Code::malformed, with line and column in the whole text where they are known. Integers of up to
/// 64 bits are exact, larger ones become the nearest double, and -0 becomes 0. A number beyond the range of a
/// double (1e999) is Code::invalid at its own pointer. Throws only std::bad_alloc and the Stop of the
/// job; does not recurse. Cost: linear.
Result<Json> parse_json(std::string_view text, const JsonLimits& limits = {});

/// Returns the canonical text: no spaces, sorted members, numbers as ECMAScript prints them (7.0 is 7), and escapes
/// only where JSON requires them. Equal values give equal texts. All numbers have to be finite. `check`, which
/// may be empty, is called with every 4,096 values, and may throw to end the work. Cost: linear.
std::string canonical_text(const Json& value, const std::function<void()>& check = {});

/// Applies a JSON Merge Patch (RFC 7396): objects are merged member by member, null removes a member, and any
/// other value replaces the old one. Recurses as deep as the patch, whose depth parse_json bounds.
void merge_patch(Json& target, const Json& patch);

/// Returns the text of ECMAScript's Number::toString (ECMA-262, 6.1.6.1.20): the fewest digits that read back as the
/// same double. Numbers from 1e21 and below 1e-6 get an exponent; -0 gives "0". `number` has to be finite.
std::string number_text(double number);

/// Returns the offset of the first byte that is not valid UTF-8, or npos. Overlong forms, surrogates and code points
/// above U+10FFFF are invalid.
std::size_t find_bad_utf8(std::string_view text);

/// Returns the first `most` code points of UTF-8 `text`, followed by "…" if there are more. For messages.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace seedmesh
