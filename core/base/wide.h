#pragma once
/// The compiler makes three versions of each function that is marked SEEDMESH_WIDE. The versions use vectors
/// of 128, 256 (AVX2) and 512 bits (AVX-512). All calls inside the function are inlined. The program selects
/// the version for its processor at start-up. All versions give the same bits, because they differ only in
/// the number of lanes, and the compiler never fuses a multiplication with an addition. Use it for loops over
/// arrays that the compiler vectorises. Clang and the sanitizers do not support this selection together with
/// inlining; there the function is compiled once.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEEDMESH_WIDE __attribute__((flatten, target_clones("avx512f", "avx2", "default")))
#else
#define SEEDMESH_WIDE __attribute__((flatten))
#endif
