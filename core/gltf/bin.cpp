#include "core/gltf/bin.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

#include "core/base/array.h"

namespace seedmesh::gltf {
namespace {

/// Small enough that a reader which uploads whole views for one accessor wastes little, large enough that
/// thousands of small meshes need few views.
constexpr std::uint64_t shared_view_bytes = std::uint64_t{1} << 20U;

constexpr std::size_t gathered_bytes = 4096;  ///< below this a copy is cheaper than one more piece to send

constexpr std::byte zeros[4] = {};

constexpr std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) & ~std::uint64_t{3}; }

bool fits(const Bin::View& view, Pool pool, std::uint64_t bytes) {
  return view.pool == pool && pool != Pool::image && padded(view.length) + bytes <= shared_view_bytes;
}

constexpr int array_buffer = 34962, element_array_buffer = 34963;

}  // namespace

std::uint32_t stride_of(Pool pool) {
  switch (pool) {
    case Pool::index2:
    case Pool::sequence2:
      return 2;
    case Pool::vertex4:
    case Pool::index4:
    case Pool::sequence4:
      return 4;
    case Pool::vertex8:
    case Pool::octahedral8:
    case Pool::exponential8:
      return 8;
    case Pool::vertex12:
      return 12;
    case Pool::vertex16:
      return 16;
    case Pool::keys:
    case Pool::binds:
    case Pool::image:
      return 0;
  }
  return 0;
}

int target_of(Pool pool) {
  switch (pool) {
    case Pool::vertex4:
    case Pool::vertex8:
    case Pool::vertex12:
    case Pool::vertex16:
    case Pool::octahedral8:
    case Pool::exponential8:
      return array_buffer;
    case Pool::index2:
    case Pool::index4:
    case Pool::sequence2:
    case Pool::sequence4:
      return element_array_buffer;
    case Pool::keys:
    case Pool::binds:
    case Pool::image:
      return 0;
  }
  return 0;
}

Pool vertex_pool(const Column& column) {
  if (column.filter == Filter::octahedral) return Pool::octahedral8;
  if (column.filter == Filter::exponential) return Pool::exponential8;
  switch (column.stride()) {
    case 4:
      return Pool::vertex4;
    case 8:
      return Pool::vertex8;
    case 12:
      return Pool::vertex12;
    default:
      assert(column.stride() == 16);
      return Pool::vertex16;
  }
}

Pool index_pool(const Column& column) { return column.stride() == 2 ? Pool::index2 : Pool::index4; }

bool Bin::has_own_view(std::uint64_t bytes) { return bytes >= shared_view_bytes; }

int Bin::add(Pool pool, Slice slice) {
  assert(order_.empty() && !slice.bytes.empty());
  items_.push_back({pool, std::move(slice)});
  return static_cast<int>(items_.size()) - 1;
}

void Bin::arrange(Packing packing) {
  order_.resize(items_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(),
                   [this](std::size_t a, std::size_t b) { return items_[a].pool < items_[b].pool; });
  locations_.resize(items_.size());
  for (const std::size_t number : order_) {
    const Item& item = items_[number];
    const std::uint64_t bytes = item.slice.size();
    if (views_.empty() || !fits(views_.back(), item.pool, bytes)) {
      size_ = padded(size_);
      views_.push_back({.pool = item.pool, .offset = size_});
    } else {
      if (packing == Packing::aligned) size_ = padded(size_);
      if (target_of(item.pool) == array_buffer) views_.back().stride = stride_of(item.pool);
    }
    View& view = views_.back();
    locations_[number] = {static_cast<int>(views_.size()) - 1, size_ - view.offset};
    view.length = size_ - view.offset + bytes;
    size_ += bytes;
  }
  size_ = padded(size_);
}

std::vector<std::vector<Slice>> Bin::slices() const {
  std::vector<std::vector<Slice>> inside(views_.size());
  for (const std::size_t number : order_) {
    inside[static_cast<std::size_t>(locations_[number].view)].push_back(items_[number].slice);
  }
  return inside;
}

void Bin::drain(Job& job, const std::function<void(Slice)>& sink) {
  for (std::size_t first = 0; first < order_.size();) {
    std::size_t last = first;
    std::size_t bytes = 0;
    while (last < order_.size() && items_[order_[last]].slice.bytes.size() < gathered_bytes) {
      bytes += padded(items_[order_[last++]].slice.bytes.size());
    }
    if (last == first) {
      Slice slice = std::move(items_[order_[first++]].slice);
      const std::size_t padding = padded(slice.bytes.size()) - slice.bytes.size();
      sink(std::move(slice));
      if (padding > 0) sink({nullptr, std::span(zeros).first(padding)});
      continue;
    }
    auto block = std::make_shared<Array<std::byte>>(job);
    block->reserve(bytes);
    for (; first < last; ++first) {
      const Slice slice = std::move(items_[order_[first]].slice);
      block->append(slice.bytes);
      block->append(std::span(zeros).first(padded(slice.bytes.size()) - slice.bytes.size()));
    }
    const auto whole = std::as_const(*block).span();
    sink({std::move(block), whole});
    job.check();
  }
}

void refuse_beyond_4_gib(std::uint64_t bytes, const Job& job) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - 1;
  if (bytes <= most) return;
  job.refuse(limit_issue({Resource::file_bytes, most, bytes}, "the file would have " + std::to_string(bytes) +
                                                                  " bytes; its format ends at 4 GiB"));
}

Payload raw(Bin bin, Job& job) {
  Payload payload;
  bin.drain(job, [&](Slice slice) { payload.add(std::move(slice.owner), slice.bytes); });
  return payload;
}

}  // namespace seedmesh::gltf
