#include "solver/mass_scaling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plash {

namespace {

/// Of all elements as they stand, before TSSFAC; infinite without any.
double smallest_element_step(const Scene& scene)
{
    ElementResults results;
    results.steps_wanted = true;
    for (const auto& term : scene.terms) term->collect(scene.state, results);
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& element : results.steps) smallest = std::min(smallest, element.step);
    return smallest;
}

/// DT2MS, or what DT2MSF makes of it [time]; 0: masses stay.
double wanted_step(const Scene& scene)
{
    const TimeControls& control = scene.model.controls.time;
    if (control.mass_scaled_step != 0 || control.mass_scaled_share == 0) return control.mass_scaled_step;
    const double smallest = smallest_element_step(scene);
    return std::isfinite(smallest) ? -control.mass_scaled_share * smallest : 0;
}

} // namespace

SelectiveMasses scale_masses(Scene& scene)
{
    const TimeControls& control = scene.model.controls.time;
    SelectiveMasses selective;
    const double wanted = wanted_step(scene);
    if (wanted == 0) return selective;
    const auto& parts = control.selective_parts;
    const auto is_selective = [&](const Term& term) {
        const Index part = term.scaled_part();
        return control.selective_mass && part != none &&
               (parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end());
    };
    const double mass = std::accumulate(scene.state.mass.begin(), scene.state.mass.end(), 0.0);
    double added = 0;
    for (auto& term : scene.terms) {
        if (is_selective(*term) &&
            term->scale_selectively(std::abs(wanted), wanted < 0, scene.state, selective))
            continue;
        const double more = term->scale_mass(std::abs(wanted), wanted < 0, scene.state);
        if (more != 0) scene.masses.added.emplace_back(term->name(), more);
        added += more;
    }
    scene.added_mass_ratio = scene.masses.added_ratio = mass > 0 ? added / mass : 0;
    return selective;
}

} // namespace plash
