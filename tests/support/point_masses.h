#pragma once

#include "core/recorder.h"
#include "model/model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"

#include <cmath>
#include <initializer_list>
#include <stdexcept>

namespace plash::testing {

/// A Model of free point masses (*ELEMENT_MASS) that runs `cycles` steps to `end_time`: nothing limits the
/// step, so the loop takes a thousandth of the end unless the curve of largest steps says otherwise.
inline Model point_masses(std::initializer_list<Vec3> places, double mass, double end_time, int cycles)
{
    Model model;
    for (const Vec3& place : places) {
        const Id id = static_cast<Id>(model.nodes.size()) + 1;
        model.nodes.id.push_back(id);
        model.nodes.position.push_back(place);
        model.masses.id.push_back(id);
        model.masses.node.push_back(static_cast<Index>(id) - 1);
        model.masses.mass.push_back(mass);
    }
    model.controls.time.end_time = end_time;
    const double step = end_time / cycles;
    model.curves.push_back({1, "step", {}, Curve{{0, 1e9}, {step, step}}});
    model.controls.time.largest_step_curve = 0;
    model.controls.time.step_scale = 1;
    return model;
}

inline void set_velocity(Model& model, Index node, const Vec3& velocity)
{
    InitialVelocity initial;
    initial.nodes = {node};
    initial.translation = velocity;
    model.initial_velocities.push_back(initial);
}

/// A curve of constant value.
inline Index add_constant(Model& model, double value)
{
    model.curves.push_back(
        {static_cast<Id>(model.curves.size()) + 1, "", {}, Curve{{-1e9, 1e9}, {value, value}}});
    return static_cast<Index>(model.curves.size()) - 1;
}

/// Runs and returns the scene at the end.
inline Scene run_to_end(const Model& model, std::unique_ptr<Recorder> watch = nullptr)
{
    Scene scene = make_scene(model);
    Recorders recorders;
    if (watch) recorders.push_back(std::move(watch));
    const Outcome outcome = run(scene, recorders);
    if (outcome.termination != Outcome::Termination::normal)
        throw std::runtime_error("the run ended early: " + outcome.message);
    return scene;
}

} // namespace plash::testing
