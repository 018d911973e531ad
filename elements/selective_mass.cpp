#include "elements/selective_mass.h"

#include "core/parallel.h"
#include "core/run_error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Residual of the solution over the right-hand side, in the norm of the diagonal's inverse.
constexpr double selective_tolerance = 1e-8;

/// function(place) for every place, on all threads; each writes what is its own.
template <class Function>
void for_each_place(std::size_t count, Function&& function)
{
    for_chunks(count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) function(i);
    });
}

Matrix3 inertia_of(const Vec3& arm)
{
    const double square = dot(arm, arm);
    return {{Vec3{square, 0, 0} - arm.x * arm, Vec3{0, square, 0} - arm.y * arm,
             Vec3{0, 0, square} - arm.z * arm}};
}

} // namespace

void SelectiveMass::start(std::vector<const Term*> holders, State& state)
{
    holders_ = std::move(holders);
    scale_the_ordinary_way(state);
    number_nodes(state.size());
    geometry_.resize(masses_.elements.size());
    mass_.resize(nodes_.size());
    more_mass_.resize(nodes_.size());
    motion_.resize(nodes_.size());
    corner_.linear.resize(masses_.corners.size());
    rotates_ = std::any_of(masses_.corners.begin(), masses_.corners.end(),
                           [](const auto& corner) { return corner.inertia != 0; });
    if (!rotates_) return;
    inertia_.resize(nodes_.size());
    more_inertia_.resize(nodes_.size());
    spin_.resize(nodes_.size());
    corner_.angular.resize(masses_.corners.size());
}

void SelectiveMass::scale_the_ordinary_way(State& state)
{
    SelectiveMasses rest;
    for (std::size_t e = 0; e < masses_.elements.size(); ++e) {
        const auto begin = masses_.corners.begin() + static_cast<std::ptrdiff_t>(masses_.elements[e].corner);
        const auto end = masses_.corners.begin() + static_cast<std::ptrdiff_t>(masses_.end_of(e));
        const bool all_move =
            std::all_of(begin, end, [&](const auto& corner) { return state.mass[corner.node] > 0; });
        if (all_move) {
            rest.begin(masses_.elements[e].kind, masses_.elements[e].number);
            rest.corners.insert(rest.corners.end(), begin, end);
            continue;
        }
        ++ordinary_count_;
        for (auto corner = begin; corner != end; ++corner) {
            if (state.mass[corner->node] == 0) continue;
            state.mass[corner->node] += corner->mass;
            if (state.rotational()) state.inertia[corner->node] += corner->inertia;
            ordinary_mass_ += corner->mass;
        }
    }
    masses_ = std::move(rest);
}

void SelectiveMass::number_nodes(std::size_t node_count)
{
    place_of_node_.assign(node_count, none);
    for (const auto& corner : masses_.corners) place_of_node_[corner.node] = 0;
    for (std::size_t node = 0; node < node_count; ++node) {
        if (place_of_node_[node] == none) continue;
        place_of_node_[node] = static_cast<Index>(nodes_.size());
        nodes_.push_back(static_cast<Index>(node));
    }
    first_.assign(nodes_.size() + 1, 0);
    for (const auto& corner : masses_.corners) {
        place_.push_back(place_of_node_[corner.node]);
        ++first_[place_.back() + 1];
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) first_[i + 1] += first_[i];
    std::vector<std::size_t> next = first_;
    slots_.resize(place_.size());
    for (std::size_t slot = 0; slot < place_.size(); ++slot) slots_[next[place_[slot]]++] = slot;
}

std::vector<std::string> SelectiveMass::notices(const State&) const
{
    std::vector<std::string> lines{fmt::format(
        "selective mass scaling (IMSCL): {} elements resist distortion with more mass, none is added to "
        "their rigid motion",
        masses_.elements.size())};
    if (ordinary_count_ > 0) {
        lines.push_back(fmt::format(
            "selective mass scaling (IMSCL): {} elements have nodes that rigid bodies or ties move; they "
            "are scaled the ordinary way, which adds {:.4g} to the mass",
            ordinary_count_, ordinary_mass_));
    }
    return lines;
}

void SelectiveMass::place_elements(const State& state)
{
    for_each_place(masses_.elements.size(), [&](std::size_t e) {
        Geometry& geometry = geometry_[e];
        const SelectiveMasses::Element& element = masses_.elements[e];
        const auto& deleted =
            element.kind == SelectiveMasses::Kind::shell ? state.deleted_shells : state.deleted_solids;
        const auto number = static_cast<std::size_t>(element.number);
        geometry.alive = number >= deleted.size() || !deleted[number];
        geometry.mass = 0;
        geometry.center = {};
        for (std::size_t c = element.corner; c < masses_.end_of(e); ++c) {
            const auto& corner = masses_.corners[c];
            geometry.mass += corner.mass;
            geometry.center += corner.mass * state.position[corner.node];
        }
        geometry.center *= 1 / geometry.mass;
        Matrix3 inertia{};
        for (std::size_t c = element.corner; c < masses_.end_of(e); ++c) {
            const auto& corner = masses_.corners[c];
            const Matrix3 arm = inertia_of(state.position[corner.node] - geometry.center);
            for (int i = 0; i < 3; ++i) {
                inertia.row[i] += corner.mass * arm.row[i];
                inertia.row[i].*vector_component[i] += corner.inertia;
            }
        }
        geometry.inertia = inverse(inertia);
    });
    for_each_place(nodes_.size(), [&](std::size_t i) {
        mass_[i] = state.mass[nodes_[i]];
        if (rotates_) inertia_[i] = state.inertia[nodes_[i]];
        more_mass_[i] = 0;
        if (rotates_) more_inertia_[i] = 0;
        for (std::size_t s = first_[i]; s < first_[i + 1]; ++s) {
            more_mass_[i] += masses_.corners[slots_[s]].mass;
            if (rotates_) more_inertia_[i] += masses_.corners[slots_[s]].inertia;
        }
    });
}

void SelectiveMass::multiply(const State& state, const Field& field, bool spun, Field& result)
{
    for_each_place(masses_.elements.size(), [&](std::size_t e) {
        const Geometry& geometry = geometry_[e];
        const std::size_t begin = masses_.elements[e].corner, end = masses_.end_of(e);
        const auto linear = [&](std::size_t c) { return field.linear[place_[c]]; };
        const auto angular = [&](std::size_t c) { return rotates_ ? field.angular[place_[c]] : Vec3{}; };
        const auto arm = [&](std::size_t c) {
            return state.position[masses_.corners[c].node] - geometry.center;
        };
        // The rigid motion nearest to value(c), turn(c): of its center, and its spin.
        const auto rigid = [&](auto&& value, auto&& turn, Vec3& mean, Vec3& spin) {
            Vec3 momentum{}, moment{};
            for (std::size_t c = begin; c < end; ++c) {
                const auto& corner = masses_.corners[c];
                momentum += corner.mass * value(c);
                moment += corner.mass * cross(arm(c), value(c)) + corner.inertia * turn(c);
            }
            mean = (1 / geometry.mass) * momentum;
            spin = geometry.inertia * moment;
        };
        Vec3 mean, spin;
        rigid(linear, angular, mean, spin);
        const auto distortion = [&](auto&& value, auto&& turn) {
            for (std::size_t c = begin; c < end; ++c) {
                const auto& corner = masses_.corners[c];
                const double on = geometry.alive ? 1 : 0;
                corner_.linear[c] = on * corner.mass * (value(c) - mean - cross(spin, arm(c)));
                if (rotates_) corner_.angular[c] = on * corner.inertia * (turn(c) - spin);
            }
        };
        if (!spun) {
            distortion(linear, angular);
            return;
        }
        const Vec3 old_mean = mean, old_spin = spin;
        const auto turned = [&](std::size_t c) { return cross(old_spin, linear(c) - old_mean); };
        const auto turned_spin = [&](std::size_t c) { return cross(old_spin, angular(c)); };
        rigid(turned, turned_spin, mean, spin);
        distortion(turned, turned_spin);
    });
    for_each_place(nodes_.size(), [&](std::size_t i) {
        Vec3 sum{}, moment{};
        for (std::size_t s = first_[i]; s < first_[i + 1]; ++s) {
            sum += corner_.linear[slots_[s]];
            if (rotates_) moment += corner_.angular[slots_[s]];
        }
        result.linear[i] = sum;
        if (rotates_) result.angular[i] = moment;
    });
}

void SelectiveMass::list_held_nodes(const Clock& clock, const State& state)
{
    std::vector<HeldFreedom> freedoms;
    for (const Term* holder : holders_) holder->list_held(clock, state, freedoms);
    std::erase_if(freedoms, [&](const HeldFreedom& held) { return place_of_node_[held.node] == none; });
    std::stable_sort(freedoms.begin(), freedoms.end(), [](const HeldFreedom& a, const HeldFreedom& b) {
        return a.node != b.node ? a.node < b.node : a.rotation < b.rotation;
    });
    held_.clear();
    for (const HeldFreedom& freedom : freedoms) {
        if (freedom.rotation && !rotates_) continue;
        const Index node = place_of_node_[freedom.node];
        if (held_.empty() || held_.back().node != node || held_.back().rotation != freedom.rotation)
            held_.push_back({node, freedom.rotation, 0, {}, {}});
        HeldNode& held = held_.back();
        Vec3 direction = freedom.direction;
        double acceleration = freedom.acceleration;
        for (int i = 0; i < held.count; ++i) {
            const double share = dot(freedom.direction, held.direction[i]);
            direction -= share * held.direction[i];
            acceleration -= share * held.acceleration[i];
        }
        const double length = norm(direction);
        if (length < 1e-6 || held.count == 3) continue; // held already
        held.direction[held.count] = (1 / length) * direction;
        held.acceleration[held.count++] = acceleration / length;
    }
}

void SelectiveMass::hold(Field& field, bool at_rest) const
{
    for (const HeldNode& held : held_) {
        Vec3& value = (held.rotation ? field.angular : field.linear)[held.node];
        for (int i = 0; i < held.count; ++i) {
            const double wanted = at_rest ? 0 : held.acceleration[i];
            value += (wanted - dot(value, held.direction[i])) * held.direction[i];
        }
    }
}

SelectiveMass::Field SelectiveMass::zero() const
{
    return {Vectors(nodes_.size()), Vectors(rotates_ ? nodes_.size() : 0)};
}

double SelectiveMass::product(const Field& a, const Field& b) const
{
    return sum_chunks(nodes_.size(), [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) {
            sum += dot(a.linear[i], b.linear[i]);
            if (rotates_) sum += dot(a.angular[i], b.angular[i]);
        }
        return sum;
    });
}

SelectiveMass::Field SelectiveMass::solve(const State& state, const Field& right)
{
    Field solution{motion_, spin_}, image = zero(), residual = zero(), way = zero(), scaled = zero();
    hold(solution, false);
    const auto precondition = [&](const Field& from, Field& to) {
        for_each_place(nodes_.size(), [&](std::size_t i) {
            to.linear[i] = (1 / (mass_[i] + more_mass_[i])) * from.linear[i];
            if (rotates_) to.angular[i] = (1 / (inertia_[i] + more_inertia_[i])) * from.angular[i];
        });
        hold(to, true);
    };
    const auto apply = [&](const Field& from, Field& to) {
        multiply(state, from, false, to);
        for_each_place(nodes_.size(), [&](std::size_t i) {
            to.linear[i] += mass_[i] * from.linear[i];
            if (rotates_) to.angular[i] += inertia_[i] * from.angular[i];
        });
    };
    const auto add = [&](double factor, const Field& from, Field& to) {
        for_each_place(nodes_.size(), [&](std::size_t i) {
            to.linear[i] += factor * from.linear[i];
            if (rotates_) to.angular[i] += factor * from.angular[i];
        });
    };
    precondition(right, scaled);
    const double reference = product(right, scaled);
    apply(solution, image);
    residual = right;
    add(-1, image, residual);
    precondition(residual, scaled);
    way = scaled;
    double square = product(residual, scaled);
    const double enough = selective_tolerance * selective_tolerance * reference;
    constexpr long most = 1000;
    for (iterations_ = 0; square > enough; ++iterations_) {
        if (iterations_ == most || !std::isfinite(square)) {
            throw RunError(fmt::format("selective mass scaling (IMSCL of *CONTROL_TIMESTEP) finds no "
                                       "accelerations: a residual of {:.3g} is left after {} iterations",
                                       std::sqrt(square / reference), iterations_));
        }
        apply(way, image);
        const double length = square / product(way, image);
        add(length, way, solution);
        add(-length, image, residual);
        precondition(residual, scaled);
        const double next = product(residual, scaled);
        const double turn = next / square;
        for_each_place(nodes_.size(), [&](std::size_t i) {
            way.linear[i] = scaled.linear[i] + turn * way.linear[i];
            if (rotates_) way.angular[i] = scaled.angular[i] + turn * way.angular[i];
        });
        square = next;
    }
    return solution;
}

void SelectiveMass::constrain(const Clock& clock, State& state)
{
    if (masses_.elements.empty()) return;
    place_elements(state);
    list_held_nodes(clock, state);
    Field velocity = zero(), force = zero(), turning = zero();
    for_each_place(nodes_.size(), [&](std::size_t i) {
        velocity.linear[i] = state.velocity[nodes_[i]];
        force.linear[i] = state.force[nodes_[i]];
        if (!rotates_) return;
        velocity.angular[i] = state.angular_velocity[nodes_[i]];
        force.angular[i] = state.moment[nodes_[i]];
    });
    multiply(state, velocity, true, turning);
    for_each_place(nodes_.size(), [&](std::size_t i) {
        force.linear[i] += turning.linear[i];
        if (rotates_) force.angular[i] += turning.angular[i];
    });
    Field acceleration = solve(state, force);
    Field resistance = zero(), momentum = zero();
    multiply(state, acceleration, false, resistance);
    multiply(state, velocity, false, momentum);
    for_each_place(nodes_.size(), [&](std::size_t i) {
        state.force[nodes_[i]] += turning.linear[i] - resistance.linear[i];
        if (rotates_) state.moment[nodes_[i]] += turning.angular[i] - resistance.angular[i];
    });
    // Kinetic energy of C at n in the form of advance_velocities.
    const double span = clock.velocity_step();
    const double before = product(velocity, momentum), mixed = product(velocity, resistance),
                 square = product(acceleration, resistance);
    if (clock.last_step == 0) { // the velocity is that of n
        kinetic_ = 0.5 * (before - span * span * square);
    } else {
        const double change = clock.step_change() * (2 * span * mixed + span * span * square);
        kinetic_ = 0.5 * (before + span * mixed + change);
    }
    motion_ = std::move(acceleration.linear);
    spin_ = std::move(acceleration.angular);
}

} // namespace plash
