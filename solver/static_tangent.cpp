#include "solver/static_tangent.h"

#include "core/run_error.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace plash {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
constexpr double most_work = 1e12; // of a factorisation, in multiplications: about ten minutes

} // namespace

struct StaticTangent::Factors {
    struct CountingSolver : Eigen::SimplicialLDLT<Matrix> {
        /// Multiplications of a factorisation, known from the pattern.
        double work() const { return m_nonZerosPerCol.cast<double>().squaredNorm(); }
    };
    CountingSolver solver;
    Matrix stiffness, mass;
};

StaticTangent::StaticTangent(const StaticTrials& trials)
    : freedoms_(trials.freedoms()), unknowns_(trials.unknowns()), factors_(std::make_unique<Factors>())
{
    find_nearby(trials.model());
    paint();
    set_up_factors();
}

StaticTangent::~StaticTangent() = default;

void StaticTangent::find_nearby(const Model& model)
{
    std::vector<Index> freedom_of(model.nodes.size(), none);
    for (std::size_t i = 0; i < freedoms_.size(); ++i)
        if (!freedoms_[i].body) freedom_of[freedoms_[i].node] = static_cast<Index>(i);
    nearby_.resize(freedoms_.size());
    std::vector<Index> together;
    const auto join = [&](const auto& elements, std::size_t corners) {
        for (const auto& nodes : elements.nodes) {
            together.clear();
            for (std::size_t corner = 0; corner < corners; ++corner) {
                const Index node = nodes[corner];
                if (node != none && freedom_of[node] != none) together.push_back(freedom_of[node]);
            }
            for (Index freedom : together)
                nearby_[freedom].insert(nearby_[freedom].end(), together.begin(), together.end());
        }
    };
    join(model.shells, 4);
    join(model.solids, 8);
    join(model.thick_shells, 8);
    join(model.tetrahedra, 10);
    join(model.beams, 2); // the third node only turns the section
    join(model.discretes, 2);
    of_element_.resize(freedoms_.size());
    for (std::size_t i = 0; i < freedoms_.size(); ++i) {
        std::vector<Index>& near = nearby_[i];
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
        of_element_[i] = !near.empty();
    }
}

/// Each freedom gets the first colour that none has with which it shares a row.
void StaticTangent::paint()
{
    std::vector<Index> colour_of(freedoms_.size(), none), taken_by;
    for (std::size_t i = 0; i < freedoms_.size(); ++i) {
        if (!of_element_[i]) continue;
        for (Index row : nearby_[i])
            for (Index other : nearby_[row])
                if (colour_of[other] != none) taken_by[colour_of[other]] = static_cast<Index>(i);
        const auto free = std::find_if(taken_by.begin(), taken_by.end(),
                                       [&](Index by) { return by != static_cast<Index>(i); });
        colour_of[i] = static_cast<Index>(free - taken_by.begin());
        if (free == taken_by.end()) {
            taken_by.push_back(none);
            colours_.emplace_back();
        }
        colours_[colour_of[i]].push_back(static_cast<Index>(i));
    }
}

/// Visits the entries of a column of K: row, column, and the freedom of the row.
template <class Visit>
void StaticTangent::for_entries(Index freedom, int component, Visit&& visit) const
{
    const auto column = static_cast<int>(freedoms_[freedom].first) + component;
    for (Index near : nearby_[freedom])
        for (int j = 0; j < freedoms_[near].count(); ++j)
            visit(static_cast<int>(freedoms_[near].first) + j, column, near);
}

void StaticTangent::set_up_factors()
{
    std::vector<Eigen::Triplet<double>> masses, entries;
    for (std::size_t i = 0; i < freedoms_.size(); ++i)
        for (int component = 0; component < freedoms_[i].count(); ++component) {
            const auto row = static_cast<int>(freedoms_[i].first) + component;
            masses.emplace_back(row, row, freedoms_[i].mass);
            for_entries(static_cast<Index>(i), component,
                        [&](int near, int column, Index) { entries.emplace_back(near, column, 0.0); });
        }
    const auto size = static_cast<Eigen::Index>(unknowns_);
    Factors& factors = *factors_;
    factors.mass.resize(size, size);
    factors.mass.setFromTriplets(masses.begin(), masses.end());
    factors.stiffness.resize(size, size);
    factors.stiffness.setFromTriplets(entries.begin(), entries.end());
    factors.stiffness += 0 * factors.mass; // a place for every shift
    factors.solver.analyzePattern(factors.stiffness);
    if (factors.solver.work() <= most_work) return;
    colours_.clear();
    std::fill(of_element_.begin(), of_element_.end(), 0);
    factors.solver.analyzePattern(factors.mass);
}

void StaticTangent::measure(StaticTrials& trials, const double* displacement, double length)
{
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> place(displacement, displacement + unknowns_), before(unknowns_), after(unknowns_);
    const auto difference = [&](const std::vector<Index>& colour, int component) {
        for (const double sign : {-1.0, 1.0}) {
            for (Index i : colour)
                if (component < freedoms_[i].count()) place[freedoms_[i].first + component] += sign * length;
            trials.accelerations(place.data(), (sign < 0 ? before : after).data());
            for (Index i : colour)
                if (component < freedoms_[i].count())
                    place[freedoms_[i].first + component] = displacement[freedoms_[i].first + component];
        }
    };
    double largest = 0;
    for (const std::vector<Index>& colour : colours_) {
        int components = 0;
        for (Index i : colour) components = std::max(components, freedoms_[i].count());
        for (int component = 0; component < components; ++component) {
            difference(colour, component);
            for (Index i : colour) {
                if (component >= freedoms_[i].count()) continue;
                for_entries(i, component, [&](int row, int column, Index near) {
                    const double mass = freedoms_[near].mass;
                    const double value = mass * (before[row] - after[row]) / (2 * length);
                    entries.emplace_back(row, column, value / 2); // and its transpose
                    entries.emplace_back(column, row, value / 2);
                    if (row == column) largest = std::max(largest, value / mass);
                });
            }
        }
    }
    largest_ = largest > 0 ? largest : 1;
    for (std::size_t i = 0; i < freedoms_.size(); ++i)
        for (int component = 0; !of_element_[i] && component < freedoms_[i].count(); ++component) {
            const auto row = static_cast<int>(freedoms_[i].first) + component;
            entries.emplace_back(row, row, freedoms_[i].mass * largest_);
        }
    Factors& factors = *factors_;
    factors.stiffness.setFromTriplets(entries.begin(), entries.end());
    factors.stiffness += 0 * factors.mass;
}

void StaticTangent::factorise(double least_shift)
{
    constexpr double ratio = 4;
    Factors& factors = *factors_;
    shift_ = least_shift;
    while (true) {
        factors.solver.factorize(factors.stiffness + shift_ * factors.mass);
        if (factors.solver.info() == Eigen::Success && (factors.solver.vectorD().array() > 0).all()) return;
        if (shift_ > largest_) break;
        shift_ *= ratio;
    }
    throw RunError("static start: the stiffness of the elements could not be factorised");
}

void StaticTangent::solve(const double* accelerations, double* displacement) const
{
    const auto size = static_cast<Eigen::Index>(unknowns_);
    const Eigen::Map<const Eigen::VectorXd> given(accelerations, size);
    Eigen::Map<Eigen::VectorXd>(displacement, size) = -factors_->solver.solve(factors_->mass * given);
}

} // namespace plash
