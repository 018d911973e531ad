#include "solver/static_phase.h"

#include "ale/fluid_term.h"
#include "core/prescribed_rate.h"
#include "core/run_error.h"
#include "solver/static_tangent.h"
#include "solver/static_trials.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_spgmr.h>

namespace plash {

namespace {

constexpr double static_tolerance = 1e-5; // largest acceleration over the reference that ends the search
constexpr int newton_steps = 30, newton_steps_beside = 10; // the latter where the stiffness is known
constexpr double krylov_memory = 4e7; // of GMRES between two restarts, in numbers; at least 100 vectors
constexpr double krylov_vectors = 60; // enough where the stiffness of elements is known
constexpr int krylov_restarts = 2;

/// What accelerations are measured by: that of the frame, or else the largest of the start [acceleration].
double reference_acceleration(const Scene& scene, const Clock& clock, double largest)
{
    Vec3 sum{};
    for (const BodyLoad& load : scene.model.body_loads)
        if (load.kind == BodyLoad::Kind::translation)
            sum += body_load_value(scene.model, load, clock) * load.direction;
    return norm(sum) > 0 ? norm(sum) : largest;
}

double largest_of(const StaticTrials& trials, const double* accelerations, int first, int last)
{
    double largest = 0;
    for (const Freedom& freedom : trials.freedoms()) {
        if (first > 0 && freedom.inertia == 0) continue;
        for (int i = first; i < std::min(last, freedom.count()); ++i)
            largest = std::max(largest, std::abs(accelerations[freedom.first + i]));
    }
    return largest;
}

/// What KINSOL's functions know.
struct Problem {
    StaticTrials& trials;
    StaticTangent& tangent;
    double reference;    ///< of accelerations [acceleration]
    double length;       ///< of a small displacement for difference quotients [length]
    std::string failure; ///< of the last trial that ended with an error

    /// Largest acceleration over the reference [-]. Rotations do not count: nothing in shells resists one
    /// about their normal, so that moments as small as those of warped elements cannot come to rest.
    double unrest(const double* accelerations) const
    {
        return largest_of(trials, accelerations, 0, 3) / reference;
    }
};

/// The displacement that would bring the nodes to rest if the stiffness of the elements were all there is;
/// zero where they are at rest.
int residual(N_Vector displacement, N_Vector result, void* data)
{
    Problem& problem = *static_cast<Problem*>(data);
    std::vector<double> accelerations(problem.trials.unknowns());
    try {
        problem.trials.accelerations(NV_DATA_S(displacement), accelerations.data());
    } catch (const RunError& error) {
        problem.failure = error.what();
        return 1; // a shorter step may do
    }
    if (problem.unrest(accelerations.data()) <= static_tolerance)
        N_VConst(0, result);
    else
        problem.tangent.solve(accelerations.data(), NV_DATA_S(result));
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
    std::vector<double> place(count), before(count), after(count);
    try {
        for (std::size_t i = 0; i < count; ++i) place[i] = at[i] - scale * along[i];
        problem.trials.accelerations(place.data(), before.data());
        for (std::size_t i = 0; i < count; ++i) place[i] = at[i] + scale * along[i];
        problem.trials.accelerations(place.data(), after.data());
    } catch (const RunError& error) {
        problem.failure = error.what();
        return -1;
    }
    for (std::size_t i = 0; i < count; ++i) after[i] = (after[i] - before[i]) / (2 * scale);
    problem.tangent.solve(after.data(), NV_DATA_S(result));
    return 0;
}

void ignore_message(int, const char*, const char*, char*, void*) {}

/// KINSOL's objects, freed with this one.
class Newton {
public:
    /// From a place on; lengths count over `size`.
    Newton(Problem& problem, double size, const std::vector<double>& place)
    {
        SUNContext_Create(nullptr, &context_);
        const auto count = static_cast<sunindextype>(problem.trials.unknowns());
        value_ = N_VNew_Serial(count, context_);
        scale_ = N_VNew_Serial(count, context_);
        std::copy(place.begin(), place.end(), NV_DATA_S(value_));
        N_VConst(1 / size, scale_);
        memory_ = KINCreate(context_);
        const double vectors = problem.tangent.of_elements()
                                   ? krylov_vectors
                                   : std::clamp(krylov_memory / static_cast<double>(count), 100.0, 1000.0);
        solver_ = SUNLinSol_SPGMR(value_, SUN_PREC_NONE,
                                  std::min(static_cast<int>(count), static_cast<int>(vectors)), context_);
        const bool fine =
            KINSetErrHandlerFn(memory_, ignore_message, nullptr) == KIN_SUCCESS &&
            KINInit(memory_, residual, value_) == KIN_SUCCESS &&
            KINSetUserData(memory_, &problem) == KIN_SUCCESS &&
            KINSetLinearSolver(memory_, solver_, nullptr) == KIN_SUCCESS &&
            SUNLinSol_SPGMRSetMaxRestarts(solver_, krylov_restarts) == SUNLS_SUCCESS &&
            KINSetJacTimesVecFn(memory_, derivative) == KIN_SUCCESS &&
            KINSetFuncNormTol(memory_, 1e-100) == KIN_SUCCESS &&
            KINSetScaledStepTol(memory_, 1e-20) == KIN_SUCCESS &&
            KINSetMaxNewtonStep(memory_, std::sqrt(static_cast<double>(count))) == KIN_SUCCESS &&
            KINSetEtaForm(memory_, KIN_ETACONSTANT) == KIN_SUCCESS &&
            KINSetEtaConstValue(memory_, 1e-2) == KIN_SUCCESS &&
            KINSetNumMaxIters(memory_, problem.tangent.of_elements() ? newton_steps_beside : newton_steps) ==
                KIN_SUCCESS;
        if (!fine) throw RunError("KINSOL could not be set up for the static start");
    }
    ~Newton()
    {
        KINFree(&memory_);
        SUNLinSolFree(solver_);
        N_VDestroy(value_);
        N_VDestroy(scale_);
        SUNContext_Free(&context_);
    }
    Newton(const Newton&) = delete;
    Newton& operator=(const Newton&) = delete;

    void solve() { KINSol(memory_, value_, KIN_LINESEARCH, scale_, scale_); }
    const double* place() const { return NV_DATA_S(value_); }

private:
    SUNContext context_ = nullptr;
    N_Vector value_ = nullptr, scale_ = nullptr;
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

/// The search: where it stands, and the best place seen so far.
class Search {
public:
    /// better  is called at each place that is better than those before, with the scene there
    Search(StaticTrials& trials, double size, double reference, std::vector<double> accelerations,
           std::function<void(double unrest)> better)
        : tangent_(trials),
          problem_{trials, tangent_, reference, 1e-8 * size, {}},
          size_(size),
          accelerations_(std::move(accelerations)),
          best_(trials.unknowns()),
          unrest_(problem_.unrest(accelerations_.data())),
          least_shift_(reference / size),
          better_(std::move(better))
    {}

    bool found() const { return unrest_ <= static_tolerance; }
    const std::vector<double>& best() const { return best_; }
    /// Of the last trial that ended with an error; empty: none did.
    const std::string& failure() const { return problem_.failure; }

    void run()
    {
        if (tangent_.of_elements()) {
            descend();
            if (unrest_ <= RelaxationOutcome::allowed_unrest) return;
        }
        tangent_.measure(problem_.trials, best_.data(), problem_.length);
        tangent_.factorise(least_shift_);
        Newton newton(problem_, size_, best_);
        newton.solve();
        const double before = unrest_;
        look({newton.place(), newton.place() + best_.size()});
        if (!found() && unrest_ < before && tangent_.of_elements()) descend();
    }

private:
    StaticTangent tangent_;
    Problem problem_;
    double size_;
    std::vector<double> accelerations_; ///< of the last trial
    std::vector<double> best_;
    double unrest_; ///< there
    double least_shift_;
    std::function<void(double)> better_;

    /// False: the trial ended with an error.
    bool look(const std::vector<double>& place)
    {
        try {
            problem_.trials.accelerations(place.data(), accelerations_.data());
        } catch (const RunError& error) {
            problem_.failure = error.what();
            return false;
        }
        if (const double unrest = problem_.unrest(accelerations_.data()); unrest < unrest_) {
            unrest_ = unrest;
            best_ = place;
            better_(unrest_);
        }
        return true;
    }

    /// From the best place by steps with the stiffness there alone, damped as Levenberg (1944, Quart. Appl.
    /// Math. 2, 164-168) and Marquardt (1963, J. SIAM 11, 431-441) do: the shift falls after a step that
    /// brings rest and rises after one that does not. What has no stiffness hardly moves, so that the rest
    /// comes to its place beside water that has none.
    void descend()
    {
        constexpr int steps = 60;
        constexpr int slow_steps = 6; // in which unrest has to fall by a tenth
        std::vector<double> step(best_.size()), place;
        tangent_.measure(problem_.trials, best_.data(), problem_.length);
        look(best_);
        double shift = 1e-6 * tangent_.largest(), before = unrest_;
        tangent_.factorise(shift);
        std::vector<double> accelerations = accelerations_;
        for (int i = 0, slow = 0; i < steps && shift < tangent_.largest(); ++i) {
            tangent_.solve(accelerations.data(), step.data());
            place = best_;
            for (std::size_t k = 0; k < place.size(); ++k) place[k] -= step[k];
            const double last = unrest_;
            look(place);
            if (found()) return;
            if (unrest_ < last) accelerations = accelerations_;
            if (++slow == slow_steps) {
                if (unrest_ > 0.9 * before) return;
                slow = 0;
                before = unrest_;
            }
            if (unrest_ < 0.1 * last) continue; // as good as it can be: no need to factorise anew
            shift =
                unrest_ < last ? std::max(shift / 4, least_shift_) : 8 * std::max(shift, tangent_.shift());
            tangent_.factorise(shift);
        }
    }
};

/// What the Eulerian fluids do that have stood still meanwhile.
void look_at_fluids(Scene& scene, RelaxationOutcome& outcome)
{
    for (const auto& term : scene.terms) {
        auto* fluid = dynamic_cast<EulerianFluid*>(term.get());
        if (!fluid) continue;
        const EulerianFluid::Unrest unrest = fluid->first_unrest(scene.state);
        if (!(unrest.acceleration / outcome.reference > outcome.fluid_acceleration)) continue;
        outcome.fluid_acceleration = unrest.acceleration / outcome.reference;
        outcome.fluid_place = unrest.place;
    }
}

} // namespace

RelaxationOutcome find_equilibrium(Scene& scene, std::vector<std::unique_ptr<Recorder>>& recorders,
                                   std::vector<double>& term_seconds)
{
    StaticTrials trials(scene, term_seconds);
    RelaxationOutcome outcome;
    outcome.ran = outcome.statics = true;
    std::vector<double> place(trials.unknowns()), there(trials.unknowns());
    trials.accelerations(place.data(), there.data());
    const double largest = largest_of(trials, there.data(), 0, 3);
    outcome.reference = reference_acceleration(scene, trials.clock(), largest);
    if (outcome.reference > 0) {
        const double size = size_of(scene, trials.freedoms());
        outcome.first_acceleration = largest / outcome.reference;
        const StepVote nobody;
        const auto tell = [&](double unrest, bool last) {
            RelaxationLook look;
            look.ratio = unrest;
            Clock clock = trials.clock();
            clock.cycle = trials.count();
            look.last = last;
            const Snapshot snapshot{scene.model, clock, scene.state, scene.ledger, scene.terms, nobody, 0};
            for (auto& recorder : recorders) recorder->write_relaxation(snapshot, look);
        };
        tell(outcome.first_acceleration, false);
        Search search(trials, size, outcome.reference, there, [&](double unrest) { tell(unrest, false); });
        search.run();
        place = search.best();
        trials.accelerations(place.data(), there.data());
        outcome.last_acceleration = largest_of(trials, there.data(), 0, 3) / outcome.reference;
        look_at_fluids(scene, outcome);
        tell(outcome.last_acceleration, true);
        outcome.last_angular = largest_of(trials, there.data(), 3, 6) / outcome.reference;
    }
    outcome.cycles = trials.count();
    trials.stay(place.data());
    outcome.converged =
        std::max(outcome.last_acceleration, outcome.fluid_acceleration) <= RelaxationOutcome::allowed_unrest;
    return outcome;
}

} // namespace plash
