#pragma once

#include "cli/replay_plan.h"
#include "cli/report_json.h"

namespace facescan {

/// The report of an earlier replay that made all that is asked for now, of the same bundle, and
/// whose files stand in the job's folder in their full size. Null where there is none.
/// @param request  requestJson() of now
/// @throws BundleError where the bundle breaks a rule
Json finishedReport(const ReplayJob& job, const Json& request);

}  // namespace facescan
