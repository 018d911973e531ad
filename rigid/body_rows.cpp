#include "rigid/body_rows.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

constexpr int most_iterations = 12;
/// A pivot this much smaller than its row's own mobility says that the row follows from those before it.
constexpr double vanishing_pivot = 1e-9;

} // namespace

void BodyRows::prepare(std::size_t body_count)
{
    touched_.assign(body_count, false);
    for (const BodyRow& row : rows) {
        if (row.first != none) touched_[row.first] = true;
        if (row.second != none) touched_[row.second] = true;
    }
    const std::size_t count = rows.size();
    begin_.resize(count);
    first_column_.resize(count);
    // Envelope of the matrix: row i reaches back to the first row that shares a body with it.
    std::vector<std::size_t> first_row(body_count, count);
    std::size_t size = 0;
    for (std::size_t i = 0; i < count; ++i) {
        first_column_[i] = i;
        for (Index body : {rows[i].first, rows[i].second}) {
            if (body == none) continue;
            first_row[body] = std::min(first_row[body], i);
            first_column_[i] = std::min(first_column_[i], first_row[body]);
        }
        begin_[i] = size;
        size += i - first_column_[i] + 1;
    }
    matrix_.assign(size, 0);
    error_.assign(count, 0);
    dropped_.assign(count, false);
    gradients_.resize(count);
    linear_mobility_.resize(body_count);
    angular_mobility_.resize(body_count);
    start_.resize(body_count);
    middle_.resize(body_count);
    end_.resize(body_count);
}

BodyRows::Pose BodyRows::pose(Index body, const std::vector<Pose>& poses) const
{
    return body == none ? Pose{} : poses[body];
}

/// d/dt of the condition is the product of this with the velocities. With p2 the place of the second point,
/// d/dt [a1 . (p2 - p1)] = a1 . (v2 + w2 x r2) - a1 . (v1 + w1 x (p2 - c1)): both bodies are pushed at p2.
BodyRows::Gradient BodyRows::gradient_of(const BodyRow& row, const Pose& first, const Pose& second)
{
    const Vec3 a1 = first.orientation * row.axis1, a2 = second.orientation * row.axis2;
    Gradient gradient;
    if (row.kind == BodyRow::Kind::angle) {
        const Vec3 normal = cross(a1, a2);
        return {{}, normal, {}, -normal};
    }
    if (row.kind == BodyRow::Kind::distance) {
        const Vec3 along = unit(second.center - first.center);
        return {-along, {}, along, {}};
    }
    const Vec3 r2 = second.orientation * row.arm2;
    const double slide = row.kind == BodyRow::Kind::point ? 1 : row.slide;
    if (slide != 0) {
        const Vec3 from_first = second.center + r2 - first.center;
        gradient = {-slide * a1, -slide * cross(from_first, a1), slide * a1, slide * cross(r2, a1)};
    }
    if (row.kind == BodyRow::Kind::point) return gradient;
    gradient.angular2 += row.turn * a1;
    gradient.angular1 += (row.spin1 - row.turn) * a1;
    gradient.angular2 += (row.turn2 + row.spin2) * a2;
    gradient.angular1 -= row.turn2 * a2;
    gradient.linear2 += row.run2 * a2;
    gradient.angular2 += row.run2 * cross(r2, a2);
    return gradient;
}

double BodyRows::rate_of(const Gradient& g, const BodyRow& row, const std::vector<RigidBody>& bodies)
{
    double rate = 0;
    if (row.first != none) {
        const RigidBody& body = bodies[row.first];
        rate += dot(g.linear1, body.velocity) + dot(g.angular1, body.angular_velocity);
    }
    if (row.second != none) {
        const RigidBody& body = bodies[row.second];
        rate += dot(g.linear2, body.velocity) + dot(g.angular2, body.angular_velocity);
    }
    return rate;
}

void BodyRows::linearise(const std::vector<RigidBody>& bodies)
{
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (!touched_[b]) continue;
        linear_mobility_[b] = translational_mobility(bodies[b]);
        angular_mobility_[b] = rotational_mobility(bodies[b], bodies[b].orientation);
        start_[b] = {bodies[b].center, bodies[b].orientation};
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
        gradients_[i] = gradient_of(rows[i], pose(rows[i].first, start_), pose(rows[i].second, start_));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const BodyRow& row = rows[i];
        const Gradient& g = gradients_[i];
        Vec3 moved[2]{}, turned[2]{}; // what a unit impulse of this row does to its bodies
        if (row.first != none && !row.one_sided) {
            moved[0] = linear_mobility_[row.first] * g.linear1;
            turned[0] = angular_mobility_[row.first] * g.angular1;
        }
        if (row.second != none) {
            moved[1] = linear_mobility_[row.second] * g.linear2;
            turned[1] = angular_mobility_[row.second] * g.angular2;
        }
        for (std::size_t j = first_column_[i]; j <= i; ++j) {
            const BodyRow& other = rows[j];
            const Gradient& h = gradients_[j];
            double sum = 0;
            const auto add = [&](Index body, int side) {
                if (body == none) return;
                if (other.first == body && !other.one_sided)
                    sum += dot(h.linear1, moved[side]) + dot(h.angular1, turned[side]);
                if (other.second == body) sum += dot(h.linear2, moved[side]) + dot(h.angular2, turned[side]);
            };
            if (!row.one_sided) add(row.first, 0);
            add(row.second, 1);
            matrix_[begin_[i] + j - first_column_[i]] = sum;
        }
    }
    factor();
}

/// Cholesky within the envelope.
void BodyRows::factor()
{
    for (std::size_t i = 0; i < rows.size(); ++i) {
        double* line = &matrix_[begin_[i]];
        const std::size_t first = first_column_[i];
        const double own = line[i - first];
        dropped_[i] = !rows[i].active || rows[i].dead;
        if (dropped_[i]) continue;
        double pivot = own;
        for (std::size_t j = first; j < i; ++j) {
            double sum = line[j - first];
            if (dropped_[j]) {
                line[j - first] = 0;
                continue;
            }
            const double* other = &matrix_[begin_[j]];
            const std::size_t other_first = first_column_[j];
            for (std::size_t k = std::max(first, other_first); k < j; ++k)
                sum -= line[k - first] * other[k - other_first];
            line[j - first] = sum / other[j - other_first];
            pivot -= line[j - first] * line[j - first];
        }
        if (pivot <= vanishing_pivot * own) {
            dropped_[i] = true;
            continue;
        }
        line[i - first] = std::sqrt(pivot);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) { // a dropped row takes no part in the substitutions
        if (!dropped_[i]) continue;
        for (std::size_t j = first_column_[i]; j < i; ++j) matrix_[begin_[i] + j - first_column_[i]] = 0;
        matrix_[begin_[i] + i - first_column_[i]] = 1;
    }
}

void BodyRows::solve(std::vector<double>& values) const
{
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double* line = &matrix_[begin_[i]];
        const std::size_t first = first_column_[i];
        if (dropped_[i]) {
            values[i] = 0;
            continue;
        }
        double sum = values[i];
        for (std::size_t j = first; j < i; ++j) sum -= line[j - first] * values[j];
        values[i] = sum / line[i - first];
    }
    for (std::size_t i = rows.size(); i-- > 0;) {
        const double* line = &matrix_[begin_[i]];
        const std::size_t first = first_column_[i];
        if (dropped_[i]) continue;
        values[i] /= line[i - first];
        for (std::size_t j = first; j < i; ++j) values[j] -= line[j - first] * values[i];
    }
}

void BodyRows::apply(std::size_t i, double impulse, std::vector<RigidBody>& bodies) const
{
    const Gradient& g = gradients_[i];
    if (const Index body = rows[i].first; body != none && !rows[i].one_sided) {
        bodies[body].velocity += impulse * (linear_mobility_[body] * g.linear1);
        bodies[body].angular_momentum += impulse * g.angular1;
    }
    if (const Index body = rows[i].second; body != none) {
        bodies[body].velocity += impulse * (linear_mobility_[body] * g.linear2);
        bodies[body].angular_momentum += impulse * g.angular2;
    }
}

/// How far a condition is from holding, as a velocity.
double BodyRows::end_error(const BodyRow& row, const std::vector<RigidBody>& bodies, double step) const
{
    if (row.kind == BodyRow::Kind::rate) {
        const Gradient g = gradient_of(row, pose(row.first, middle_), pose(row.second, middle_));
        return rate_of(g, row, bodies) - row.target;
    }
    const Pose first = pose(row.first, end_), second = pose(row.second, end_);
    if (row.kind == BodyRow::Kind::distance) return (norm(second.center - first.center) - row.target) / step;
    const Vec3 a1 = first.orientation * row.axis1;
    double value = 0;
    if (row.kind == BodyRow::Kind::angle) {
        value = dot(a1, second.orientation * row.axis2);
    } else {
        value = dot(a1, (second.center - first.center) + second.orientation * row.arm2 -
                            first.orientation * row.arm1);
    }
    return (value - row.target) / step;
}

void BodyRows::satisfy(std::vector<RigidBody>& bodies, const Clock& clock)
{
    linearise(bodies);
    // The impulse of the last step is a good first guess: forces change little.
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double span = clock.last_step > 0 ? 1.0 : 0.0;
        rows[i].impulse = dropped_[i] ? 0 : span * rows[i].impulse;
        if (rows[i].impulse != 0) apply(i, rows[i].impulse, bodies);
    }
    // One-sided rows learn of their first bodies' impulses a round later, one after the other at worst.
    const auto late =
        std::count_if(rows.begin(), rows.end(), [](const BodyRow& row) { return row.one_sided; });
    double last_largest = 0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            if (!touched_[b]) continue;
            RigidBody& body = bodies[b];
            body.angular_velocity = midpoint_angular_velocity(body, body.angular_momentum, clock.step);
            middle_[b] = {body.center + 0.5 * clock.step * body.velocity,
                          rotation(0.5 * clock.step * body.angular_velocity) * body.orientation};
            end_[b] = {body.center + clock.step * body.velocity,
                       rotation(clock.step * body.angular_velocity) * body.orientation};
        }
        double largest = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            error_[i] = dropped_[i] ? 0 : -end_error(rows[i], bodies, clock.step);
            const Gradient& g = gradients_[i];
            // In units of the row's own direction, so that lengths and angles compare.
            largest = std::max(largest, std::abs(error_[i]) / (norm(g.linear2) + norm(g.angular2) + 1e-300));
        }
        // At round-off the errors stop falling.
        if (largest == 0 || (iteration > late && largest > 0.25 * last_largest)) break;
        last_largest = largest;
        solve(error_);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (error_[i] == 0) continue;
            rows[i].impulse += error_[i];
            apply(i, error_[i], bodies);
        }
    }
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (touched_[b])
            bodies[b].angular_velocity =
                midpoint_angular_velocity(bodies[b], bodies[b].angular_momentum, clock.step);
    }
}

void BodyRows::project_start(std::vector<RigidBody>& bodies)
{
    linearise(bodies);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double target = rows[i].kind == BodyRow::Kind::rate ? rows[i].target : 0;
        error_[i] = dropped_[i] ? 0 : target - rate_of(gradients_[i], rows[i], bodies);
    }
    solve(error_);
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (error_[i] != 0) apply(i, error_[i], bodies);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (touched_[b]) bodies[b].angular_velocity = angular_mobility_[b] * bodies[b].angular_momentum;
    }
}

BodyRows::Momenta BodyRows::second_direction(std::size_t row) const
{
    return {gradients_[row].linear2, gradients_[row].angular2};
}

} // namespace plash
