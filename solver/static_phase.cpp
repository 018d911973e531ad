#include "solver/static_phase.h"

#include "ale/fluid_term.h"
#include "core/archive.h"
#include "core/parallel.h"
#include "core/prescribed_rate.h"
#include "core/run_error.h"
#include "rigid/rigid_bodies.h"
#include "solver/cycle.h"
#include "solver/first_velocities.h"
#include "solver/motion.h"
#include "solver/step_control.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <unistd.h>

namespace plash {

namespace {

constexpr double static_tolerance = 1e-5; // largest acceleration over the reference that ends the search
constexpr int newton_steps = 30;
constexpr double krylov_memory = 4e7; // of GMRES between two restarts, in numbers; at least 100 vectors
constexpr int krylov_restarts = 2;

/// A file for the state of the start, gone with this object.
class KeptState {
public:
    explicit KeptState(Scene& scene) : scene_(scene)
    {
        std::string name = (std::filesystem::temp_directory_path() / "plash-static-XXXXXX").string();
        const int descriptor = mkstemp(name.data());
        if (descriptor < 0) throw RunError(fmt::format("no file can be made as {}", name));
        close(descriptor);
        path_ = name;
        keep();
    }
    ~KeptState()
    {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    KeptState(const KeptState&) = delete;
    KeptState& operator=(const KeptState&) = delete;

    void keep() { pass(Archive::Mode::save); }
    void bring_back() { pass(Archive::Mode::load); }

private:
    Scene& scene_;
    std::string path_;

    void pass(Archive::Mode mode)
    {
        Archive archive(path_, mode);
        archive(scene_.state);
        for (auto& term : scene_.terms)
            if (!dynamic_cast<EulerianFluid*>(term.get())) term->serialise(archive); // which stand still
        archive.close();
    }
};

/// A node that may move, with three translations and, with an inertia, three rotations among the unknowns.
struct Freedom {
    Index node;
    double mass;                     ///< of nodes of a rigid body an equal share of the body's [mass]
    double inertia = 0;              ///< [mass length^2]
    double gyration = 0;             ///< radius; rotations count by the length of their way there [length]
    std::size_t first;               ///< of its unknowns
    const RigidBody* body = nullptr; ///< that carries it
};

/// Accelerations of a scene at places near those of its start.
class Trials {
public:
    Trials(Scene& scene, std::vector<double>& seconds)
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

    std::size_t unknowns() const { return unknowns_; }
    long count() const { return count_; }
    double step() const { return step_; }
    const std::vector<Freedom>& freedoms() const { return freedoms_; }
    /// The clock of the phase, with the time at which loads act.
    const Clock& clock() const { return clock_; }

    /// Accelerations [acceleration] at displacements from the places of the start [length].
    void accelerations(const double* displacement, double* result)
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

    /// Leaves the scene at these places, ready for its first cycle.
    void stay(const double* displacement)
    {
        go_to(displacement);
        settle();
        constrain_forces(scene_, clock_, seconds_); // bodies leave a phase after this
        first_.restore();
    }

private:
    Scene& scene_;
    std::vector<double>& seconds_;
    FirstVelocities first_;
    KeptState kept_;
    StepControl step_control_;
    Clock clock_;
    double step_ = 0; ///< in which trial places are reached [time]
    std::vector<Freedom> freedoms_;
    std::size_t unknowns_ = 0;
    long count_ = 0;

    static void put(const Vec3& from, double scale, double* to)
    {
        to[0] = scale * from.x;
        to[1] = scale * from.y;
        to[2] = scale * from.z;
    }

    void find_freedoms()
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
    void settle()
    {
        first_.rest();
        clock_ = {};
        clock_.relaxing = true;
        clock_.time = scene_.model.controls.relaxation.end_time;
        sum_forces(scene_, clock_, step_control_, seconds_);
        ++count_;
    }

    void go_to(const double* displacement)
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
};

/// What accelerations are measured by: that of the frame, or else the largest of the start [acceleration].
double reference_acceleration(const Scene& scene, const Clock& clock, double largest)
{
    Vec3 sum{};
    for (const BodyLoad& load : scene.model.body_loads)
        if (load.kind == BodyLoad::Kind::translation)
            sum += body_load_value(scene.model, load, clock) * load.direction;
    return norm(sum) > 0 ? norm(sum) : largest;
}

double largest_of(const Trials& trials, const double* accelerations, int first, int last)
{
    double largest = 0;
    for (const Freedom& freedom : trials.freedoms()) {
        if (first > 0 && freedom.inertia == 0) continue;
        for (int i = first; i < last; ++i)
            largest = std::max(largest, std::abs(accelerations[freedom.first + i]));
    }
    return largest;
}

/// What KINSOL's functions know.
struct Problem {
    Trials& trials;
    double length;       ///< of a small displacement for difference quotients [length]
    std::string failure; ///< of the last trial that ended with an error
};

int residual(N_Vector displacement, N_Vector result, void* data)
{
    Problem& problem = *static_cast<Problem*>(data);
    try {
        problem.trials.accelerations(NV_DATA_S(displacement), NV_DATA_S(result));
    } catch (const RunError& error) {
        problem.failure = error.what();
        return 1; // a shorter step may do
    }
    return 0;
}

/// Derivative along a direction by a central difference over a displacement that is small against everything
/// in the scene. A one-sided difference would not do: the stretching of a plate that bends is of second
/// order, but so much stiffer than its bending that GMRES could not tell the softest modes from the error.
int derivative(N_Vector direction, N_Vector result, N_Vector displacement, booleantype*, void* data)
{
    Problem& problem = *static_cast<Problem*>(data);
    const double largest = N_VMaxNorm(direction);
    N_VConst(0, result);
    if (largest == 0) return 0;
    const double scale = problem.length / largest;
    const std::size_t count = problem.trials.unknowns();
    const double *at = NV_DATA_S(displacement), *along = NV_DATA_S(direction);
    std::vector<double> place(count), before(count);
    try {
        for (std::size_t i = 0; i < count; ++i) place[i] = at[i] - scale * along[i];
        problem.trials.accelerations(place.data(), before.data());
        for (std::size_t i = 0; i < count; ++i) place[i] = at[i] + scale * along[i];
        problem.trials.accelerations(place.data(), NV_DATA_S(result));
    } catch (const RunError& error) {
        problem.failure = error.what();
        return -1;
    }
    for (std::size_t i = 0; i < count; ++i)
        NV_Ith_S(result, i) = (NV_Ith_S(result, i) - before[i]) / (2 * scale);
    return 0;
}

void ignore_message(int, const char*, const char*, char*, void*) {}

/// KINSOL's objects, freed with this one.
class Newton {
public:
    Newton(Problem& problem, double size, double reference)
    {
        SUNContext_Create(nullptr, &context_);
        const auto count = static_cast<sunindextype>(problem.trials.unknowns());
        value_ = N_VNew_Serial(count, context_);
        value_scale_ = N_VNew_Serial(count, context_);
        result_scale_ = N_VNew_Serial(count, context_);
        N_VConst(0, value_);
        N_VConst(1 / size, value_scale_);
        N_VConst(1 / reference, result_scale_);
        memory_ = KINCreate(context_);
        const double vectors = std::clamp(krylov_memory / static_cast<double>(count), 100.0, 1000.0);
        solver_ = SUNLinSol_SPGMR(value_, SUN_PREC_NONE,
                                  std::min(static_cast<int>(count), static_cast<int>(vectors)), context_);
        const bool fine = KINSetErrHandlerFn(memory_, ignore_message, nullptr) == KIN_SUCCESS &&
                          KINInit(memory_, residual, value_) == KIN_SUCCESS &&
                          KINSetUserData(memory_, &problem) == KIN_SUCCESS &&
                          KINSetLinearSolver(memory_, solver_, nullptr) == KIN_SUCCESS &&
                          SUNLinSol_SPGMRSetMaxRestarts(solver_, krylov_restarts) == SUNLS_SUCCESS &&
                          KINSetJacTimesVecFn(memory_, derivative) == KIN_SUCCESS &&
                          KINSetFuncNormTol(memory_, static_tolerance) == KIN_SUCCESS &&
                          KINSetScaledStepTol(memory_, 1e-20) == KIN_SUCCESS &&
                          KINSetEtaForm(memory_, KIN_ETACONSTANT) == KIN_SUCCESS &&
                          KINSetEtaConstValue(memory_, 1e-2) == KIN_SUCCESS &&
                          KINSetNumMaxIters(memory_, newton_steps) == KIN_SUCCESS;
        if (!fine) throw RunError("KINSOL could not be set up for the static start");
    }
    ~Newton()
    {
        KINFree(&memory_);
        SUNLinSolFree(solver_);
        N_VDestroy(value_);
        N_VDestroy(value_scale_);
        N_VDestroy(result_scale_);
        SUNContext_Free(&context_);
    }
    Newton(const Newton&) = delete;
    Newton& operator=(const Newton&) = delete;

    int solve() { return KINSol(memory_, value_, KIN_LINESEARCH, value_scale_, result_scale_); }
    const double* place() const { return NV_DATA_S(value_); }

private:
    SUNContext context_ = nullptr;
    N_Vector value_ = nullptr, value_scale_ = nullptr, result_scale_ = nullptr;
    SUNLinearSolver solver_ = nullptr;
    void* memory_ = nullptr;
};

/// Diagonal of the box around what moves [length].
double size_of(const Scene& scene, const std::vector<Freedom>& freedoms)
{
    Vec3 low{}, high{};
    for (std::size_t i = 0; i < freedoms.size(); ++i) {
        const Vec3& place = scene.state.position[freedoms[i].node];
        for (const auto component : vector_component) {
            low.*component = i == 0 ? place.*component : std::min(low.*component, place.*component);
            high.*component = i == 0 ? place.*component : std::max(high.*component, place.*component);
        }
    }
    return norm(high - low);
}

} // namespace

RelaxationOutcome find_equilibrium(Scene& scene, std::vector<double>& term_seconds)
{
    Trials trials(scene, term_seconds);
    RelaxationOutcome outcome;
    outcome.ran = outcome.statics = true;
    std::vector<double> place(trials.unknowns()), there(trials.unknowns());
    trials.accelerations(place.data(), there.data());
    const double largest = largest_of(trials, there.data(), 0, 3);
    outcome.reference = reference_acceleration(scene, trials.clock(), largest);
    if (outcome.reference > 0) {
        const double size = size_of(scene, trials.freedoms());
        Problem problem{trials, 1e-8 * size, {}};
        Newton newton(problem, size, outcome.reference);
        const int flag = newton.solve();
        if (flag < 0 && !problem.failure.empty())
            throw RunError(fmt::format("static start: a trial ended with an error: {}", problem.failure));
        outcome.first_acceleration = largest / outcome.reference;
        std::copy(newton.place(), newton.place() + place.size(), place.begin());
        trials.accelerations(place.data(), there.data());
        if (!(largest_of(trials, there.data(), 0, 3) < largest)) { // nothing is better than the start
            std::fill(place.begin(), place.end(), 0.0);
            trials.accelerations(place.data(), there.data());
        }
        outcome.last_acceleration = largest_of(trials, there.data(), 0, 3) / outcome.reference;
        outcome.last_angular = largest_of(trials, there.data(), 3, 6) / outcome.reference;
    }
    outcome.converged = std::max(outcome.last_acceleration, outcome.last_angular) <= 2 * static_tolerance;
    outcome.cycles = trials.count();
    trials.stay(place.data());
    return outcome;
}

} // namespace plash
