#include "output/abstat.h"

#include "output/ascii_text.h"

#include <fmt/format.h>

namespace plash {

namespace {

using Bag = ElementResults::AirbagState;

double density_of(const Bag& bag)
{
    return bag.mass / bag.volume;
}

/// What is shown of a bag: the name in binout, the heading of its column, and the value.
struct Column {
    const char* name;
    const char* heading;
    double (*value)(const Bag&);
};

constexpr Column columns[] = {
    {"volume", "volume", [](const Bag& bag) { return bag.volume; }},
    {"pressure", "pressure", [](const Bag& bag) { return bag.pressure; }},
    {"internal_energy", "int. energy", [](const Bag& bag) { return bag.internal_energy; }},
    {"dm_dt_in", "dm/dt in", [](const Bag& bag) { return bag.inflow; }},
    {"density", "density", density_of},
    {"dm_dt_out", "dm/dt out", [](const Bag& bag) { return bag.outflow; }},
    {"total_mass", "total mass", [](const Bag& bag) { return bag.mass; }},
    {"gas_temp", "gas temp.", [](const Bag& bag) { return bag.temperature; }},
    {"surface_area", "surf. area", [](const Bag& bag) { return bag.area; }},
};

class AbstatSection final : public BinoutSection {
public:
    explicit AbstatSection(const Model& model)
    {
        for (const Airbag& airbag : model.airbags) ids_.push_back(airbag.id);
    }

private:
    std::vector<Id> ids_;

    void write_metadata(ArrayFile& file) const override { file.put("ids", ids_); }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        ElementResults results;
        snapshot.collect(results);
        for (const Column& column : columns) {
            std::vector<double> values;
            for (const Bag& bag : results.airbags) values.push_back(column.value(bag));
            file.put(column.name, values);
        }
    }
};

} // namespace

AbstatRecorder::AbstatRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    std::string entries;
    for (const Airbag& airbag : model.airbags)
        if (!airbag.title.empty()) entries += legend_entry(airbag.id, airbag.title, 80);
    std::string text = ascii_heading(model) + (entries.empty() ? "\n\n" : ascii_legend(entries)) +
                       "\n\n    time       airbag#";
    for (const Column& column : columns) text += fmt::format("{:>14}", column.heading);
    file_.write(text + "\n");
}

void AbstatRecorder::write_state(const Snapshot& snapshot)
{
    ElementResults results;
    snapshot.collect(results);
    std::string text;
    for (const Bag& bag : results.airbags) {
        append_scientific(text, snapshot.clock.time, 12, 5);
        fmt::format_to(std::back_inserter(text), "{:9}", bag.airbag);
        for (const Column& column : columns) append_scientific(text, column.value(bag), 14, 5);
        text += '\n';
    }
    file_.write(text);
    file_.flush();
}

std::unique_ptr<BinoutSection> make_abstat_section(const Model& model)
{
    return std::make_unique<AbstatSection>(model);
}

} // namespace plash
