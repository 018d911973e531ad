#include "output/binout_discrete.h"

#include "output/binout_arrays.h"
#include "output/deforc.h"
#include "output/disbout.h"
#include "output/nodfor.h"
#include "output/trhist.h"

namespace plash {

namespace {

class DeforcSection final : public BinoutSection {
public:
    explicit DeforcSection(const Model& model) : model_(model), springs_(shown_springs(model)) {}

private:
    const Model& model_;
    std::vector<Index> springs_;

    void write_metadata(ArrayFile& file) const override
    {
        std::vector<Id> ids, torsional;
        for (Index spring : springs_) {
            ids.push_back(model_.discretes.id[spring]);
            const Index section = model_.parts[model_.discretes.part[spring]].section;
            torsional.push_back(section != none && model_.sections[section].integer("DRO") == 1);
        }
        file.put("ids", ids);
        file.put("irot", torsional);
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        std::vector<Vec3> forces;
        std::vector<double> sizes, ways;
        for (const auto& spring : spring_states(snapshot, springs_)) {
            forces.push_back(spring.force);
            sizes.push_back(spring.magnitude);
            ways.push_back(spring.deflection);
        }
        file.put_whole("cycle", Id{snapshot.clock.cycle + 1});
        put_vectors(file, forces, "x_force", "y_force", "z_force");
        file.put("resultant_force", sizes);
        file.put("displacement", ways);
    }
};

class DisboutSection final : public BinoutSection {
public:
    explicit DisboutSection(const Model& model) : beams_(shown_discrete_beams(model)) {}

private:
    std::vector<Index> beams_;

    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        const Model& model = snapshot.model;
        const auto states = discrete_beam_states(snapshot, beams_);
        std::vector<Id> ids, parts, types;
        std::vector<Vec3> axes[3];
        for (const auto& state : states) {
            ids.push_back(model.beams.id[state.beam]);
            parts.push_back(model.parts[model.beams.part[state.beam]].id);
            types.push_back(discrete_material_type(model, state.beam));
            for (int axis = 0; axis < 3; ++axis) axes[axis].push_back(state.axes[axis]);
        }
        file.put_whole("cycle", Id{snapshot.clock.cycle + 1});
        file.put("nelb", ids);
        file.put("matid", parts);
        file.put("mtype", types);
        constexpr const char* ways[] = {"r_dis_axial", "r_dis_ns", "r_dis_nt", "axial_rot", "rot_s", "rot_t"};
        constexpr const char* forces[] = {"rslt_axial", "rslt_ns",  "rslt_nt",
                                          "torsion",    "moment_s", "moment_t"};
        for (int i = 0; i < 6; ++i) {
            std::vector<double> way, force;
            for (const auto& state : states) {
                way.push_back(state.way[i]);
                force.push_back(state.resultant[i]);
            }
            file.put(ways[i], way);
            file.put(forces[i], force);
        }
        put_vectors(file, axes[0], "axial_x", "axial_y", "axial_z");
        put_vectors(file, axes[1], "s_dir_x", "s_dir_y", "s_dir_z");
        put_vectors(file, axes[2], "t_dir_x", "t_dir_y", "t_dir_z");
    }
};

class NodforSection final : public BinoutSection {
public:
    explicit NodforSection(const Model& model) : model_(model) {}

private:
    const Model& model_;

    void write_metadata(ArrayFile& file) const override
    {
        std::vector<Id> ids, groups, local;
        for (const NodalForceGroup& group : model_.nodal_force_groups) {
            for (Index node : group.nodes) ids.push_back(model_.nodes.id[node]);
            groups.push_back(static_cast<Id>(group.nodes.size()));
            local.push_back(group.system == none ? 0 : 1);
        }
        file.put("ids", ids);
        file.put("groups", groups);
        file.put("local", local);
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        std::vector<Vec3> forces, sums, local_sums;
        std::vector<double> energies, totals;
        for (const NodalForceRows& row : nodal_force_rows(snapshot)) {
            for (const auto& node : row.nodes) {
                forces.push_back(node.force);
                energies.push_back(node.energy);
            }
            sums.push_back(row.sum);
            totals.push_back(row.energy);
            if (row.group->system != none) local_sums.push_back(row.local_sum);
        }
        put_vectors(file, forces, "x_force", "y_force", "z_force");
        file.put("energy", energies);
        put_vectors(file, sums, "x_total", "y_total", "z_total");
        file.put("etotal", totals);
        if (!local_sums.empty()) put_vectors(file, local_sums, "x_local", "y_local", "z_local");
    }
};

} // namespace

std::unique_ptr<BinoutSection> make_discrete_section(const std::string& file_name, const Model& model)
{
    if (file_name == "deforc") return std::make_unique<DeforcSection>(model);
    if (file_name == "disbout") return std::make_unique<DisboutSection>(model);
    if (file_name == "nodfor") return std::make_unique<NodforSection>(model);
    if (file_name == "trhist") return make_trhist_section();
    return nullptr;
}

} // namespace plash
