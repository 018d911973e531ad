#include "output/binout_bodies.h"

#include "output/beam_files.h"
#include "output/binout_arrays.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Motion of rigid bodies, global and along their axes, and the rows of their directions.
class RbdoutSection final : public BinoutSection {
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        ElementResults results;
        results.rigid_motions_wanted = true;
        snapshot.collect(results);
        const auto& bodies = results.rigid_bodies;
        std::vector<Id> ids;
        for (const auto& body : bodies) ids.push_back(body.body);
        file.put("ids", ids);
        file.put_whole("num_nodal", std::count_if(bodies.begin(), bodies.end(),
                                                  [](const auto& body) { return body.nodal; }));
        file.put_whole("cycle", Id{snapshot.clock.cycle});
        using Motion = ElementResults::RigidMotion;
        const auto put = [&](const std::string& name, Vec3 Motion::*value, bool local) {
            std::vector<Vec3> values;
            for (const Motion& body : bodies) {
                const Vec3& v = body.*value;
                values.push_back(
                    local ? Vec3{dot(body.axes[0], v), dot(body.axes[1], v), dot(body.axes[2], v)} : v);
            }
            put_vectors(file, values, (name + "x").c_str(), (name + "y").c_str(), (name + "z").c_str());
        };
        put("global_", &Motion::place, false);
        for (const bool local : {false, true}) {
            const std::string system = local ? "local_" : "global_";
            put(system + "d", &Motion::displacement, local);
            put(system + "rd", &Motion::angle, local);
            put(system + "v", &Motion::velocity, local);
            put(system + "rv", &Motion::angular_velocity, local);
            put(system + "a", &Motion::acceleration, local);
            put(system + "ra", &Motion::angular_acceleration, local);
        }
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                std::vector<double> cosines;
                for (const Motion& body : bodies) cosines.push_back(body.axes[column].*vector_component[row]);
                file.put(fmt::format("dircos_{}{}", row + 1, column + 1), cosines);
            }
        }
    }
};

class JntforcSection final : public BinoutSection {
public:
    explicit JntforcSection(const Model& model) : model_(model) {}

private:
    const Model& model_;

    void write_metadata(ArrayFile& file) const override
    {
        std::vector<Id> ids;
        for (const Joint& joint : model_.joints) ids.push_back(joint.id);
        file.put("ids", ids);
        file.put("local", std::vector<Id>(ids.size()));
    }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        ElementResults results;
        results.rigid_motions_wanted = true;
        snapshot.collect(results);
        std::vector<Vec3> forces, moments;
        std::vector<double> force_sizes, moment_sizes, energies;
        for (const auto& joint : results.joints) {
            forces.push_back(joint.force);
            moments.push_back(joint.moment);
            force_sizes.push_back(norm(joint.force));
            moment_sizes.push_back(norm(joint.moment));
            energies.push_back(joint.energy);
        }
        put_vectors(file, forces, "x_force", "y_force", "z_force");
        put_vectors(file, moments, "x_moment", "y_moment", "z_moment");
        file.put("resultant_force", force_sizes);
        file.put("resultant_moment", moment_sizes);
        file.put("energy", energies);
    }
};

/// Spot welds; all are beams (type 2).
class SwforcSection final : public BinoutSection {
public:
    explicit SwforcSection(const Model& model)
        : model_(model), beams_(spot_weld_beams(model)), failed_since_(beams_.size(), -1)
    {}

private:
    const Model& model_;
    std::vector<Index> beams_;
    std::vector<double>
        failed_since_; ///< time at which a beam was first seen to have failed; below 0: it holds

    void write_metadata(ArrayFile& file) const override
    {
        std::vector<Id> ids;
        for (Index beam : beams_) ids.push_back(model_.beams.id[beam]);
        file.put("ids", ids);
        file.put("types", std::vector<Id>(ids.size(), 2));
    }
    void serialise(Archive& archive) override { archive(failed_since_); }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        ElementResults results;
        results.beams.resize(model_.beams.size());
        results.beam_deleted.resize(model_.beams.size());
        snapshot.collect(results);
        std::vector<double> axial, shear, length, moment, torsion, since;
        std::vector<Id> failed;
        for (std::size_t row = 0; row < beams_.size(); ++row) {
            const auto& beam = results.beams[beams_[row]];
            const bool gone = results.beam_deleted[beams_[row]] != 0;
            if (gone && failed_since_[row] < 0) failed_since_[row] = snapshot.clock.time;
            axial.push_back(beam.axial);
            shear.push_back(std::hypot(beam.shear_s, beam.shear_t));
            length.push_back(beam.length);
            moment.push_back(std::hypot(beam.moment_s, beam.moment_t));
            torsion.push_back(beam.torsion);
            failed.push_back(gone);
            since.push_back(std::max(0.0, failed_since_[row]));
        }
        file.put("axial", axial);
        file.put("shear", shear);
        file.put("failure_flag", failed);
        file.put("failure_time", since);
        file.put("length", length);
        file.put("resultant_moment", moment);
        file.put("torsion", torsion);
    }
};

} // namespace

std::unique_ptr<BinoutSection> make_body_section(const std::string& file_name, const Model& model)
{
    if (file_name == "rbdout") return std::make_unique<RbdoutSection>();
    if (file_name == "jntforc") return std::make_unique<JntforcSection>(model);
    if (file_name == "swforc") return std::make_unique<SwforcSection>(model);
    return nullptr;
}

void put_elout_beams(const Snapshot& snapshot, ArrayFile& file, const std::vector<Index>& beams,
                     const std::string& folder)
{
    constexpr int most = 64; // points of a cross section
    const Model& model = snapshot.model;
    ElementResults results;
    results.beam_rows.assign(model.beams.size(), none);
    for (std::size_t row = 0; row < beams.size(); ++row)
        results.beam_rows[beams[row]] = static_cast<Index>(row);
    results.beams.resize(beams.size());
    results.beam_deleted.resize(beams.size());
    results.beam_points = most;
    results.beam_stress.resize(beams.size() * most);
    snapshot.collect(results);
    std::vector<Id> ids, parts, points;
    std::vector<double> resultants[6], stresses[4];
    for (std::size_t row = 0; row < beams.size(); ++row) {
        if (results.beam_deleted[row]) continue;
        const auto& beam = results.beams[row];
        ids.push_back(model.beams.id[beams[row]]);
        parts.push_back(model.parts[model.beams.part[beams[row]]].id);
        points.push_back(std::min(beam.points, most));
        const double values[] = {beam.axial,    beam.shear_s,  beam.shear_t,
                                 beam.moment_s, beam.moment_t, beam.torsion};
        for (int i = 0; i < 6; ++i) resultants[i].push_back(values[i]);
        for (Id point = 0; point < points.back(); ++point) {
            const auto& stress = results.beam_stress[row * most + point];
            const double four[] = {stress.axial, stress.shear_rs, stress.shear_tr, stress.plastic_strain};
            for (int i = 0; i < 4; ++i) stresses[i].push_back(four[i]);
        }
    }
    if (ids.empty()) return;
    file.folder(folder);
    file.put_number("time", snapshot.clock.time);
    file.put_whole("cycle", Id{snapshot.clock.cycle + 1});
    file.put("ids", ids);
    file.put("mat", parts);
    file.put("nip", points);
    constexpr const char* names[] = {"axial", "shear_s", "shear_t", "moment_s", "moment_t", "torsion"};
    for (int i = 0; i < 6; ++i) file.put(names[i], resultants[i]);
    constexpr const char* point_names[] = {"sigma_11", "sigma_12", "sigma_31", "plastic_eps"};
    for (int i = 0; i < 4; ++i) file.put(point_names[i], stresses[i]);
}

} // namespace plash
