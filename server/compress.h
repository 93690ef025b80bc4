#pragma once
/// Content codings for answers; raw deflate for permalinks, and the bounded way back.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/negotiate.h"

namespace seedmesh {

/// What an answer is worth: a model, whose vertex data hardly gains from more, at several times the cost; a
/// text made at the moment; a text that is made once.
enum class Effort { model, text, once };

/// All pieces in one stream of a coding other than identity.
std::string encode(Coding coding, const std::vector<std::span<const std::byte>>& pieces, Effort effort);
std::string encode(Coding coding, std::string_view text, Effort effort);

std::string deflate_raw(std::string_view text);

/// Nothing where `data` is not one whole raw deflate stream, or opens to more than `most` bytes.
std::optional<std::string> inflate_raw(std::string_view data, std::size_t most);

}  // namespace seedmesh
