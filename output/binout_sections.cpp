#include "output/binout.h"

#include "output/abstat.h"
#include "output/binout_arrays.h"
#include "output/binout_bodies.h"
#include "output/binout_discrete.h"
#include "output/bndout.h"
#include "output/glstat.h"
#include "output/matsum.h"
#include "output/nodal_motion.h"
#include "output/nodout.h"
#include "output/secforc.h"
#include "output/spcforc.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

using Numbers = std::vector<Id>;

/// Numbers with titles of 80 characters each.
void put_legend(ArrayFile& file, const Numbers& ids, const std::vector<std::string>& titles)
{
    std::string text;
    for (const std::string& title : titles) text += fmt::format("{:<80.80}", title);
    file.put("legend_ids", ids);
    file.put("legend", std::string_view(text));
}

class GlstatSection final : public BinoutSection {
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        const GlobalStatistics s = global_statistics(snapshot);
        file.put_whole("cycle", Id{s.cycle});
        const std::pair<const char*, double> values[] = {
            {"time_step", s.step},
            {"kinetic_energy", s.kinetic},
            {"internal_energy", s.internal},
            {"spring_and_damper_energy", s.spring_and_damper},
            {"hourglass_energy", s.hourglass},
            {"system_damping_energy", s.damping},
            {"sliding_interface_energy", s.sliding},
            {"external_work", s.external_work},
            {"eroded_kinetic_energy", s.eroded_kinetic},
            {"eroded_internal_energy", s.eroded_internal},
            {"eroded_hourglass_energy", s.eroded_hourglass},
            {"advection_loss", s.advection_loss},
            {"total_energy", s.total},
            {"energy_ratio", s.energy_ratio},
            {"energy_ratio_wo_eroded", s.energy_ratio_without_eroded},
            {"global_x_velocity", s.velocity.x},
            {"global_y_velocity", s.velocity.y},
            {"global_z_velocity", s.velocity.z},
        };
        for (const auto& [name, value] : values) file.put_number(name, value);
        double stonewall = 0;
        for (double wall : s.stonewall) stonewall += wall;
        file.put_number("stonewall_energy", stonewall);
    }
};

class MatsumSection final : public BinoutSection {
public:
    explicit MatsumSection(const Model& model) : model_(model) {}

private:
    const Model& model_;

    void write_metadata(ArrayFile& file) const override
    {
        Numbers ids;
        std::vector<std::string> titles;
        for (const Part& part : model_.parts) {
            ids.push_back(part.id);
            titles.push_back(part.title);
        }
        file.put("ids", ids);
        put_legend(file, ids, titles);
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        const std::vector<PartStatistics> parts = part_statistics(snapshot);
        const auto put = [&](const char* name, double PartStatistics::*value) {
            std::vector<double> column;
            for (const PartStatistics& part : parts) column.push_back(part.*value);
            file.put(name, column);
        };
        put("internal_energy", &PartStatistics::internal);
        put("kinetic_energy", &PartStatistics::kinetic);
        put("eroded_internal_energy", &PartStatistics::eroded_internal);
        put("eroded_kinetic_energy", &PartStatistics::eroded_kinetic);
        put("hourglass_energy", &PartStatistics::hourglass);
        put("mass", &PartStatistics::mass);
        std::vector<Vec3> momenta, velocities;
        for (const PartStatistics& part : parts) {
            momenta.push_back(part.momentum);
            velocities.push_back(part.rigid_body_velocity);
        }
        put_vectors(file, momenta, "x_momentum", "y_momentum", "z_momentum");
        put_vectors(file, velocities, "x_rbvelocity", "y_rbvelocity", "z_rbvelocity");
    }
};

class NodoutSection final : public BinoutSection {
public:
    explicit NodoutSection(const Model& model)
        : model_(model), nodes_(model.controls.output.history_nodes), rotation_(nodes_.size())
    {}

private:
    const Model& model_;
    std::vector<Index> nodes_;
    std::vector<Vec3> rotation_; ///< angles since the start

    void write_metadata(ArrayFile& file) const override
    {
        Numbers ids;
        for (Index node : nodes_) ids.push_back(model_.nodes.id[node]);
        file.put("ids", ids);
    }
    void follow(const Clock& clock, const State& state) override
    {
        if (!state.rotational()) return;
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            rotation_[i] += clock.step * state.angular_velocity[nodes_[i]];
    }
    void serialise(Archive& archive) override { archive(rotation_); }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        const bool rotations = snapshot.state.rotational();
        const NodalMotion motion(snapshot, rotations);
        file.put_whole("cycle", Id{snapshot.clock.cycle + 1});
        const auto each = [&](auto&& value) {
            std::vector<Vec3> values;
            for (Index node : nodes_) values.push_back(value(node));
            return values;
        };
        put_vectors(file, each([&](Index n) { return motion.displacement(n); }), "x_displacement",
                    "y_displacement", "z_displacement");
        put_vectors(file, each([&](Index n) { return motion.velocity(n); }), "x_velocity", "y_velocity",
                    "z_velocity");
        put_vectors(file, each([&](Index n) { return motion.acceleration(n); }), "x_acceleration",
                    "y_acceleration", "z_acceleration");
        put_vectors(file, each([&](Index n) { return motion.position(n); }), "x_coordinate", "y_coordinate",
                    "z_coordinate");
        if (!rotations) return;
        put_vectors(file, rotation_, "rx_displacement", "ry_displacement", "rz_displacement");
        put_vectors(file, each([&](Index n) { return motion.angular_velocity(n); }), "rx_velocity",
                    "ry_velocity", "rz_velocity");
        put_vectors(file, each([&](Index n) { return motion.angular_acceleration(n); }), "rx_acceleration",
                    "ry_acceleration", "rz_acceleration");
    }
};

class RwforcSection final : public BinoutSection {
public:
    explicit RwforcSection(const Model& model) : model_(model) {}

private:
    const Model& model_;

    void write_metadata(ArrayFile& file) const override
    {
        Numbers ids;
        std::vector<std::string> titles;
        for (const RigidWall& wall : model_.rigid_walls) {
            ids.push_back(wall.id);
            titles.push_back(wall.title);
        }
        file.put("ids", ids);
        put_legend(file, ids, titles);
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        ElementResults results;
        snapshot.collect(results);
        std::vector<double> normal;
        std::vector<Vec3> forces;
        for (const auto& wall : results.walls) {
            normal.push_back(wall.normal);
            forces.push_back(wall.force);
        }
        file.put("normal_force", normal);
        put_vectors(file, forces, "x_force", "y_force", "z_force");
    }
};

/// Both sides of every contact, one behind the other.
class RcforcSection final : public BinoutSection {
public:
    explicit RcforcSection(const Model& model) : model_(model) {}

private:
    const Model& model_;

    void write_metadata(ArrayFile& file) const override
    {
        Numbers ids, sides, contacts;
        std::vector<std::string> titles;
        for (const Contact& contact : model_.contacts) {
            for (Id side : {0, 1}) {
                ids.push_back(contact.id);
                sides.push_back(side);
            }
            contacts.push_back(contact.id);
            titles.push_back(contact.title);
        }
        file.put("ids", ids);
        file.put("side", sides);
        put_legend(file, contacts, titles);
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        ElementResults results;
        snapshot.collect(results);
        std::vector<double> mass;
        std::vector<Vec3> forces, moments;
        for (const auto& contact : results.contacts) {
            mass.insert(mass.end(), {contact.slave_mass, contact.master_mass});
            forces.insert(forces.end(), {contact.slave_force, contact.master_force});
            moments.insert(moments.end(), {contact.slave_moment, contact.master_moment});
        }
        put_vectors(file, forces, "x_force", "y_force", "z_force");
        put_vectors(file, moments, "x_moment", "y_moment", "z_moment");
        file.put("mass", mass);
    }
};

class SleoutSection final : public BinoutSection {
public:
    explicit SleoutSection(const Model& model) : model_(model) {}

private:
    const Model& model_;

    void write_metadata(ArrayFile& file) const override
    {
        Numbers ids;
        for (const Contact& contact : model_.contacts) ids.push_back(contact.id);
        file.put("ids", ids);
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        ElementResults results;
        snapshot.collect(results);
        std::vector<double> slave, master, friction;
        double slaves = 0, masters = 0, frictions = 0;
        for (const auto& contact : results.contacts) {
            slaves += slave.emplace_back(contact.slave_energy);
            masters += master.emplace_back(contact.master_energy);
            frictions += friction.emplace_back(contact.friction_energy);
        }
        file.put_whole("cycle", Id{snapshot.clock.cycle + 1});
        file.put("slave", slave);
        file.put("master", master);
        file.put("frictional_energy", friction);
        file.put_number("total_slave", slaves);
        file.put_number("total_master", masters);
        file.put_number("total_energy", slaves + masters);
        file.put_number("total_friction", frictions);
    }
};

class SpcforcSection final : public BinoutSection {
public:
    explicit SpcforcSection(const Model& model) : table_(model) {}

private:
    SupportTable table_;

    void write_metadata(ArrayFile& file) const override
    {
        Numbers ids;
        for (const SupportRow& row : table_.rows()) ids.push_back(row.node);
        file.put("ids", ids);
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        std::vector<Vec3> forces, moments;
        Vec3 sum{};
        for (const SupportRow& row : table_.filled(snapshot)) {
            forces.push_back(row.force);
            moments.push_back(row.moment);
            sum += row.force;
        }
        put_vectors(file, forces, "x_force", "y_force", "z_force");
        put_vectors(file, moments, "x_moment", "y_moment", "z_moment");
        file.put_number("x_total", sum.x);
        file.put_number("y_total", sum.y);
        file.put_number("z_total", sum.z);
    }
};

/// Loads under "discrete", driven nodes and parts under "velocity", as LS-DYNA has them.
class BndoutSection final : public BinoutSection {
    bool has_folders() const override { return true; }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string& folder) override
    {
        ElementResults results;
        results.boundary_forces_wanted = true;
        snapshot.collect(results);
        const std::size_t state = folder.rfind('/');
        const std::string number = folder.substr(state), root = folder.substr(0, state);
        put_rows(snapshot, file, boundary_rows(results.loads, snapshot.model),
                 root + "/discrete/nodes" + number);
        std::vector<BoundaryRow> nodes, parts;
        for (const BoundaryRow& row : boundary_rows(results.motions, snapshot.model))
            (row.rigid_part ? parts : nodes).push_back(row);
        put_rows(snapshot, file, nodes, root + "/velocity/nodes" + number);
        put_rows(snapshot, file, parts, root + "/velocity/rigidbodies" + number);
    }
    static void put_rows(const Snapshot& snapshot, ArrayFile& file, const std::vector<BoundaryRow>& rows,
                         const std::string& folder)
    {
        if (rows.empty()) return;
        file.folder(folder);
        Numbers ids;
        std::vector<Vec3> forces, moments;
        std::vector<double> energies;
        Vec3 sum{};
        double energy = 0;
        for (const BoundaryRow& row : rows) {
            ids.push_back(row.id);
            forces.push_back(row.force);
            moments.push_back(row.moment);
            energies.push_back(row.energy);
            sum += row.force;
            energy += row.energy;
        }
        file.put_number("time", snapshot.clock.time);
        file.put("ids", ids);
        put_vectors(file, forces, "x_force", "y_force", "z_force");
        if (rows.front().rigid_part) put_vectors(file, moments, "x_moment", "y_moment", "z_moment");
        file.put("energy", energies);
        file.put_number("x_total", sum.x);
        file.put_number("y_total", sum.y);
        file.put_number("z_total", sum.z);
        file.put_number("etotal", energy);
    }
};

/// Solids under elout/solid, shells under elout/shell, beams under elout/beam, their points from bottom to
/// top.
class EloutSection final : public BinoutSection {
public:
    explicit EloutSection(const Model& model) : histories_(model), beams_(model.controls.output.history_beams)
    {
        std::sort(beams_.begin(), beams_.end());
        beams_.erase(std::unique(beams_.begin(), beams_.end()), beams_.end());
    }

private:
    ElementHistories histories_;
    std::vector<Index> beams_;

    bool has_folders() const override { return true; }

    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string& folder) override
    {
        const std::size_t state = folder.rfind('/');
        const std::string number = folder.substr(state), root = folder.substr(0, state);
        const ElementHistories::Lists lists = histories_.collect(snapshot);
        put_elements(snapshot, file, lists.solids, root + "/solid" + number);
        put_elements(snapshot, file, lists.shells, root + "/shell" + number);
        if (!beams_.empty()) put_elout_beams(snapshot, file, beams_, root + "/beam" + number);
        put_elements(snapshot, file, lists.thick_shells, root + "/thickshell" + number);
    }
    static void put_elements(const Snapshot& snapshot, ArrayFile& file,
                             const std::vector<ElementHistory>& elements, const std::string& folder)
    {
        if (elements.empty()) return;
        file.folder(folder);
        file.put_number("time", snapshot.clock.time);
        file.put_whole("cycle", Id{snapshot.clock.cycle + 1});
        Numbers ids, parts, points;
        std::vector<double> strain;
        for (const ElementHistory& element : elements) {
            ids.push_back(element.id);
            parts.push_back(element.part);
            points.push_back(static_cast<Id>(element.points.size()));
            for (const PointStress& point : element.points) strain.push_back(point.plastic_strain);
        }
        file.put("ids", ids);
        file.put("mat", parts);
        file.put("nip", points);
        using Stress = SymmetricTensor<double>;
        const std::pair<const char*, double Stress::*> components[] = {
            {"sig_xx", &Stress::xx}, {"sig_yy", &Stress::yy}, {"sig_zz", &Stress::zz},
            {"sig_xy", &Stress::xy}, {"sig_yz", &Stress::yz}, {"sig_zx", &Stress::zx}};
        for (const auto& [name, component] : components) {
            std::vector<double> column;
            for (const ElementHistory& element : elements) {
                for (const PointStress& point : element.points) column.push_back(point.stress.*component);
            }
            file.put(name, column);
        }
        file.put("plastic_strain", strain);
        const std::size_t tensors = elements[0].strains.size();
        for (std::size_t side = 0; side < tensors; ++side) {
            const char* prefix = tensors == 1 ? "eps" : side == 0 ? "lower_eps" : "upper_eps";
            for (const auto& [name, component] : components) {
                std::vector<double> column;
                for (const ElementHistory& element : elements)
                    column.push_back(element.strains[side].*component);
                file.put(prefix + std::string(name).substr(3), column);
            }
        }
    }
};

class SecforcSection final : public BinoutSection {
public:
    explicit SecforcSection(const Model& model) : model_(model) {}

private:
    const Model& model_;

    void write_metadata(ArrayFile& file) const override
    {
        Numbers ids;
        std::vector<std::string> titles;
        for (const CrossSection& section : model_.cross_sections) {
            ids.push_back(section.id);
            titles.push_back(section.title);
        }
        file.put("ids", ids);
        put_legend(file, ids, titles);
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        std::vector<Vec3> forces, moments, centroids;
        std::vector<double> sizes, moment_sizes, areas;
        for (const SectionRow& row : section_rows(snapshot)) {
            forces.push_back(row.force);
            moments.push_back(row.moment);
            centroids.push_back(row.centroid);
            sizes.push_back(norm(row.force));
            moment_sizes.push_back(norm(row.moment));
            areas.push_back(row.area);
        }
        put_vectors(file, forces, "x_force", "y_force", "z_force");
        put_vectors(file, moments, "x_moment", "y_moment", "z_moment");
        put_vectors(file, centroids, "x_centroid", "y_centroid", "z_centroid");
        file.put("total_force", sizes);
        file.put("total_moment", moment_sizes);
        file.put("area", areas);
    }
};

} // namespace

std::unique_ptr<BinoutSection> make_binout_section(const std::string& file_name, const Model& model)
{
    if (file_name == "glstat") return std::make_unique<GlstatSection>();
    if (file_name == "matsum") return std::make_unique<MatsumSection>(model);
    if (file_name == "nodout") return std::make_unique<NodoutSection>(model);
    if (file_name == "elout") return std::make_unique<EloutSection>(model);
    if (file_name == "rwforc") return std::make_unique<RwforcSection>(model);
    if (file_name == "rcforc") return std::make_unique<RcforcSection>(model);
    if (file_name == "sleout") return std::make_unique<SleoutSection>(model);
    if (file_name == "spcforc") return std::make_unique<SpcforcSection>(model);
    if (file_name == "secforc") return std::make_unique<SecforcSection>(model);
    if (file_name == "abstat") return make_abstat_section(model);
    if (file_name == "bndout") return std::make_unique<BndoutSection>();
    if (auto section = make_body_section(file_name, model)) return section;
    return make_discrete_section(file_name, model);
}

std::string binout_folder(const std::string& file_name)
{
    if (file_name == "rwforc") return "rwforc/forces";
    return file_name == "jntforc" ? "jntforc/joints" : file_name;
}

} // namespace plash
