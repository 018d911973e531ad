#include "output/nodout.h"

#include "output/ascii_text.h"
#include "output/nodal_motion.h"

#include <fmt/format.h>

namespace plash {

namespace {

std::string table_heading(long cycle, double time, std::string_view columns)
{
    std::string text = fmt::format(
        "\n\n\n n o d a l   p r i n t   o u t   f o r   t i m e  s t e p{:8}{:30}( at time", cycle, "");
    append_scientific(text, time, 14, 7);
    fmt::format_to(std::back_inserter(text), " )\n\n nodal point  {}\n", columns);
    return text;
}

void append_vector(std::string& text, const Vec3& value)
{
    append_scientific(text, value.x, 12, 5);
    append_scientific(text, value.y, 12, 5);
    append_scientific(text, value.z, 12, 5);
}

} // namespace

std::string format_nodout(long cycle, double time, std::span<const NodeRow> rows)
{
    std::string text =
        table_heading(cycle, time,
                      "x-disp     y-disp      z-disp      x-vel       y-vel       z-vel      x-accl      "
                      "y-accl      z-accl      x-coor      y-coor      z-coor");
    for (const NodeRow& row : rows) {
        fmt::format_to(std::back_inserter(text), "{:9} ", row.id);
        append_vector(text, row.displacement);
        append_vector(text, row.velocity);
        append_vector(text, row.acceleration);
        append_vector(text, row.position);
        text += '\n';
    }
    return text;
}

std::string format_nodout(long cycle, double time, std::span<const RotationRow> rows)
{
    std::string text =
        table_heading(cycle, time,
                      "x-rot      y-rot       z-rot       x-rot vel   y-rot vel   z-rot vel   x-rot acc   "
                      "y-rot acc   z-rot acc");
    for (const RotationRow& row : rows) {
        fmt::format_to(std::back_inserter(text), "{:9} ", row.id);
        append_vector(text, row.rotation);
        append_vector(text, row.angular_velocity);
        append_vector(text, row.angular_acceleration);
        text += '\n';
    }
    return text;
}

NodoutRecorder::NodoutRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)),
      nodes_(model.controls.output.history_nodes),
      rotation_(nodes_.size()),
      file_(path)
{
    std::string entries;
    for (Index node : nodes_) entries += legend_entry(model.nodes.id[node], "", 80);
    file_.write(ascii_heading(model) + ascii_legend(entries));
}

void NodoutRecorder::follow(const Clock& clock, const State& state)
{
    if (!state.rotational()) return;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        rotation_[i] += clock.step * state.angular_velocity[nodes_[i]];
    }
}

void NodoutRecorder::write_state(const Snapshot& snapshot)
{
    const long cycle = snapshot.clock.cycle + 1;
    const double time = snapshot.clock.time;
    const bool rotations = snapshot.state.rotational();
    const NodalMotion motion(snapshot, rotations);

    std::vector<NodeRow> rows;
    std::vector<RotationRow> rotation_rows;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Index node = nodes_[i];
        const Id id = snapshot.model.nodes.id[node];
        rows.push_back({id, motion.displacement(node), motion.velocity(node), motion.acceleration(node),
                        motion.position(node)});
        if (rotations) {
            rotation_rows.push_back(
                {id, rotation_[i], motion.angular_velocity(node), motion.angular_acceleration(node)});
        }
    }
    file_.write(format_nodout(cycle, time, rows));
    if (rotations) file_.write(format_nodout(cycle, time, rotation_rows));
    file_.flush();
}

} // namespace plash
