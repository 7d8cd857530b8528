#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "bench/kernels/kernel_subject.h"

// Each kernel in each form, on rows that a cache holds.

namespace facescan::bench {
namespace {

struct Form {
    const char* name;
    const Kernels* kernels;  ///< null where the build has none
};

void registerSubject(const KernelSubject& subject, const Form& form) {
    const auto runs = [subject, form](benchmark::State& state) {
        KernelRows rows(subject.items);
        const KernelCall call = subject.prepare(rows);
        for (auto _ : state) {
            call(*form.kernels);
            benchmark::ClobberMemory();
        }
        state.counters["bytes"] = rows.bytes();
        state.counters["items"] = subject.items;
        state.SetBytesProcessed(std::int64_t(double(state.iterations()) * rows.bytes()));
        state.SetItemsProcessed(state.iterations() * subject.items);
    };
    // There are many, and a call takes a microsecond: a hundredth of a second has enough of them.
    benchmark::RegisterBenchmark((std::string("kernel/") + subject.name + '/' + form.name).c_str(),
                                 runs)
        ->MinTime(0.01);
}

[[maybe_unused]] const bool kRegistered = [] {
    for (const auto& subjects : {pixelKernels(), edgeKernels(), pointKernels(), motionKernels(),
                                 windowKernels(), quadKernels()}) {
        for (const KernelSubject& subject : subjects) {
            for (const Form& form :
                 {Form{"plain", &plainKernels()}, Form{"portable", &portableKernels()},
                  Form{"neon", neonKernels()}}) {
                if (form.kernels) registerSubject(subject, form);
            }
        }
    }
    return true;
}();

}  // namespace
}  // namespace facescan::bench
