#pragma once

#include "materials/piecewise_linear_plasticity.h"

namespace plash {

/// Laws of von Mises plasticity with isotropic hardening whose flow stress is a formula, as a
/// PiecewiseLinearPlasticity with finely sampled curves:
///   *MAT_ISOTROPIC_ELASTIC_PLASTIC (012)   SIGY + ETAN p
///   *MAT_POWER_LAW_PLASTICITY (018)        K (e0 + p)^N, Cowper & Symonds
///   *MAT_SIMPLIFIED_JOHNSON_COOK (098)     (A + B p^N) (1 + C ln(rate / EPSO)), Johnson & Cook (1983)
///   *MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY (123) is read as 024; its own failure criteria are refused.
/// Curves are sampled at p = 2 (i / 200)^3, rates ten to the decade: the error stays below 2e-4 of the flow
/// stress. Source: keyword manual, volume II.
bool is_flow_law(std::string_view keyword);

/// DeckError for fields that are not supported.
PiecewiseLinearPlasticity read_flow_law(const Record& record, const Model& model);

} // namespace plash
