#include "solver/static_trials.h"

#include "ale/fluid_term.h"
#include "core/archive.h"
#include "core/run_error.h"
#include "solver/cycle.h"
#include "solver/motion.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace plash {

namespace {

void put(const Vec3& from, double scale, double* to)
{
    to[0] = scale * from.x;
    to[1] = scale * from.y;
    to[2] = scale * from.z;
}

} // namespace

KeptState::KeptState(Scene& scene) : scene_(scene)
{
    std::string name = (std::filesystem::temp_directory_path() / "plash-static-XXXXXX").string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) throw RunError(fmt::format("no file can be made as {}", name));
    close(descriptor);
    path_ = name;
    pass(Archive::Mode::save);
}

KeptState::~KeptState()
{
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

void KeptState::bring_back()
{
    pass(Archive::Mode::load);
}

void KeptState::pass(Archive::Mode mode)
{
    Archive archive(path_, mode);
    archive(scene_.state);
    for (auto& term : scene_.terms)
        if (!dynamic_cast<EulerianFluid*>(term.get())) term->serialise(archive); // which stand still
    archive.close();
}

StaticTrials::StaticTrials(Scene& scene, std::vector<double>& seconds)
    : scene_(scene),
      seconds_(seconds),
      first_(scene),
      kept_(scene),
      step_control_(scene.model, scene.model.controls.time.step_scale)
{
    find_freedoms();
    settle();
    step_ = clock_.step;
}

void StaticTrials::accelerations(const double* displacement, double* result)
{
    go_to(displacement);
    settle();
    constrain_forces(scene_, clock_, seconds_);
    advance_velocities(clock_, scene_.state);
    const State& state = scene_.state;
    for (const Freedom& freedom : freedoms_) {
        if (const RigidBody* body = freedom.body) { // velocities of its nodes are differences of places
            const Vec3 arm = state.position[freedom.node] - body->shown_center;
            put(body->acceleration + cross(body->angular_acceleration, arm), 1, result + freedom.first);
        } else {
            put(state.velocity[freedom.node], 1 / clock_.velocity_step(), result + freedom.first);
        }
        if (freedom.inertia > 0)
            put(state.angular_velocity[freedom.node], freedom.gyration / clock_.velocity_step(),
                result + freedom.first + 3);
    }
}

void StaticTrials::stay(const double* displacement)
{
    go_to(displacement);
    settle();
    constrain_forces(scene_, clock_, seconds_); // bodies leave a phase after this
    first_.restore();
}

void StaticTrials::find_freedoms()
{
    const State& state = scene_.state;
    std::vector<double> mass = state.mass;
    std::vector<const RigidBody*> carrier(state.size());
    for (const auto& term : scene_.terms) {
        const auto* rigid = dynamic_cast<const RigidBodies*>(term.get());
        if (!rigid) continue;
        for (const RigidBody& body : rigid->bodies())
            for (Index node : body.nodes) {
                mass[node] = body.mass / static_cast<double>(body.nodes.size());
                carrier[node] = &body;
            }
    }
    for (std::size_t node = 0; node < state.size(); ++node) {
        if (mass[node] == 0) continue;
        Freedom freedom{static_cast<Index>(node), mass[node], 0, 0, unknowns_, carrier[node]};
        if (state.rotational()) freedom.inertia = state.inertia[node];
        freedom.gyration = std::sqrt(freedom.inertia / freedom.mass);
        unknowns_ += freedom.inertia > 0 ? 6 : 3;
        freedoms_.push_back(freedom);
    }
}

/// Everything at rest where it is: forces as in the first cycle of a run.
void StaticTrials::settle()
{
    first_.rest();
    clock_ = {};
    clock_.relaxing = true;
    clock_.time = scene_.model.controls.relaxation.end_time;
    sum_forces(scene_, clock_, step_control_, seconds_);
    ++count_;
}

void StaticTrials::go_to(const double* displacement)
{
    kept_.bring_back();
    State& state = scene_.state;
    state.clear_forces();
    bool moves = false;
    const double rate = 1 / (step_ * step_);
    for (const Freedom& freedom : freedoms_) {
        const double* u = displacement + freedom.first;
        state.force[freedom.node] = (freedom.mass * rate) * Vec3{u[0], u[1], u[2]};
        for (int i = 0; i < 3; ++i) moves = moves || u[i] != 0;
        if (freedom.inertia == 0) continue;
        state.moment[freedom.node] = (freedom.inertia * rate / freedom.gyration) * Vec3{u[3], u[4], u[5]};
        for (int i = 3; i < 6; ++i) moves = moves || u[i] != 0;
    }
    if (!moves) return;
    clock_.step = clock_.last_step = step_;
    clock_.cycle = 1;
    constrain_forces(scene_, clock_, seconds_);
    advance_velocities(clock_, state);
    const double time = clock_.time;
    move_nodes(scene_, clock_, seconds_);
    clock_.time = time;
    sum_forces(scene_, clock_, step_control_, seconds_);
    ++count_;
}

} // namespace plash
