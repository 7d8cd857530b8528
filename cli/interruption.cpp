#include "cli/interruption.h"

#include <array>
#include <atomic>
#include <csignal>

namespace facescan {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

std::atomic<int> noted_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler writes it");

void note(int signal) {
    noted_signal = signal;
}

}  // namespace

Interruption::Interruption() {
    struct sigaction action = {};
    action.sa_handler = note;
    action.sa_flags = int(SA_RESETHAND) | SA_RESTART;
    for (const int signal : kSignals) {
        struct sigaction former = {};
        sigaction(signal, nullptr, &former);
        const bool is_ignored = former.sa_handler == SIG_IGN;  // as nohup asks
        if (!is_ignored) sigaction(signal, &action, nullptr);
    }
}

Interruption::~Interruption() {
    for (const int signal : kSignals) {
        struct sigaction former = {};
        sigaction(signal, nullptr, &former);
        if (former.sa_handler == note) std::signal(signal, SIG_DFL);
    }
}

bool Interruption::noted() {
    return noted_signal != 0;
}

void Interruption::obey() {
    if (!noted()) return;
    std::signal(noted_signal, SIG_DFL);
    std::raise(noted_signal);
}

}  // namespace facescan
