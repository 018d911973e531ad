#include "solver/fluids/translate.h"
#include "tests/support/ale_deck.h"
#include "tests/support/water_deck.h"

#include <cmath>

/// One deck whose water runs as solids, as particles and as an Eulerian mesh.
namespace plash {

namespace {

using testing::WaterDeck;

/// A deck that is read, translated and run.
struct FormRun {
    ReadResult read;
    std::vector<std::string> lines;
    std::unique_ptr<Scene> scene;
    Outcome outcome;

    FormRun(const std::string& text, std::string_view form) : read(read_model_text("deck.k", text))
    {
        for (const Message& error : read.report.errors) ADD_FAILURE() << to_text(error, read.model);
        lines = translate_fluid(read.model, fluid_choice_of(read.model, form));
        scene = std::make_unique<Scene>(make_scene(read.model));
    }
    /// watch(clock, state) in every cycle.
    void go(const std::function<void(const Clock&, const State&)>& watch = {})
    {
        struct Watch : Recorder {
            std::function<void(const Clock&, const State&)> call;
            double next_time() const override { return 1e300; }
            void write(const Snapshot&) override {}
            void follow(const Clock& clock, const State& state) override { call(clock, state); }
        };
        Recorders recorders;
        if (watch) {
            auto recorder = std::make_unique<Watch>();
            recorder->call = watch;
            recorders.push_back(std::move(recorder));
        }
        outcome = run(*scene, recorders);
        EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    }
    std::string all_lines() const
    {
        std::string text;
        for (const std::string& line : lines) text += line + "\n";
        return text;
    }
    double velocity(int id) const
    {
        const auto& ids = read.model.nodes.id;
        return scene->state.velocity[std::find(ids.begin(), ids.end(), id) - ids.begin()].z;
    }
};

std::string refusal(const std::string& text, std::string_view form)
{
    ReadResult read = read_model_text("deck.k", text);
    for (const Message& error : read.report.errors) ADD_FAILURE() << to_text(error, read.model);
    try {
        translate_fluid(read.model, fluid_choice_of(read.model, form));
    } catch (const DeckError& error) {
        return error.what();
    }
    return "";
}

bool holds(const std::string& text, std::string_view part)
{
    return text.find(part) != std::string::npos;
}

} // namespace

/// A piston of mass M on a column of water slows down as it sends a wave into it, M dv/dt = -rho c A v, until the
/// wave comes back from the floor at 2 H / c: v = V exp(-rho c A t / M).
TEST(FluidForms, PistonOnAColumnSlowsDownAsItsWaveWants)
{
    WaterDeck deck;
    deck.end = 2.5e-3;
    const double rate = 1000 * deck.sound * deck.width * deck.depth / deck.mass;
    for (const char* form : {"lagrange", "sph", "ale"}) {
        FormRun run(deck.text(), form);
        double worst = 0;
        const auto& ids = run.read.model.nodes.id;
        const auto node = std::find(ids.begin(), ids.end(), deck.block_node()) - ids.begin();
        run.go([&](const Clock& clock, const State& state) {
            const double exact = -deck.speed * std::exp(-rate * clock.time);
            worst = std::max(worst, std::abs(state.velocity[node].z - exact));
        });
        fprintf(stderr, "%s worst %g at end %g exact %g balance %g\n%s", form, worst, run.velocity(deck.block_node()), -std::exp(-rate*run.outcome.clock.time), run.scene->ledger.balance_error(), run.all_lines().c_str());
        EXPECT_LT(worst, 0.03) << form;
        EXPECT_LT(run.scene->ledger.balance_error(), 0.01) << form;
    }
}

/// A wedge of 30 degrees enters water that is 1.3 times as deep as it is wide, and slows down by the added mass of
/// the similarity solution (force 14.023 rho V^2 s at the penetration s, half of it here; see
/// examples/wedge_drop/compare.py).
TEST(FluidForms, WedgeSlowsDownByItsAddedMass)
{
    WaterDeck deck;
    deck.width = 0.12;
    deck.height = 0.08;
    deck.depth = 0.005;
    deck.nx = 48;
    deck.nz = 32;
    deck.ny = 2;
    deck.sound = 100;
    deck.speed = 1;
    deck.cover = 0.5;
    deck.mass = 0.005;
    deck.end = 16e-3;
    deck.keel = [](double x) { return x * std::tan(M_PI / 6); };
    double taken[3];
    int number = 0;
    for (const char* form : {"sph", "ale", "lagrange"}) {
        FormRun run(deck.text(), form);
        run.go();
        const double added = 0.5 * 0.5 * 14.023 * 1000 * deck.depth; // of half a wedge, over s^2
        double v = deck.speed, s = 0;
        const int steps = 20000;
        const double step = run.outcome.clock.time / steps;
        for (int i = 0; i < steps; ++i) {
            v += step * (-2 * added * s * v * v / (deck.mass + added * s * s));
            s += step * v;
        }
        taken[number++] = deck.speed + run.velocity(deck.block_node());
        fprintf(stderr, "%s taken %g wanted %g depth %g cycles %ld wall %g balance %g\n%s", form, taken[number - 1], deck.speed - v, s, run.outcome.clock.cycle, run.outcome.wall_seconds, run.scene->ledger.balance_error(), run.all_lines().c_str());
    }
}

} // namespace plash
