#pragma once
/// Writes WebP files (RFC 9649) with libwebp: colours with loss, alpha without.
///
/// Equal pixels give equal bytes with the same version of libwebp, which the engine version names, on every
/// processor. This code replaces everything that libwebp would compute in floating point: it converts colours to
/// YUV and compresses alpha with integers. Segments, whose strength libwebp computes with a power, are off. What
/// remains is the transform, the choice of modes and the arithmetic coder of VP8, which are integers in all of
/// libwebp's variants by processor.
#include <cstdint>

#include "core/base/array.h"
#include "core/texture/png.h"

namespace seedmesh::texture {

/// Greatest width and height of the format.
constexpr std::uint32_t longest_webp_side = 16'383;

/// How much the colours may lose. `fine` is for normals, whose errors change the shading. `quick` takes a third
/// of the time and is meant for pictures that are shown only once.
enum class WebpQuality { quick = 75, usual = 85, fine = 92 };

/// Returns the version of libwebp's encoder, as 0x010204.
int webp_encoder_version();

/// Writes pixels of 8 bits a channel: grey, RGB or RGBA. Both sides are from 1 to longest_webp_side (asserted). Cost:
/// about 60 ns a pixel.
Array<std::uint8_t> encode_webp(const PictureView& picture, WebpQuality quality, const Job& job);

}  // namespace seedmesh::texture
