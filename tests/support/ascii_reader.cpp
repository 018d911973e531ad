#include "tests/support/ascii_reader.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace plash::testing {

namespace {

/// Lines of a text, one after another.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}
    bool done() const { return rest_.empty(); }
    std::string_view peek() const { return rest_.substr(0, rest_.find('\n')); }
    std::string_view next()
    {
        const std::string_view line = peek();
        rest_.remove_prefix(std::min(rest_.size(), line.size() + 1));
        return line;
    }
    bool next_is(std::string_view start) const { return peek().starts_with(start); }
    void expect(std::string_view line)
    {
        const std::string_view found = next();
        if (found != line)
            throw std::runtime_error("expected '" + std::string(line) + "', found '" + std::string(found) +
                                     "'");
    }
    void skip_blank()
    {
        while (!done() && peek().empty()) next();
    }

private:
    std::string_view rest_;
};

double number(std::string_view line, std::size_t column, std::size_t width)
{
    std::string field(line.substr(column, width));
    return std::stod(field);
}

Vec3 vector(std::string_view line, std::size_t column, std::size_t width, std::size_t gap = 0)
{
    return {number(line, column, width), number(line, column + width + gap, width),
            number(line, column + 2 * (width + gap), width)};
}

std::string read_heading(Lines& lines)
{
    const std::string first(lines.next());
    return first + "\n" + std::string(lines.next()) + "\n";
}

std::string read_legend(Lines& lines)
{
    lines.expect("");
    lines.expect("{BEGIN LEGEND}");
    lines.expect(" Entity #        Title");
    std::string entries;
    while (!lines.next_is("{END LEGEND}")) entries += std::string(lines.next()) + "\n";
    lines.next();
    return entries;
}

} // namespace

GlstatFile read_glstat(std::string_view text)
{
    Lines lines(text);
    GlstatFile file;
    file.heading = read_heading(lines);
    lines.skip_blank();
    while (!lines.done()) {
        GlobalStatistics& state = file.states.emplace_back();
        const std::string owner(lines.next());
        state.cycle = std::stol(owner.substr(12, 8));
        const std::size_t kind = owner.find("controlled by ") + 14;
        if (!owner.substr(kind).starts_with("load curve")) {
            state.owner.kind = owner.substr(kind).starts_with("solid") ? "solid" : "shell";
            state.owner.element = std::stol(owner.substr(kind + 10, 10));
            state.owner.part = std::stol(owner.substr(owner.find("of part") + 7));
        }
        lines.expect("");
        std::map<std::string, double> values;
        for (lines.skip_blank(); !lines.done() && !lines.peek().empty();) {
            const std::string_view line = lines.next();
            std::string name(line.substr(1, 31));
            if (line.size() < 46) throw std::runtime_error("short line: " + std::string(line));
            const double value = number(line, 32, 14);
            name.erase(name.find_last_not_of(". ") + 1);
            if (name.starts_with("stonewall")) {
                state.stonewall.push_back(value);
            } else {
                values[name] = value;
            }
        }
        state.time = values.at("time");
        state.step = values.at("time step");
        state.kinetic = values.at("kinetic energy");
        state.internal = values.at("internal energy");
        state.spring_and_damper = values.at("spring and damper energy");
        file.with_hourglass = values.contains("hourglass energy");
        if (file.with_hourglass) state.hourglass = values.at("hourglass energy");
        state.damping = values.at("system damping energy");
        state.sliding = values.at("sliding interface energy");
        state.external_work = values.at("external work");
        state.eroded_kinetic = values.at("eroded kinetic energy");
        state.eroded_internal = values.at("eroded internal energy");
        state.eroded_hourglass = values.at("eroded hourglass energy");
        state.total = values.at("total energy");
        state.energy_ratio = values.at("total energy / initial energy");
        state.energy_ratio_without_eroded = values.at("energy ratio w/o eroded energy");
        state.velocity = {values.at("global x velocity"), values.at("global y velocity"),
                          values.at("global z velocity")};
        lines.skip_blank();
    }
    return file;
}

MatsumFile read_matsum(std::string_view text)
{
    Lines lines(text);
    MatsumFile file;
    file.heading = read_heading(lines);
    file.legend = read_legend(lines);
    for (lines.skip_blank(); !lines.done(); lines.skip_blank()) {
        if (lines.next_is(" time =")) {
            file.times.push_back(number(lines.next(), 7, 13));
            file.states.emplace_back();
            continue;
        }
        PartStatistics& part = file.states.back().emplace_back();
        const std::string_view energies = lines.next();
        if (!energies.starts_with(" mat.#=")) throw std::runtime_error("no part: " + std::string(energies));
        part.id = std::stol(std::string(energies.substr(7, 8)));
        part.internal = number(energies, 31, 13);
        part.kinetic = number(energies, 55, 13);
        part.eroded_internal = number(energies, 83, 13);
        part.eroded_kinetic = number(energies, 111, 13);
        part.momentum = vector(lines.next(), 7, 13, 11);
        part.rigid_body_velocity = vector(lines.next(), 7, 13, 11);
        part.hourglass = number(lines.next(), 31, 13);
    }
    return file;
}

NodoutFile read_nodout(std::string_view text)
{
    Lines lines(text);
    NodoutFile file;
    file.heading = read_heading(lines);
    file.legend = read_legend(lines);
    for (lines.skip_blank(); !lines.done(); lines.skip_blank()) {
        NodoutFile::Table& table = file.tables.emplace_back();
        const std::string_view heading = lines.next();
        table.cycle = std::stol(std::string(heading.substr(heading.find("s t e p") + 7, 8)));
        table.time = number(heading, heading.find("at time") + 7, 14);
        lines.expect("");
        const bool motion = lines.next().starts_with(" nodal point  x-disp");
        while (!lines.done() && !lines.peek().empty()) {
            const std::string_view line = lines.next();
            const Id id = std::stol(std::string(line.substr(0, 9)));
            if (motion) {
                table.motion.push_back({id, vector(line, 10, 12), vector(line, 46, 12), vector(line, 82, 12),
                                        vector(line, 118, 12)});
            } else {
                table.rotation.push_back(
                    {id, vector(line, 10, 12), vector(line, 46, 12), vector(line, 82, 12)});
            }
        }
    }
    return file;
}

ContactFile read_rcforc(std::string_view text)
{
    Lines lines(text);
    ContactFile file;
    file.heading = read_heading(lines);
    file.legend = read_legend(lines);
    lines.expect("");
    double time = -1;
    std::vector<ElementResults::ContactForce> pending; // single surfaces before the first line with a time
    while (!lines.done()) {
        ElementResults::ContactForce contact;
        const std::string_view line = lines.next();
        const std::string_view other = lines.next();
        if (line.starts_with(" interface number,")) {
            contact.contact = static_cast<Id>(number(line, 18, 10));
            contact.two_sides = false;
            pending.push_back(contact);
        } else {
            const double now = number(line, 24, 12);
            contact.contact = static_cast<Id>(number(line, 8, 11));
            const auto side = [](std::string_view row, Vec3& force, double& mass, Vec3& moment) {
                force = {number(row, 40, 12), number(row, 56, 12), number(row, 72, 12)};
                mass = number(row, 90, 12);
                moment = {number(row, 107, 12), number(row, 124, 12), number(row, 141, 12)};
            };
            side(line, contact.slave_force, contact.slave_mass, contact.slave_moment);
            side(other, contact.master_force, contact.master_mass, contact.master_moment);
            pending.push_back(contact);
            if (now != time) file.states.push_back({now, 0, {}, {}});
            time = now;
        }
        // A state is complete when as many contacts as in the legend have come.
        const auto count = std::count(file.legend.begin(), file.legend.end(), '\n');
        if (static_cast<long>(pending.size()) < count || file.states.empty()) continue;
        file.states.back().contacts = std::move(pending);
        pending.clear();
    }
    return file;
}

ContactFile read_sleout(std::string_view text)
{
    Lines lines(text);
    ContactFile file;
    file.heading = read_heading(lines);
    file.legend = read_legend(lines);
    lines.skip_blank();
    while (!lines.done()) {
        ContactFile::State& state = file.states.emplace_back();
        state.time = number(lines.next(), 37, 14);
        state.cycle = static_cast<long>(number(lines.next(), 52, 14));
        lines.expect("");
        while (!lines.peek().empty()) {
            const std::string_view line = lines.next();
            ElementResults::ContactForce contact;
            contact.contact = static_cast<Id>(number(line, 0, 10));
            contact.slave_energy = number(line, 10, 13);
            contact.master_energy = number(line, 23, 13);
            contact.friction_energy = number(line, 64, 13);
            state.contacts.push_back(contact);
        }
        lines.expect("");
        for (double& total : state.total) total = number(lines.next(), 28, 14);
        lines.skip_blank();
    }
    return file;
}

} // namespace plash::testing
