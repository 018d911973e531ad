#include "parser/transformation.h"

#include "parser/number.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

namespace plash {
namespace {

constexpr double radian = std::numbers::pi / 180;

/// Orthonormal frame of three points; nothing when they lie on one line.
std::optional<std::array<Vec3, 3>> frame_of(const std::array<Vec3, 3>& points)
{
    const Vec3 x = unit(points[1] - points[0]);
    const Vec3 z = unit(cross(x, points[2] - points[0]));
    if (norm(z) < 0.5) return std::nullopt;
    return std::array<Vec3, 3>{x, cross(z, x), z};
}

/// One *DEFINE_TRANSFORMATION while it is read: its POINTs and the product so far.
class TransformationReader {
public:
    TransformationReader(const Record& record, const std::function<std::optional<Vec3>(Id)>& node,
                         Report& report)
        : record_(record), node_(node), report_(report)
    {}

    Affine read()
    {
        const Table* table = record_.table("OPTION");
        for (std::size_t row = 0; table && row < table->rows(); ++row) {
            line_ = table->lines[row];
            for (std::size_t i = 0; i < 7; ++i) a_[i] = table->at(row, i + 1);
            const std::string& option = table->text.empty() ? "" : table->text[row * table->columns.size()];
            if (const std::optional<Affine> step = step_of(option)) product_ = then(product_, *step);
        }
        return product_;
    }

private:
    void error(std::string_view field, std::string text)
    {
        report_.error({record_.where.file, line_}, record_.keyword, field, std::move(text));
    }

    /// Numbers of points and nodes stand in real fields here: one that no whole number holds names nothing.
    static Id number_of(double value) { return std::abs(value) < largest_whole ? std::llround(value) : 0; }

    std::optional<Affine> step_of(const std::string& option)
    {
        const Vec3 first{a_[0], a_[1], a_[2]}, second{a_[3], a_[4], a_[5]};
        if (option == "POINT") {
            points_[number_of(a_[0])] = {a_[1], a_[2], a_[3]};
            return std::nullopt;
        }
        if (option == "SCALE") {
            const auto factor = [](double value) { return value == 0 ? 1 : value; };
            return scaling({factor(a_[0]), factor(a_[1]), factor(a_[2])});
        }
        if (option == "TRANSL") return translation(first);
        if (option == "TRANSL2ND") return translation_along_nodes();
        if (option == "ROTATE") return rotation_of(first, second);
        if (option == "MIRROR") {
            if (norm(second - first) > 0) return mirror(first, second - first);
            error("A4", "MIRROR needs two different points");
            return std::nullopt;
        }
        if (option == "POS6P" || option == "POS6N") return positioning_of(option == "POS6N");
        error("OPTION",
              fmt::format("'{}' is not supported; SCALE, TRANSL, TRANSL2ND, ROTATE, MIRROR, POINT, POS6P and "
                          "POS6N are",
                          option));
        return std::nullopt;
    }

    std::optional<Vec3> named_point(double number, bool nodes)
    {
        const Id id = number_of(number);
        if (!nodes)
            if (const auto found = points_.find(id); found != points_.end()) return found->second;
        if (nodes)
            if (const std::optional<Vec3> position = node_(id)) return position;
        error("A1", fmt::format("there is no {} {}", nodes ? "node" : "POINT", id));
        return std::nullopt;
    }

    std::optional<Affine> translation_along_nodes()
    {
        const auto from = named_point(a_[0], true), to = named_point(a_[1], true);
        if (!from || !to) return std::nullopt;
        return translation(a_[2] * unit(*to - *from));
    }

    /// Either axis, point and angle [degree], or two POINTs and the angle.
    std::optional<Affine> rotation_of(const Vec3& axis, const Vec3& through)
    {
        if (norm(through) == 0 && a_[6] == 0) {
            const auto from = named_point(a_[0], false), to = named_point(a_[1], false);
            if (!from || !to) return std::nullopt;
            return rotation(*to - *from, *from, radian * a_[2]);
        }
        if (norm(axis) > 0) return rotation(axis, through, radian * a_[6]);
        error("A1", "ROTATE needs an axis");
        return std::nullopt;
    }

    std::optional<Affine> positioning_of(bool nodes)
    {
        std::array<Vec3, 3> from, to;
        for (int i = 0; i < 3; ++i) {
            const auto start = named_point(a_[i], nodes), target = named_point(a_[i + 3], nodes);
            if (!start || !target) return std::nullopt;
            from[i] = *start;
            to[i] = *target;
        }
        const std::optional<Affine> result = positioning(from, to);
        if (!result) error("A1", "three points of a position lie on one line");
        return result;
    }

    const Record& record_;
    const std::function<std::optional<Vec3>(Id)>& node_;
    Report& report_;
    std::map<Id, Vec3> points_;
    std::array<double, 7> a_{};
    int line_ = 0;
    Affine product_;
};

} // namespace

bool Affine::is_identity() const
{
    const Affine identity;
    double difference = norm(shift);
    for (int i = 0; i < 3; ++i) difference += norm(columns[i] - identity.columns[i]);
    return difference == 0;
}

Affine then(const Affine& first, const Affine& second)
{
    Affine result;
    for (int i = 0; i < 3; ++i) result.columns[i] = second.direction(first.columns[i]);
    result.shift = second.point(first.shift);
    return result;
}

Affine scaling(const Vec3& factors)
{
    return {{Vec3{factors.x, 0, 0}, Vec3{0, factors.y, 0}, Vec3{0, 0, factors.z}}, {}};
}

Affine translation(const Vec3& by)
{
    Affine result;
    result.shift = by;
    return result;
}

Affine rotation(const Vec3& axis, const Vec3& through, double angle)
{
    const Vec3 u = unit(axis);
    const double c = std::cos(angle), s = std::sin(angle);
    Affine result;
    for (Vec3& column : result.columns)
        column = c * column + s * cross(u, column) + (1 - c) * dot(u, column) * u;
    result.shift = through - result.direction(through);
    return result;
}

Affine mirror(const Vec3& through, const Vec3& normal)
{
    const Vec3 n = unit(normal);
    Affine result;
    for (Vec3& column : result.columns) column -= 2 * dot(n, column) * n;
    result.shift = 2 * dot(n, through) * n;
    return result;
}

std::optional<Affine> positioning(const std::array<Vec3, 3>& from, const std::array<Vec3, 3>& to)
{
    const auto old_frame = frame_of(from), new_frame = frame_of(to);
    if (!old_frame || !new_frame) return std::nullopt;
    Affine result;
    for (Vec3& column : result.columns) {
        const Vec3 axis = column;
        column = {};
        for (int i = 0; i < 3; ++i) column += dot((*old_frame)[i], axis) * (*new_frame)[i];
    }
    result.shift = to[0] - result.direction(from[0]);
    return result;
}

Affine transformation_of(const Record& record, const std::function<std::optional<Vec3>(Id)>& node,
                         Report& report)
{
    return TransformationReader(record, node, report).read();
}

} // namespace plash
