#pragma once

#include "assess/curve.h"

namespace plash {

/// How far a computed curve is from a reference, by size and by timing: Sprague & Geers (2004), "A
/// spectral-element method for modelling cavitation in transient fluid-structure interaction", equations as
/// in Schwer (2007), "Validation metrics for response histories". All are 0 for equal curves.
struct SpragueGeers {
    double magnitude = 0;     ///< sqrt(int c^2 / int m^2) - 1: +0.1 means 10 % too large [-]
    double phase = 0;         ///< acos(int m c / sqrt(int m^2 int c^2)) / pi, from 0 to 1 [-]
    double comprehensive = 0; ///< root of the sum of both squares [-]
};

/// Differences of one computed curve to its reference over the span that both cover.
struct CurveErrors {
    double peak = 0;      ///< (computed - reference) / reference of the values largest in size [-]
    double peak_time = 0; ///< computed - reference [time]
    double impulse = 0;   ///< (computed - reference) / reference of the integrals over time [-]
    double rms = 0;       ///< root of the mean square difference over the reference's largest size [-]
    SpragueGeers sprague_geers;
};

/// Both curves are sampled at `samples` even times of their common span. A reference that is zero throughout
/// gives infinite or undefined (not a number) relative errors; by Sprague & Geers two such curves agree.
/// Wants a common span and samples > 1.
CurveErrors curve_errors(const TimeCurve& reference, const TimeCurve& computed, std::size_t samples = 1001);

} // namespace plash
