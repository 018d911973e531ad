#include "rigid/interpolation.h"

#include "rigid/deck_nodes.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

bool has_freedoms(Id digits, std::string_view wanted)
{
    const std::string text = std::to_string(digits);
    return std::all_of(wanted.begin(), wanted.end(),
                       [&](char freedom) { return text.find(freedom) != std::string::npos; });
}

class ForcesOfDependents : public Term {
public:
    explicit ForcesOfDependents(std::shared_ptr<const Interpolations> links) : links_(std::move(links)) {}
    std::string_view name() const override { return "interpolation: forces"; }
    std::size_t items() const override { return links_->size(); }
    void constrain(const Clock&, State& state) override { links_->hand_forces_on(state); }

private:
    std::shared_ptr<const Interpolations> links_;
};

class MotionOfDependents : public Term {
public:
    explicit MotionOfDependents(std::shared_ptr<const Interpolations> links) : links_(std::move(links)) {}
    std::string_view name() const override { return "interpolation: motion"; }
    std::size_t items() const override { return links_->size(); }
    void constrain(const Clock& clock, State& state) override { links_->move_dependents(clock, state); }

private:
    std::shared_ptr<const Interpolations> links_;
};

} // namespace

Interpolations::Interpolations(const Model& model, State& state)
{
    const DeckNodes nodes(model);
    for_each_record(model, "CONSTRAINED_INTERPOLATION", [&](const Record& record) {
        const auto fail = [&](std::string_view field, const std::string& text) {
            throw DeckError(record.where, fmt::format("*{} {}, field {}: {}", record.keyword,
                                                      record.integer("ICID"), field, text));
        };
        Link link;
        link.dependent = nodes.find(record.integer("DNID"), record, record.where.line);
        const Id freedoms = record.integer("DDOF", 123456);
        if (!has_freedoms(freedoms, "123"))
            fail("DDOF", "only all translations together (123) can be dependent");
        link.rotations = has_freedoms(freedoms, "456");
        if (!link.rotations && freedoms > 123)
            fail("DDOF", "only all rotations together (456) can be dependent");
        const Table* table = record.table("INID");
        double total = 0;
        for (std::size_t row = 0; table && row < table->rows(); ++row) {
            const Id id = static_cast<Id>(table->at(row, 0));
            if (id == 0) continue;
            if (!has_freedoms(static_cast<Id>(table->at(row, 1)), "123") && table->at(row, 1) != 0)
                fail("IDOF", "independent nodes need all translations (123)");
            const double weight = table->at(row, 2) != 0 ? table->at(row, 2) : 1;
            for (int column : {3, 4}) {
                if (table->at(row, column) != 0 && table->at(row, column) != weight)
                    fail("TWGHTY", "weights that differ between directions are not supported");
            }
            const auto add = [&](Index node) {
                if (node == link.dependent) fail("INID", "the dependent node is among the independent ones");
                link.nodes.push_back(node);
                link.weight.push_back(weight);
                total += weight;
            };
            if (record.integer("ITYP") == 1) {
                for (Index node : nodes_of_set(model, record, "INID", id)) add(node);
            } else {
                add(nodes.find(id, record, table->lines[row]));
            }
        }
        if (link.nodes.empty() || !(total > 0)) fail("INID", "there are no independent nodes with weight");
        for (double& weight : link.weight) weight /= total;
        links_.push_back(std::move(link));
    });
    for (const Link& link : links_) {
        for (std::size_t i = 0; i < link.nodes.size(); ++i)
            state.mass[link.nodes[i]] += link.weight[i] * state.mass[link.dependent];
        state.mass[link.dependent] = 0;
        if (link.rotations && state.rotational()) state.inertia[link.dependent] = 0;
    }
}

Interpolations::Fit Interpolations::fit_of(const Link& link, const State& state)
{
    Fit fit;
    for (std::size_t i = 0; i < link.nodes.size(); ++i)
        fit.centroid += link.weight[i] * state.position[link.nodes[i]];
    Matrix3 inertia{};
    double scale = 0;
    for (std::size_t i = 0; i < link.nodes.size(); ++i) {
        const Vec3 arm = state.position[link.nodes[i]] - fit.centroid;
        const double square = link.weight[i] * dot(arm, arm);
        scale += square;
        for (int axis = 0; axis < 3; ++axis) {
            inertia.row[axis] += square * Matrix3::identity().row[axis];
            const double along = axis == 0 ? arm.x : axis == 1 ? arm.y : arm.z;
            inertia.row[axis] -= (link.weight[i] * along) * arm;
        }
    }
    if (scale <= 0) return fit; // one place: the mean motion is a translation
    // Nodes on a line say nothing about rotation around it: a small stiffness keeps that rotation at zero.
    for (int axis = 0; axis < 3; ++axis) inertia.row[axis] += 1e-10 * scale * Matrix3::identity().row[axis];
    fit.inverse_inertia = inverse(inertia);
    return fit;
}

void Interpolations::hand_forces_on(State& state) const
{
    for (const Link& link : links_) {
        const Fit fit = fit_of(link, state);
        const Vec3 force = state.force[link.dependent];
        Vec3 moment = cross(state.position[link.dependent] - fit.centroid, force);
        if (link.rotations && state.rotational()) moment += state.moment[link.dependent];
        const Vec3 turning = fit.inverse_inertia * moment;
        for (std::size_t i = 0; i < link.nodes.size(); ++i) {
            const Index node = link.nodes[i];
            state.force[node] +=
                link.weight[i] * (force + cross(turning, state.position[node] - fit.centroid));
        }
        state.force[link.dependent] = {};
        if (link.rotations && state.rotational()) state.moment[link.dependent] = {};
    }
}

void Interpolations::move_dependents(const Clock& clock, State& state) const
{
    for (const Link& link : links_) {
        const Fit fit = fit_of(link, state);
        Vec3 mean{}, swirl{};
        for (std::size_t i = 0; i < link.nodes.size(); ++i) {
            const Index node = link.nodes[i];
            Vec3 velocity = state.velocity[node];
            if (state.mass[node] > 0)
                velocity += (clock.velocity_step() / state.mass[node]) * state.force[node];
            mean += link.weight[i] * velocity;
            swirl += link.weight[i] * cross(state.position[node] - fit.centroid, velocity);
        }
        const Vec3 spin = fit.inverse_inertia * swirl;
        state.velocity[link.dependent] = mean + cross(spin, state.position[link.dependent] - fit.centroid);
        if (link.rotations && state.rotational()) state.angular_velocity[link.dependent] = spin;
    }
}

std::pair<std::unique_ptr<Term>, std::unique_ptr<Term>> make_interpolations(const Model& model, State& state)
{
    auto links = std::make_shared<const Interpolations>(model, state);
    if (links->empty()) return {};
    return {std::make_unique<ForcesOfDependents>(links), std::make_unique<MotionOfDependents>(links)};
}

} // namespace plash
