#pragma once

namespace facescan {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP is only noted, so that what is being written
/// can be finished. The second has its usual effect.
class Interruption {
public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    static bool noted();

    /// Ends the process by the signal that was noted, if any.
    static void obey();
};

}  // namespace facescan
