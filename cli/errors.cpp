#include "cli/errors.h"

#include <new>

#include "capture/bundle_error.h"
#include "export/atomic_file.h"
#include "export/read_mesh.h"

namespace facescan {

ErrorReport describeError(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const CommandError& known) {
        return {known.status(), known.what()};
    } catch (const BundleError& bundle) {
        return {EX_DATAERR, bundle.what()};
    } catch (const ReadError& read) {
        return {EX_DATAERR, read.what()};
    } catch (const WriteError& write) {
        return {EX_CANTCREAT, write.what()};
    } catch (const std::bad_alloc&) {
        return {EX_OSERR, "not enough memory"};
    } catch (const std::exception& other) {
        return {EX_SOFTWARE, std::string("internal error: ") + other.what()};
    }
}

}  // namespace facescan
