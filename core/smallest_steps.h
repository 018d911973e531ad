#pragma once

#include "core/results.h"

#include <algorithm>
#include <tuple>

namespace plash {

/// How many of the smallest steps the summary of a model lists.
constexpr std::size_t listed_steps = 100;

/// Equal steps go by number, so that the list does not depend on the order of the terms.
inline bool is_smaller(const ElementResults::ElementStep& a, const ElementResults::ElementStep& b)
{
    return std::tie(a.step, a.kind, a.element) < std::tie(b.step, b.kind, b.element);
}

/// Adds a step to ElementResults::steps. Of many, steps that cannot be listed any more go: those of all
/// elements would make the largest memory of a run.
inline void add_step(ElementResults& results, const ElementResults::ElementStep& step)
{
    constexpr std::size_t many = 40 * listed_steps;
    results.steps.push_back(step);
    if (results.steps.size() < many) return;
    std::nth_element(results.steps.begin(), results.steps.begin() + listed_steps, results.steps.end(),
                     is_smaller);
    results.steps.resize(listed_steps);
}

} // namespace plash
