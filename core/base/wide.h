#pragma once
/// The compiler makes three versions of a function that is marked SEEDMESH_WIDE, and inlines all functions
/// that it calls. They use vectors of 128, 256 (AVX2) and 512 bits (AVX-512). The program selects the version
/// for its processor at start-up. Results have the same bits, because only the number of lanes differs and no
/// product and sum are contracted. Use it for loops over arrays that the compiler vectorises. Clang and the
/// sanitizers do not support this selection together with inlining; there the function is compiled once.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEEDMESH_WIDE __attribute__((flatten, target_clones("avx512f", "avx2", "default")))
#else
#define SEEDMESH_WIDE __attribute__((flatten))
#endif
