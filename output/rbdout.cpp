#include "output/rbdout.h"

#include "output/ascii_text.h"

#include <fmt/format.h>

namespace plash {

namespace {

void append_motion(std::string& text, const Vec3& value)
{
    for (double component : {value.x, value.y, value.z}) append_scientific(text, component, 12, 4);
}

void append_row(std::string& text, std::string_view name, const Vec3& translation, const Vec3& rotation)
{
    fmt::format_to(std::back_inserter(text), "{:>15}", name);
    append_motion(text, translation);
    append_motion(text, rotation);
    text += '\n';
}

Vec3 along(const std::array<Vec3, 3>& axes, const Vec3& value)
{
    return {dot(axes[0], value), dot(axes[1], value), dot(axes[2], value)};
}

} // namespace

std::string format_rbdout(long cycle, double time, std::span<const ElementResults::RigidMotion> bodies)
{
    std::string text = fmt::format("\n\n  r i g i d   b o d y   m o t i o n   a t  cycle={:8}  time=", cycle);
    append_scientific(text, time, 12, 5);
    text += "\n";
    for (const auto& body : bodies) {
        fmt::format_to(std::back_inserter(text), "\n {}rigid body{:8}\n", body.nodal ? "nodal " : "",
                       body.body);
        text += "   global             x           y           z       x-rot       y-rot       z-rot\n";
        fmt::format_to(std::back_inserter(text), "{:>15}", "coordinates:");
        append_motion(text, body.place);
        text += '\n';
        append_row(text, "displacements:", body.displacement, body.angle);
        append_row(text, "velocities:", body.velocity, body.angular_velocity);
        append_row(text, "accelerations:", body.acceleration, body.angular_acceleration);
        text += "\n principal or user defined local coordinate direction vectors\n";
        text += "                     a           b           c\n";
        const auto& [a, b, c] = body.axes;
        const Vec3 rows[3] = {{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}};
        for (int row = 0; row < 3; ++row) {
            fmt::format_to(std::back_inserter(text), "     row {}     ", row + 1);
            append_motion(text, rows[row]);
            text += '\n';
        }
        text += "\n output in principal or user defined local coordinate directions\n";
        text += "                     a           b           c       a-rot       b-rot       c-rot\n";
        append_row(text, "displacements:", along(body.axes, body.displacement), along(body.axes, body.angle));
        append_row(text, "velocities:", along(body.axes, body.velocity),
                   along(body.axes, body.angular_velocity));
        append_row(text, "accelerations:", along(body.axes, body.acceleration),
                   along(body.axes, body.angular_acceleration));
    }
    return text;
}

RbdoutRecorder::RbdoutRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    file_.write(ascii_heading(model));
}

void RbdoutRecorder::write_state(const Snapshot& snapshot)
{
    ElementResults results;
    results.rigid_motions_wanted = true;
    snapshot.collect(results);
    file_.write(format_rbdout(snapshot.clock.cycle, snapshot.clock.time, results.rigid_bodies));
    file_.flush();
}

} // namespace plash
