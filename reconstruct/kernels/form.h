#pragma once

/// Compiles a kernel for the newer instruction sets of amd64 too; the loader takes the best that
/// the processor has. Left out where a sanitizer runs before the loader could ask.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FACESCAN_KERNEL \
    __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FACESCAN_KERNEL
#endif
