#pragma once
/// Memory straight from the kernel, in whole pages.
#include <cstddef>

namespace seedmesh::pages {

#if defined(__linux__)
constexpr bool can_map = true;
constexpr std::size_t huge_page = std::size_t{2} << 20U;
constexpr std::size_t largest_page = std::size_t{64} << 10U;  ///< of the small ones, on any machine
#else
constexpr bool can_map = false;
constexpr std::size_t huge_page = 1, largest_page = 1;
#endif

constexpr std::size_t rounded(std::size_t bytes, std::size_t to) { return (bytes + to - 1) / to * to; }

/// `room` bytes, a number of pages; from a huge page on with huge pages advised. Throws std::bad_alloc.
std::byte* map(std::size_t room);
/// The same bytes with more room behind them, maybe elsewhere.
std::byte* grown(std::byte* old, std::size_t before, std::size_t after);
/// Any part of what was mapped, in whole pages.
void unmap(std::byte* memory, std::size_t room);

}  // namespace seedmesh::pages
