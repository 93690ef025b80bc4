#pragma once
/// SEEDMESH_WIDE before a function: all it calls is made part of it, and it is compiled twice more for
/// processors with vectors of 256 and of 512 bits (AVX2, AVX-512); the program takes what its processor has
/// when it starts. The
/// bits of the results are the same: nothing but the number of lanes differs, and no product and sum are
/// contracted. For loops over arrays that the compiler makes vectors of. Where a choice at the start is not
/// to be had (Clang inlines or chooses, not both; sanitizers are not ready so early), it is compiled once.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEEDMESH_WIDE __attribute__((flatten, target_clones("avx512f", "avx2", "default")))
#else
#define SEEDMESH_WIDE __attribute__((flatten))
#endif
