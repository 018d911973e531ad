#include "output/contact_files.h"

#include "output/ascii_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

using ContactForce = ElementResults::ContactForce;

/// As Fortran's Ew.d prints it: the mantissa between 0.1 and 1.
void append_fraction(std::string& text, double value, int width, int digits)
{
    if (!std::isfinite(value)) {
        fmt::format_to(std::back_inserter(text), "{:>{}}", value, width);
        return;
    }
    // The mantissa of the exponent form, one place shorter, moved by one place.
    std::string number = fmt::format("{:.{}E}", std::abs(value), digits - 1);
    const std::size_t at = number.find('E');
    const int exponent = value == 0 ? 0 : std::stoi(number.substr(at + 1)) + 1;
    std::string mantissa = number.substr(0, at);
    std::erase(mantissa, '.');
    fmt::format_to(std::back_inserter(text), "{:>{}}",
                   fmt::format("{}0.{}E{:+03}", std::signbit(value) ? "-" : "", mantissa, exponent), width);
}

/// Titles of the contacts by rising number.
std::string contact_legend(const Model& model)
{
    std::vector<const Contact*> contacts;
    for (const Contact& contact : model.contacts) contacts.push_back(&contact);
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact* a, const Contact* b) { return a->id < b->id; });
    std::string entries;
    for (const Contact* contact : contacts) entries += legend_entry(contact->id, contact->title, 70);
    return ascii_legend(entries);
}

void append_side(std::string& text, std::string_view side, Id contact, double time, const Vec3& force,
                 double mass, const Vec3& moment)
{
    fmt::format_to(std::back_inserter(text), "  {:<6}{:11} time", side, contact);
    append_scientific(text, time, 12, 5);
    const auto append = [&](std::string_view name, double value) {
        text += name;
        append_scientific(text, value, 12, 5);
    };
    append("  x ", force.x);
    append("  y ", force.y);
    append("  z ", force.z);
    append(" mass ", mass);
    append("  mx ", moment.x);
    append("  my ", moment.y);
    append("  mz ", moment.z);
    text += '\n';
}

std::vector<ContactForce> contact_forces(const Snapshot& snapshot)
{
    ElementResults results;
    snapshot.collect(results);
    return std::move(results.contacts);
}

} // namespace

std::string format_rcforc(double time, std::span<const ContactForce> contacts)
{
    std::string text;
    for (const ContactForce& contact : contacts) {
        if (!contact.two_sides) {
            for (int side = 0; side < 2; ++side) {
                fmt::format_to(std::back_inserter(text),
                               " interface number,{:10},is single surface-resultants are undefined\n",
                               contact.contact);
            }
            continue;
        }
        append_side(text, "slave", contact.contact, time, contact.slave_force, contact.slave_mass,
                    contact.slave_moment);
        append_side(text, "master", contact.contact, time, contact.master_force, contact.master_mass,
                    contact.master_moment);
    }
    return text;
}

std::string format_sleout(double time, long cycle, std::span<const ContactForce> contacts)
{
    std::string text = "\n\n\n contact interface energy file, time=";
    append_fraction(text, time, 14, 7);
    fmt::format_to(std::back_inserter(text),
                   "\n    #             slave       master       cycle={:14}    frictional\n\n", cycle);
    double slave = 0, master = 0, friction = 0;
    for (const ContactForce& contact : contacts) {
        fmt::format_to(std::back_inserter(text), "{:10}", contact.contact);
        append_fraction(text, contact.slave_energy, 13, 4);
        append_fraction(text, contact.master_energy, 13, 4);
        text += std::string(28, ' ');
        append_fraction(text, contact.friction_energy, 13, 4);
        text += '\n';
        slave += contact.slave_energy;
        master += contact.master_energy;
        friction += contact.friction_energy;
    }
    const auto append = [&](std::string_view name, double value) {
        text += name;
        append_fraction(text, value, 14, 7);
        text += '\n';
    };
    append("\n summary   total slave side=", slave);
    append("           total mastr side=", master);
    append("           total energy    =", slave + master);
    append("           friction energy =", friction);
    return text + "\n\n\n";
}

std::string format_ncforc(double time, std::span<const NodeContactForce> nodes)
{
    std::string text = "\n\n forces (t=";
    append_scientific(text, time, 12, 5);
    text += " ) on the nodes in contact\n\n      node        x-force     y-force     z-force           x     "
            "      y"
            "           z\n";
    for (const NodeContactForce& node : nodes) {
        fmt::format_to(std::back_inserter(text), "{:10}   ", node.node);
        for (const Vec3& vector : {node.force, node.position}) {
            append_scientific(text, vector.x, 12, 4);
            append_scientific(text, vector.y, 12, 4);
            append_scientific(text, vector.z, 12, 4);
        }
        text += '\n';
    }
    return text;
}

RcforcRecorder::RcforcRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    file_.write(ascii_heading(model) + contact_legend(model));
}

void RcforcRecorder::write_state(const Snapshot& snapshot)
{
    file_.write(format_rcforc(snapshot.clock.time, contact_forces(snapshot)));
    file_.flush();
}

SleoutRecorder::SleoutRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    file_.write(ascii_heading(model) + contact_legend(model));
}

void SleoutRecorder::write_state(const Snapshot& snapshot)
{
    // LS-DYNA counts cycles from 1.
    file_.write(format_sleout(snapshot.clock.time, snapshot.clock.cycle + 1, contact_forces(snapshot)));
    file_.flush();
}

NcforcRecorder::NcforcRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    file_.write(ascii_heading(model));
}

void NcforcRecorder::write_state(const Snapshot& snapshot)
{
    ElementResults results;
    results.contact_force.resize(snapshot.model.nodes.size());
    snapshot.collect(results);
    std::vector<NodeContactForce> nodes;
    for (std::size_t node = 0; node < results.contact_force.size(); ++node) {
        const Vec3& force = results.contact_force[node];
        if (dot(force, force) == 0) continue;
        nodes.push_back({snapshot.model.nodes.id[node], force, snapshot.state.position[node]});
    }
    file_.write(format_ncforc(snapshot.clock.time, nodes));
    file_.flush();
}

} // namespace plash
