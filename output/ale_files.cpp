#include "output/ale_files.h"

#include "model/eulerian.h"
#include "output/ascii_text.h"
#include "output/binout_arrays.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

Vec3 middle_of(const std::array<Index, 8>& nodes, const std::vector<Vec3>& position)
{
    Vec3 sum{};
    for (const Index node : nodes) sum += 0.125 * position[node];
    return sum;
}

/// The list of *DATABASE_ALE: numbers, where an empty column between two stands for those between them.
std::vector<int> read_variables(const Record& record)
{
    std::vector<int> variables;
    const auto add = [&](int number) {
        if (number == 16) {
            for (int stress = 1; stress <= 6; ++stress) variables.push_back(stress);
            return;
        }
        if (FluidCellHistories::name_of(number).empty())
            throw DeckError(record.where,
                            fmt::format("*DATABASE_ALE, field VAR: {} is not supported; there are 1 to 8 and "
                                        "11 to 16",
                                        number));
        variables.push_back(number);
    };
    const Table* table = record.table("VAR1");
    int last = 0;
    bool between = false;
    for (std::size_t i = 0; table && i < table->values.size(); ++i) {
        const int number = static_cast<int>(std::lround(table->values[i]));
        if (number == 0) {
            between = last != 0;
            continue;
        }
        if (between)
            for (int inner = last + 1; inner < number; ++inner) add(inner);
        between = false;
        add(number);
        last = number;
    }
    return variables;
}

Schedule schedule_of_output(const Record& record)
{
    return Schedule(record.real("DTOUT"));
}

class AlematSection final : public BinoutSection {
public:
    AlematSection(const Model& model, const Record& record) : sums_(model, record) {}

private:
    FluidGroupSums sums_;

    void write_metadata(ArrayFile& file) const override
    {
        std::vector<Id> boxes, groups;
        for (const FluidGroupSums::Row& row : sums_.frame()) {
            boxes.push_back(row.box);
            groups.push_back(row.group);
        }
        file.put("boxes", boxes);
        file.put("ids", groups);
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        using Sum = ElementResults::FluidSum;
        const auto rows = sums_.rows(snapshot);
        const auto put = [&](const char* name, auto&& value) {
            std::vector<double> column;
            for (const FluidGroupSums::Row& row : rows) column.push_back(value(row.sum));
            file.put(name, column);
        };
        put("volume", [](const Sum& sum) { return sum.volume; });
        put("mass", [](const Sum& sum) { return sum.mass; });
        put("x_momentum", [](const Sum& sum) { return sum.momentum[0]; });
        put("y_momentum", [](const Sum& sum) { return sum.momentum[1]; });
        put("z_momentum", [](const Sum& sum) { return sum.momentum[2]; });
        put("kinetic_energy", [](const Sum& sum) { return sum.kinetic; });
        put("internal_energy", [](const Sum& sum) { return sum.internal; });
        put("lowest_pressure", [](const Sum& sum) { return sum.lowest_pressure; });
        put("highest_pressure", [](const Sum& sum) { return sum.highest_pressure; });
    }
};

class DbaleSection final : public BinoutSection {
public:
    DbaleSection(const Model& model, const Record& record) : model_(model), cells_(model, record) {}

private:
    const Model& model_;
    FluidCellHistories cells_;

    void write_metadata(ArrayFile& file) const override
    {
        std::vector<Id> ids;
        for (const Index solid : cells_.solids()) ids.push_back(model_.solids.id[solid]);
        file.put("ids", ids);
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        const auto values = cells_.values(snapshot);
        const std::vector<double> means = FluidCellHistories::means_of(values);
        for (std::size_t v = 0; v < cells_.variables().size(); ++v) {
            std::vector<double> column;
            for (const auto& cell : values) column.push_back(cell[v]);
            const std::string_view name = FluidCellHistories::name_of(cells_.variables()[v]);
            file.put(name, column);
            if (cells_.means()) file.put_number(fmt::format("average_{}", name), means[v]);
        }
    }
};

template <class Recorder, class Section>
void add_ale_recorder(const Model& model, const Record& record, const std::string& name,
                      const ResultPath& path, ArrayRecorders arrays,
                      std::vector<std::unique_ptr<plash::Recorder>>& recorders)
{
    recorders.push_back(std::make_unique<Recorder>(model, record, path));
    for (BinoutRecorder* file : arrays)
        if (file)
            file->add(name, schedule_of_output(record), std::make_unique<Section>(model, record), model);
}

} // namespace

FluidGroupSums::FluidGroupSums(const Model& model, const Record& record)
    : groups_(has_eulerian_mesh(model) ? multi_material_groups(model) : 0)
{
    const Id low = record.integer("BOXLOW"), high = record.integer("BOXUP");
    for (const NamedBox& box : model.boxes)
        if (low != 0 && box.id >= low && box.id <= std::max(low, high)) boxes_.push_back(box);
    if (low != 0 && boxes_.empty())
        throw DeckError(record.where, fmt::format("*DATABASE_ALE_MAT, field BOXLOW: there is no *DEFINE_BOX "
                                                  "from {} to {}",
                                                  low, std::max(low, high)));
    for (std::size_t region = 0; region < std::max<std::size_t>(boxes_.size(), 1); ++region)
        for (std::size_t group = 0; group < groups_; ++group)
            frame_.push_back({boxes_.empty() ? 0 : boxes_[region].id, static_cast<Id>(group) + 1, {}});
}

std::vector<FluidGroupSums::Row> FluidGroupSums::rows(const Snapshot& snapshot) const
{
    const Model& model = snapshot.model;
    ElementResults results;
    results.fluid_regions.resize(std::max<std::size_t>(boxes_.size(), 1));
    for (std::size_t region = 0; region < results.fluid_regions.size(); ++region) {
        results.fluid_regions[region].groups.resize(groups_);
        if (boxes_.empty()) continue;
        std::vector<bool>& inside = results.fluid_regions[region].solids;
        inside.resize(model.solids.size());
        for (std::size_t solid = 0; solid < inside.size(); ++solid)
            inside[solid] =
                boxes_[region].box.holds(middle_of(model.solids.nodes[solid], snapshot.state.position));
    }
    snapshot.collect(results);
    std::vector<Row> rows = frame_;
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i].sum = results.fluid_regions[i / groups_].groups[i % groups_];
    return rows;
}

FluidCellHistories::FluidCellHistories(const Model& model, const Record& record)
    : variables_(read_variables(record)), means_(record.integer("IAVER") == 1)
{
    const Id id = record.integer("SETID");
    const auto set = std::find_if(model.solid_sets.begin(), model.solid_sets.end(),
                                  [&](const ElementSet& candidate) { return candidate.id == id; });
    if (set == model.solid_sets.end())
        throw DeckError(record.where,
                        fmt::format("*DATABASE_ALE, field SETID: there is no solid set {}", id));
    for (const Index solid : set->elements) {
        if (is_eulerian(model, model.solids.part[solid])) {
            solids_.push_back(solid);
            continue;
        }
        throw DeckError(record.where, fmt::format("*DATABASE_ALE, field SETID: element {} of solid set {} is "
                                                  "no cell of an Eulerian mesh",
                                                  model.solids.id[solid], id));
    }
}

std::string_view FluidCellHistories::name_of(int variable)
{
    static constexpr std::string_view names[] = {"",
                                                 "sig_xx",
                                                 "sig_yy",
                                                 "sig_zz",
                                                 "sig_xy",
                                                 "sig_yz",
                                                 "sig_zx",
                                                 "plastic_strain",
                                                 "internal_energy",
                                                 "",
                                                 "",
                                                 "pressure",
                                                 "mass",
                                                 "volume",
                                                 "density",
                                                 "kinetic_energy"};
    return variable > 0 && variable < static_cast<int>(std::size(names)) ? names[variable]
                                                                         : std::string_view{};
}

std::vector<std::vector<double>> FluidCellHistories::values(const Snapshot& snapshot) const
{
    ElementResults results;
    results.solid_stress.resize(snapshot.model.solids.size());
    results.fluid_cells.resize(snapshot.model.solids.size());
    snapshot.collect(results);
    std::vector<std::vector<double>> rows;
    for (const Index solid : solids_) {
        const auto& s = results.solid_stress[solid];
        const ElementResults::FluidCellSum& cell = results.fluid_cells[solid];
        const double density = cell.volume > 0 ? cell.mass / cell.volume : 0;
        const double all[] = {0,         s.xx,        s.yy,          s.zz,        s.xy, s.yz,
                              s.zx,      0,           cell.internal, 0,           0,    cell.pressure,
                              cell.mass, cell.volume, density,       cell.kinetic};
        std::vector<double>& row = rows.emplace_back();
        for (const int variable : variables_) row.push_back(all[variable]);
    }
    return rows;
}

std::vector<double> FluidCellHistories::means_of(const std::vector<std::vector<double>>& values)
{
    std::vector<double> sums(values.empty() ? 0 : values.front().size());
    for (const auto& row : values)
        for (std::size_t v = 0; v < row.size(); ++v) sums[v] += row[v] / static_cast<double>(values.size());
    return sums;
}

AlematRecorder::AlematRecorder(const Model& model, const Record& record, const ResultPath& path)
    : ScheduledRecorder(schedule_of_output(record)), sums_(model, record), file_(path)
{
    file_.write(ascii_heading(model) + "\n Eulerian material groups\n");
}

void AlematRecorder::write_state(const Snapshot& snapshot)
{
    std::string text = "\n time =";
    append_scientific(text, snapshot.clock.time, 13, 5);
    text += "\n       box     group       volume         mass   x-momentum   y-momentum   z-momentum      "
            "kinetic     internal     lowest p    highest p\n";
    for (const FluidGroupSums::Row& row : sums_.rows(snapshot)) {
        text += fmt::format("{:10}{:10}", row.box, row.group);
        const ElementResults::FluidSum& sum = row.sum;
        for (const double value : {sum.volume, sum.mass, sum.momentum[0], sum.momentum[1], sum.momentum[2],
                                   sum.kinetic, sum.internal, sum.lowest_pressure, sum.highest_pressure})
            append_scientific(text, value, 13, 5);
        text += '\n';
    }
    file_.write(text);
    file_.flush();
}

DbaleRecorder::DbaleRecorder(const Model& model, const Record& record, const ResultPath& path)
    : ScheduledRecorder(schedule_of_output(record)), cells_(model, record), file_(path)
{
    file_.write(ascii_heading(model) + "\n Eulerian cells\n");
}

void DbaleRecorder::write_state(const Snapshot& snapshot)
{
    std::string text = "\n time =";
    append_scientific(text, snapshot.clock.time, 13, 5);
    text += "\n   element";
    for (const int variable : cells_.variables())
        text += fmt::format("{:>16}", FluidCellHistories::name_of(variable));
    text += '\n';
    const auto put = [&](const std::string& label, const std::vector<double>& values) {
        text += fmt::format("{:>10}", label);
        for (const double value : values) append_scientific(text, value, 16, 5);
        text += '\n';
    };
    const auto values = cells_.values(snapshot);
    for (std::size_t row = 0; row < values.size(); ++row)
        put(fmt::format("{}", snapshot.model.solids.id[cells_.solids()[row]]), values[row]);
    if (cells_.means()) put("average", FluidCellHistories::means_of(values));
    file_.write(text);
    file_.flush();
}

std::vector<std::unique_ptr<Recorder>> make_ale_recorders(const Model& model, const std::string& directory,
                                                          bool resume, ArrayRecorders arrays)
{
    std::vector<std::unique_ptr<Recorder>> recorders;
    int counts[2] = {0, 0};
    for (const Record& record : model.others) {
        const bool sums = record.keyword == "DATABASE_ALE_MAT";
        if ((!sums && record.keyword != "DATABASE_ALE") || !(record.real("DTOUT") > 0)) continue;
        const int count = ++counts[sums];
        std::string name = sums ? "alemat" : "dbale";
        if (count > 1) name += fmt::format("{}", count);
        const ResultPath path(directory + "/" + name, resume);
        if (sums)
            add_ale_recorder<AlematRecorder, AlematSection>(model, record, name, path, arrays, recorders);
        else
            add_ale_recorder<DbaleRecorder, DbaleSection>(model, record, name, path, arrays, recorders);
    }
    return recorders;
}

} // namespace plash
