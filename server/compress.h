#pragma once
/// zlib in three forms: gzip for answers, raw deflate for permalinks, and the bounded way back.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seedmesh {

/// One gzip member of all pieces. Models take level 1: vertex data hardly gains from more, at several times
/// the cost.
std::string gzip(const std::vector<std::span<const std::byte>>& pieces, int level);
std::string gzip(std::string_view text, int level = 6);

std::string deflate_raw(std::string_view text);

/// Nothing where `data` is not one whole raw deflate stream, or opens to more than `most` bytes.
std::optional<std::string> inflate_raw(std::string_view data, std::size_t most);

}  // namespace seedmesh
