#include "materials/rubber.h"

#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace plash {

namespace {

/// Density, bulk modulus and the lines GI BETAI of the Prony series; the energy is there already.
template <class Law>
void read_common(const Record& record, Law& rubber)
{
    rubber.density = positive(record, "RO", "mass density");
    rubber.poisson_ratio = poisson_ratio_of(record);
    if (rubber.poisson_ratio <= 0) {
        reject_field(record, "PR",
                     fmt::format("{} is not positive (rubber with a table of hysteresis is not "
                                 "supported)",
                                 rubber.poisson_ratio));
    }
    if (record.real("REF") != 0) {
        reject_field(record, "REF", "a reference geometry is not supported; leave the field at 0");
    }
    const double shear = rubber.energy.shear_modulus(), nu = rubber.poisson_ratio;
    rubber.bulk_modulus = 2 * shear * (1 + nu) / (3 * (1 - 2 * nu));
    record.integer("NV"); // the number of terms when the code fits them itself
    const Table* series = record.table("GI");
    if (!series) return;
    int count = 0;
    for (std::size_t row = 0; row < series->rows(); ++row) {
        const double modulus = series->at(row, 0), decay = series->at(row, 1);
        for (std::size_t column = 2; column < series->columns.size(); ++column) {
            if (series->at(row, column) == 0) continue;
            throw DeckError({record.where.file, series->lines[row]},
                            fmt::format("*{}, field {}: {} is not supported; leave it at 0", record.keyword,
                                        series->columns[column], series->at(row, column)));
        }
        if (modulus == 0) continue;
        const auto refuse = [&](const char* what) {
            throw DeckError(
                {record.where.file, series->lines[row]},
                fmt::format("*{}, fields GI and BETAI: {} and {}: {}", record.keyword, modulus, decay, what));
        };
        if (modulus < 0) refuse("a negative modulus");
        if (decay < 0) refuse("a negative decay");
        if (count == most_rubber_branches) refuse("more than 6 terms of the Prony series are not supported");
        rubber.series[count++] = {modulus, decay};
    }
}

/// Nominal stress of an incompressible test over the stretch by the two invariants: how dI/ds and dII/ds go
/// into it.
struct TestSlopes {
    double first, second; ///< dI/ds, dII/ds (halved where two directions share the force)
    double one, two;      ///< I - 3, II - 3
};

TestSlopes test_slopes(int kind, double s)
{
    const double s2 = s * s;
    if (kind == 1) return {2 * (s - 1 / s2), 2 * (1 - 1 / (s2 * s)), s2 + 2 / s - 3, 2 * s + 1 / s2 - 3};
    if (kind == 2) { // equibiaxial
        const double s4 = s2 * s2;
        return {2 * (s - 1 / (s4 * s)), 2 * (s2 * s - 1 / (s2 * s)), 2 * s2 + 1 / s4 - 3, s4 + 2 / s2 - 3};
    }
    const double both = 2 * (s - 1 / (s2 * s)), invariant = s2 + 1 + 1 / s2 - 3; // pure shear
    return {both, both, invariant, invariant};
}

double product(const std::vector<double>& a, const std::vector<double>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// Factors of the columns whose sum comes closest to `target`, by the modified Gram-Schmidt method (Golub &
/// Van Loan 1996, 5.2.8); nothing when the columns depend on one another.
std::optional<std::vector<double>> least_squares(std::vector<std::vector<double>> columns,
                                                 std::vector<double> target)
{
    const std::size_t count = columns.size();
    std::vector<std::vector<double>> upper(count, std::vector<double>(count));
    std::vector<double> factors(count);
    for (std::size_t j = 0; j < count; ++j) {
        const double whole = std::sqrt(product(columns[j], columns[j]));
        for (std::size_t k = 0; k < j; ++k) {
            upper[k][j] = product(columns[k], columns[j]);
            for (std::size_t i = 0; i < target.size(); ++i) columns[j][i] -= upper[k][j] * columns[k][i];
        }
        upper[j][j] = std::sqrt(product(columns[j], columns[j]));
        if (!(upper[j][j] > 1e-9 * whole)) return {};
        for (double& value : columns[j]) value /= upper[j][j];
        factors[j] = product(columns[j], target);
        for (std::size_t i = 0; i < target.size(); ++i) target[i] -= factors[j] * columns[j][i];
    }
    for (std::size_t j = count; j-- > 0;) {
        for (std::size_t k = j + 1; k < count; ++k) factors[j] -= upper[j][k] * factors[k];
        factors[j] /= upper[j][j];
    }
    return factors;
}

/// The first N of C10, C01, C11, C20, C02, C30 that fit a test best (linear least squares).
PolynomialEnergy fitted(const Record& record, const Model& model, Id count)
{
    const double gauge = positive(record, "SGL", "gauge length of the test");
    const double area =
        positive(record, "SW", "width of the specimen") * positive(record, "ST", "its thickness");
    const auto kind = static_cast<int>(value_or(record.real("DATA"), 1));
    if (kind < 1 || kind > 3) {
        reject_field(record, "DATA",
                     fmt::format("{} is no kind of test (1: uniaxial, 2: biaxial, 3: pure shear)", kind));
    }
    if (count > 6)
        reject_field(record, "N", fmt::format("{} constants are more than the law has (6)", count));
    for (const char* field : {"LCID2", "BSTART", "TRAMP"}) {
        if (record.real(field) != 0) reject_field(record, field, "relaxation data are not supported");
    }
    const Curve& test = curve_of(record, "LCID1", model).curve;
    const std::size_t points = test.abscissa.size();
    std::vector<std::vector<double>> parts(count, std::vector<double>(points));
    std::vector<double> stress(points);
    for (std::size_t i = 0; i < points; ++i) {
        const double stretch = 1 + test.abscissa[i] / gauge;
        if (!(stretch > 0)) reject_field(record, "LCID1", "the test shortens its gauge length to nothing");
        const TestSlopes at = test_slopes(kind, stretch);
        const double all[6] = {at.first,
                               at.second,
                               at.first * at.two + at.second * at.one,
                               2 * at.one * at.first,
                               2 * at.two * at.second,
                               3 * at.one * at.one * at.first};
        for (Id j = 0; j < count; ++j) parts[j][i] = all[j];
        stress[i] = test.ordinate[i] / area;
    }
    const auto c = least_squares(std::move(parts), std::move(stress));
    if (!c) reject_field(record, "LCID1", fmt::format("the test does not determine {} constants", count));
    double all[6] = {};
    std::copy(c->begin(), c->end(), all);
    return {all[0], all[1], all[2], all[3], all[4], all[5]};
}

} // namespace

Rubber<OgdenEnergy, most_rubber_branches> ogden_rubber(const Record& record)
{
    Rubber<OgdenEnergy, most_rubber_branches> rubber;
    if (record.integer("N") != 0) {
        reject_field(record, "N",
                     "fitting the constants to a test is not supported; give MU and ALPHA (N = 0)");
    }
    for (int i = 1; i <= OgdenEnergy::most_terms; ++i) {
        const double mu = record.real(fmt::format("MU{}", i)), alpha = record.real(fmt::format("ALPHA{}", i));
        if (mu == 0 || alpha == 0) continue; // such a term stores nothing
        rubber.energy.mu[rubber.energy.terms] = mu;
        rubber.energy.alpha[rubber.energy.terms++] = alpha;
    }
    if (!(rubber.energy.shear_modulus() > 0)) {
        reject_field(record, "MU1",
                     fmt::format("half the sum of MU ALPHA = {} is no positive shear modulus",
                                 rubber.energy.shear_modulus()));
    }
    read_common(record, rubber);
    return rubber;
}

Rubber<PolynomialEnergy, most_rubber_branches> polynomial_rubber(const Record& record, const Model& model)
{
    Rubber<PolynomialEnergy, most_rubber_branches> rubber;
    const Id count = record.integer("N");
    if (count > 0) {
        rubber.energy = fitted(record, model, count);
    } else {
        rubber.energy = {record.real("C10"), record.real("C01"), record.real("C11"),
                         record.real("C20"), record.real("C02"), record.real("C30")};
        if (record.real("THERML") != 0) reject_field(record, "THERML", "thermal options are not supported");
    }
    if (!(rubber.energy.shear_modulus() > 0)) {
        reject_field(
            record, count > 0 ? "LCID1" : "C10",
            fmt::format("2 (C10 + C01) = {} is no positive shear modulus", rubber.energy.shear_modulus()));
    }
    read_common(record, rubber);
    return rubber;
}

} // namespace plash
