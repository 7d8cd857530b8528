#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#if defined(__ARM_NEON)
#include <arm_neon.h>
#define FACESCAN_HAS_NEON 1
#elif defined(FACESCAN_SIMDE)
#define SIMDE_ENABLE_NATIVE_ALIASES
#include <simde/arm/neon.h>
#define FACESCAN_HAS_NEON 1
#endif

/// Whatever a kernel calls is inlined into it, and so compiled for the kernel's instruction set.
#define FACESCAN_INLINE inline __attribute__((always_inline))
/// The same for a lambda, after its parameters.
#define FACESCAN_INLINE_LAMBDA __attribute__((always_inline))

namespace facescan {

/// Floats side by side: the type over which the float kernels are written, once for all forms.
///
/// Each form below offers the same operations, every one of which rounds once. A kernel whose lanes
/// do not mix therefore gives the same bits in all of them. There is no division and no root, which
/// ARMv7's NEON lacks: see reciprocal() and inverseRoot().
///
/// One float: the plain form, a reference for the others, and the one for what is left at the end
/// of a row.
struct OneLane {
    static constexpr int kCount = 1;
    struct Mask {
        bool m;
        friend FACESCAN_INLINE Mask operator&(Mask a, Mask b) { return {a.m && b.m}; }
        friend FACESCAN_INLINE Mask operator|(Mask a, Mask b) { return {a.m || b.m}; }
        FACESCAN_INLINE Mask operator!() const { return {!m}; }
        FACESCAN_INLINE void store(std::uint8_t* p) const { *p = m; }
        static FACESCAN_INLINE Mask load(const std::uint8_t* p) { return {*p != 0}; }
    };
    float v;

    OneLane() = default;
    // NOLINTBEGIN(google-explicit-constructor): a number becomes lanes as an int becomes a float.
    FACESCAN_INLINE OneLane(float value) : v(value) {}
    // NOLINTEND(google-explicit-constructor)
    static FACESCAN_INLINE OneLane load(const float* p) { return *p; }
    static FACESCAN_INLINE OneLane load(const std::int32_t* p) { return float(*p); }
    /// first, first + 1, …
    static FACESCAN_INLINE OneLane countFrom(float first) { return first; }
    FACESCAN_INLINE void store(float* p) const { *p = v; }
    /// Stores without the fraction.
    FACESCAN_INLINE void store(std::int32_t* p) const { *p = std::int32_t(v); }

    friend FACESCAN_INLINE OneLane operator+(OneLane a, OneLane b) { return a.v + b.v; }
    friend FACESCAN_INLINE OneLane operator-(OneLane a, OneLane b) { return a.v - b.v; }
    friend FACESCAN_INLINE OneLane operator*(OneLane a, OneLane b) { return a.v * b.v; }
    friend FACESCAN_INLINE Mask operator<(OneLane a, OneLane b) { return {a.v < b.v}; }
    friend FACESCAN_INLINE Mask operator<=(OneLane a, OneLane b) { return {a.v <= b.v}; }
    friend FACESCAN_INLINE OneLane select(Mask m, OneLane a, OneLane b) { return m.m ? a : b; }
    friend FACESCAN_INLINE OneLane abs(OneLane a) {
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(a.v) & 0x7FFFFFFFu);
    }
    friend FACESCAN_INLINE OneLane reciprocalGuess(OneLane a) {
        return std::bit_cast<float>(0x7EF311C7u - std::bit_cast<std::uint32_t>(a.v));
    }
    friend FACESCAN_INLINE OneLane inverseRootGuess(OneLane a) {
        return std::bit_cast<float>(0x5F375A86u - (std::bit_cast<std::uint32_t>(a.v) >> 1));
    }
};

/// Eight floats in a vector of the compiler's own, which it maps to what the target has.
struct VectorLanes {
    static constexpr int kCount = 8;
    using Floats [[gnu::vector_size(32)]] = float;
    using Ints [[gnu::vector_size(32)]] = std::int32_t;
    using Words [[gnu::vector_size(32)]] = std::uint32_t;
    using Bytes [[gnu::vector_size(8)]] = std::uint8_t;
    struct Mask {
        Ints m;
        friend FACESCAN_INLINE Mask operator&(Mask a, Mask b) { return {a.m & b.m}; }
        friend FACESCAN_INLINE Mask operator|(Mask a, Mask b) { return {a.m | b.m}; }
        FACESCAN_INLINE Mask operator!() const { return {~m}; }
        FACESCAN_INLINE void store(std::uint8_t* p) const {
            const Bytes bytes = __builtin_convertvector(m & 1, Bytes);
            std::memcpy(p, &bytes, sizeof bytes);
        }
        static FACESCAN_INLINE Mask load(const std::uint8_t* p) {
            Bytes bytes;
            std::memcpy(&bytes, p, sizeof bytes);
            return {__builtin_convertvector(bytes, Ints) != 0};
        }
    };
    Floats v;

    VectorLanes() = default;
    // NOLINTBEGIN(google-explicit-constructor)
    FACESCAN_INLINE VectorLanes(Floats value) : v(value) {}
    FACESCAN_INLINE VectorLanes(float value) : v(value - Floats{}) {}
    // NOLINTEND(google-explicit-constructor)
    static FACESCAN_INLINE VectorLanes load(const float* p) {
        Floats value;
        std::memcpy(&value, p, sizeof value);
        return value;
    }
    static FACESCAN_INLINE VectorLanes load(const std::int32_t* p) {
        Ints value;
        std::memcpy(&value, p, sizeof value);
        return __builtin_convertvector(value, Floats);
    }
    static FACESCAN_INLINE VectorLanes countFrom(float first) {
        return VectorLanes(first) + Floats{0, 1, 2, 3, 4, 5, 6, 7};
    }
    FACESCAN_INLINE void store(float* p) const { std::memcpy(p, &v, sizeof v); }
    FACESCAN_INLINE void store(std::int32_t* p) const {
        const Ints value = __builtin_convertvector(v, Ints);
        std::memcpy(p, &value, sizeof value);
    }

    friend FACESCAN_INLINE VectorLanes operator+(VectorLanes a, VectorLanes b) { return a.v + b.v; }
    friend FACESCAN_INLINE VectorLanes operator-(VectorLanes a, VectorLanes b) { return a.v - b.v; }
    friend FACESCAN_INLINE VectorLanes operator*(VectorLanes a, VectorLanes b) { return a.v * b.v; }
    friend FACESCAN_INLINE Mask operator<(VectorLanes a, VectorLanes b) { return {a.v < b.v}; }
    friend FACESCAN_INLINE Mask operator<=(VectorLanes a, VectorLanes b) { return {a.v <= b.v}; }
    friend FACESCAN_INLINE VectorLanes select(Mask m, VectorLanes a, VectorLanes b) {
        return m.m ? a.v : b.v;
    }
    friend FACESCAN_INLINE VectorLanes abs(VectorLanes a) {
        return std::bit_cast<Floats>(std::bit_cast<Words>(a.v) & 0x7FFFFFFFu);
    }
    friend FACESCAN_INLINE VectorLanes reciprocalGuess(VectorLanes a) {
        return std::bit_cast<Floats>(0x7EF311C7u - std::bit_cast<Words>(a.v));
    }
    friend FACESCAN_INLINE VectorLanes inverseRootGuess(VectorLanes a) {
        return std::bit_cast<Floats>(0x5F375A86u - (std::bit_cast<Words>(a.v) >> 1));
    }
};

#ifdef FACESCAN_HAS_NEON
/// Four floats in a NEON register.
struct NeonLanes {
    static constexpr int kCount = 4;
    struct Mask {
        uint32x4_t m;
        friend FACESCAN_INLINE Mask operator&(Mask a, Mask b) { return {vandq_u32(a.m, b.m)}; }
        friend FACESCAN_INLINE Mask operator|(Mask a, Mask b) { return {vorrq_u32(a.m, b.m)}; }
        FACESCAN_INLINE Mask operator!() const { return {vmvnq_u32(m)}; }
        FACESCAN_INLINE void store(std::uint8_t* p) const {
            const uint16x4_t halves = vmovn_u32(vandq_u32(m, vdupq_n_u32(1)));
            const uint8x8_t bytes = vmovn_u16(vcombine_u16(halves, halves));
            const std::uint32_t word = vget_lane_u32(vreinterpret_u32_u8(bytes), 0);
            std::memcpy(p, &word, sizeof word);
        }
        static FACESCAN_INLINE Mask load(const std::uint8_t* p) {
            std::uint32_t word;
            std::memcpy(&word, p, sizeof word);
            const uint8x8_t bytes = vreinterpret_u8_u32(vdup_n_u32(word));
            const uint32x4_t words = vmovl_u16(vget_low_u16(vmovl_u8(bytes)));
            return {vmvnq_u32(vceqq_u32(words, vdupq_n_u32(0)))};
        }
    };
    float32x4_t v;

    NeonLanes() = default;
    // NOLINTBEGIN(google-explicit-constructor)
    FACESCAN_INLINE NeonLanes(float32x4_t value) : v(value) {}
    FACESCAN_INLINE NeonLanes(float value) : v(vdupq_n_f32(value)) {}
    // NOLINTEND(google-explicit-constructor)
    static FACESCAN_INLINE NeonLanes load(const float* p) { return vld1q_f32(p); }
    static FACESCAN_INLINE NeonLanes load(const std::int32_t* p) {
        return vcvtq_f32_s32(vld1q_s32(p));
    }
    static FACESCAN_INLINE NeonLanes countFrom(float first) {
        constexpr float kCounting[4] = {0, 1, 2, 3};
        return vaddq_f32(vdupq_n_f32(first), vld1q_f32(kCounting));
    }
    FACESCAN_INLINE void store(float* p) const { vst1q_f32(p, v); }
    FACESCAN_INLINE void store(std::int32_t* p) const { vst1q_s32(p, vcvtq_s32_f32(v)); }

    friend FACESCAN_INLINE NeonLanes operator+(NeonLanes a, NeonLanes b) {
        return vaddq_f32(a.v, b.v);
    }
    friend FACESCAN_INLINE NeonLanes operator-(NeonLanes a, NeonLanes b) {
        return vsubq_f32(a.v, b.v);
    }
    friend FACESCAN_INLINE NeonLanes operator*(NeonLanes a, NeonLanes b) {
        return vmulq_f32(a.v, b.v);
    }
    friend FACESCAN_INLINE Mask operator<(NeonLanes a, NeonLanes b) {
        return {isGreater(b.v, a.v)};
    }
    friend FACESCAN_INLINE Mask operator<=(NeonLanes a, NeonLanes b) {
        return {isGreaterOrEqual(b.v, a.v)};
    }
    friend FACESCAN_INLINE NeonLanes select(Mask m, NeonLanes a, NeonLanes b) {
        return vbslq_f32(m.m, a.v, b.v);
    }
    friend FACESCAN_INLINE NeonLanes abs(NeonLanes a) { return vabsq_f32(a.v); }
    friend FACESCAN_INLINE NeonLanes reciprocalGuess(NeonLanes a) {
        const uint32x4_t bits = vreinterpretq_u32_f32(a.v);
        return vreinterpretq_f32_u32(vsubq_u32(vdupq_n_u32(0x7EF311C7u), bits));
    }
    friend FACESCAN_INLINE NeonLanes inverseRootGuess(NeonLanes a) {
        const uint32x4_t half = vshrq_n_u32(vreinterpretq_u32_f32(a.v), 1);
        return vreinterpretq_f32_u32(vsubq_u32(vdupq_n_u32(0x5F375A86u), half));
    }

private:
#if defined(__arm__)
    // For its own intrinsics GCC compares float by float here, 20 cycles each on a Cortex-A8, since
    // NEON takes the smallest floats for zero.
    static FACESCAN_INLINE uint32x4_t isGreater(float32x4_t a, float32x4_t b) {
        uint32x4_t result;
        asm("vcgt.f32 %q0, %q1, %q2" : "=w"(result) : "w"(a), "w"(b));
        return result;
    }
    static FACESCAN_INLINE uint32x4_t isGreaterOrEqual(float32x4_t a, float32x4_t b) {
        uint32x4_t result;
        asm("vcge.f32 %q0, %q1, %q2" : "=w"(result) : "w"(a), "w"(b));
        return result;
    }
#else
    static FACESCAN_INLINE uint32x4_t isGreater(float32x4_t a, float32x4_t b) {
        return vcgtq_f32(a, b);
    }
    static FACESCAN_INLINE uint32x4_t isGreaterOrEqual(float32x4_t a, float32x4_t b) {
        return vcgeq_f32(a, b);
    }
#endif
};
#endif

template <typename Lanes>
FACESCAN_INLINE Lanes smallerOf(Lanes a, Lanes b) {
    return select(a < b, a, b);
}
template <typename Lanes>
FACESCAN_INLINE Lanes largerOf(Lanes a, Lanes b) {
    return select(a < b, b, a);
}

/// 1 / a to the last bit or two, by three of Newton's steps from a guess on the exponent: the same
/// bits on every target, with or without a divider. `a` is neither zero nor beyond 1e37.
template <typename Lanes>
FACESCAN_INLINE Lanes reciprocal(Lanes a) {
    Lanes y = reciprocalGuess(a);
    for (int step = 0; step < 3; ++step) y = y * (Lanes(2.0f) - a * y);
    return y;
}

/// 1 / √a, likewise. `a` is positive.
template <typename Lanes>
FACESCAN_INLINE Lanes inverseRoot(Lanes a) {
    Lanes y = inverseRootGuess(a);
    const Lanes half = Lanes(0.5f) * a;
    for (int step = 0; step < 3; ++step) y = y * (Lanes(1.5f) - half * y * y);
    return y;
}

/// Calls body<L>(x) for x from `begin` to `end` in steps of as many lanes as L has: whole groups of
/// Lanes first, then single ones.
template <typename Lanes, typename Body>
FACESCAN_INLINE void forLanes(int begin, int end, Body body) {
    int x = begin;
    for (; x + Lanes::kCount <= end; x += Lanes::kCount) body.template operator()<Lanes>(x);
    for (; x < end; ++x) body.template operator()<OneLane>(x);
}

}  // namespace facescan
