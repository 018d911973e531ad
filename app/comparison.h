#pragma once

#include "assess/iso_18571.h"
#include "assess/metrics.h"
#include "assess/run_cost.h"

#include <optional>
#include <string>
#include <vector>

namespace plash {

/// One run judged by one signal.
struct ComparedRun {
    std::string name; ///< its directory
    TimeCurve curve;
    Peak peak;
    double impulse = 0;
    CurveErrors errors; ///< to the reference, over the common span
    IsoRating rating;
    std::optional<RunCost> cost; ///< nothing for results of another code
    bool is_reference = false;
    bool on_front = false; ///< of error against CPU seconds
};

/// All runs by one signal.
struct SignalComparison {
    std::string signal;
    std::string reference; ///< where the reference comes from
    TimeCurve reference_curve;
    std::vector<ComparedRun> runs;
};

/// The error by which runs are ranked: "comprehensive" (Sprague & Geers), "peak", "impulse", "rms" or "iso"
/// (1 - rating); always positive [-].
double ranking_error(const ComparedRun& run, const std::string& kind);

/// For the screen: a line a run.
std::string comparison_text(const SignalComparison& comparison);

std::string comparison_csv(const std::vector<SignalComparison>& comparisons);
std::string comparison_json(const std::vector<SignalComparison>& comparisons);

/// One page with the curves laid over each other (zoomable) and the tables; `png`: bytes of the diagrams, or
/// empty.
std::string comparison_html(const std::vector<SignalComparison>& comparisons, std::string png);

/// The diagrams as a file for the drawing program (picture/diagram_file.h): histories, and error against cost
/// with the front where there are costs.
std::string comparison_diagrams(const std::vector<SignalComparison>& comparisons, const std::string& ranking);

} // namespace plash
