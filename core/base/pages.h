#pragma once
/// Memory straight from the kernel, in whole pages.
#include <cstddef>

namespace seedmesh::pages {

#if defined(__linux__)
constexpr bool can_map = true;
constexpr std::size_t huge_page = std::size_t{2} << 20U;
/// The largest base page of any supported machine.
constexpr std::size_t largest_page = std::size_t{64} << 10U;
#else
constexpr bool can_map = false;
constexpr std::size_t huge_page = 1, largest_page = 1;
#endif

/// Returns the smallest multiple of `to` that is at least `bytes`. `to` is greater than 0.
constexpr std::size_t rounded(std::size_t bytes, std::size_t to) { return (bytes + to - 1) / to * to; }

/// Maps `bytes` bytes, a multiple of the page size. Mappings of at least huge_page bytes are advised to use
/// huge pages (MADV_HUGEPAGE). Throws std::bad_alloc. Only where can_map; otherwise returns null.
std::byte* map(std::size_t bytes);
/// Enlarges a mapping from `before` to `after` bytes. The address may change; the content is kept. Only where
/// can_map; otherwise returns null.
std::byte* remap(std::byte* old, std::size_t before, std::size_t after);
/// Unmaps whole pages: a mapping or any part of one.
void unmap(std::byte* memory, std::size_t bytes);

}  // namespace seedmesh::pages
