#include "output/bndout.h"

#include "output/ascii_text.h"

#include <fmt/format.h>
#include <map>
#include <vector>

namespace plash {

namespace {

void append_value(std::string& text, std::string_view name, double value)
{
    text += name;
    append_scientific(text, value, 13, 4);
}

void append_table(std::string& text, double time, std::string_view title, std::span<const BoundaryRow> rows)
{
    if (rows.empty()) return;
    text += "\n\n\n\n\n n o d a l   f o r c e/e n e r g y    o u t p u t   t=";
    append_scientific(text, time, 9, 3);
    fmt::format_to(std::back_inserter(text), "\n\n\n\n\n\n {} \n\n", title);
    Vec3 sum{};
    double energy = 0;
    for (const BoundaryRow& row : rows) {
        fmt::format_to(std::back_inserter(text), "{}{:8}", row.rigid_part ? "mat#" : " nd#", row.id);
        append_value(text, "  xforce=", row.force.x);
        append_value(text, "   yforce=", row.force.y);
        append_value(text, "  zforce=", row.force.z);
        append_value(text, "   energy=", row.energy);
        text += '\n';
        if (row.rigid_part) {
            append_value(text, "             xmoment=", row.moment.x);
            append_value(text, "  ymoment=", row.moment.y);
            append_value(text, " zmoment=", row.moment.z);
            text += '\n';
        }
        sum += row.force;
        energy += row.energy;
    }
    append_value(text, "              xtotal=", sum.x);
    append_value(text, "   ytotal=", sum.y);
    append_value(text, "  ztotal=", sum.z);
    append_value(text, "   etotal=", energy);
    text += '\n';
}

} // namespace

std::vector<BoundaryRow> boundary_rows(const std::vector<ElementResults::BoundaryForce>& forces,
                                       const Model& model)
{
    std::map<std::pair<bool, Id>, BoundaryRow> sums;
    for (const auto& force : forces) {
        const bool rigid = force.node == none;
        const Id id = rigid ? model.body_id(force.rigid_part) : model.nodes.id[force.node];
        BoundaryRow& row = sums[{rigid, id}];
        row.id = id;
        row.rigid_part = rigid;
        row.force += force.force;
        row.moment += force.moment;
        row.energy += force.energy;
    }
    std::vector<BoundaryRow> rows;
    for (const auto& [key, row] : sums) rows.push_back(row);
    return rows;
}

std::string format_bndout(double time, std::span<const BoundaryRow> loads,
                          std::span<const BoundaryRow> motions)
{
    std::string text;
    append_table(text, time, "discrete nodal point forces", loads);
    append_table(text, time, "velocity boundary condition forces/rigid body moments", motions);
    return text;
}

BndoutRecorder::BndoutRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    file_.write(ascii_heading(model) + "\n\n");
}

void BndoutRecorder::write_state(const Snapshot& snapshot)
{
    ElementResults results;
    results.boundary_forces_wanted = true;
    snapshot.collect(results);
    file_.write(format_bndout(snapshot.clock.time, boundary_rows(results.loads, snapshot.model),
                              boundary_rows(results.motions, snapshot.model)));
    file_.flush();
}

} // namespace plash
