#pragma once

#include <sysexits.h>

#include <exception>
#include <stdexcept>
#include <string>

namespace facescan {

/// A scan shows no surface: the status of EX_TEMPFAIL, "the user is invited to retry".
inline constexpr int kNoSurface = EX_TEMPFAIL;

/// An error that knows its exit status (sysexits.h).
class CommandError : public std::runtime_error {
public:
    CommandError(int status, const std::string& message)
        : std::runtime_error(message), status_(status) {}

    int status() const { return status_; }

private:
    int status_;
};

/// What the user is told about an error.
struct ErrorReport {
    int status = EX_SOFTWARE;
    std::string message;
};

/// Sorts an exception of any of our libraries into the classes of sysexits.h.
ErrorReport describeError(const std::exception_ptr& error);

}  // namespace facescan
