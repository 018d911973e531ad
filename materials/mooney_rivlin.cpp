#include "materials/mooney_rivlin.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// A and B that fit nominal stress = 2 (s - s^-2) (A + B / s) over the stretch s best.
void fit_tension_test(const Record& record, const Curve& test, MooneyRivlin& rubber)
{
    const double gauge = positive(record, "SGL", "gauge length of the tension test");
    const double area =
        positive(record, "SW", "width of the specimen") * positive(record, "ST", "its thickness");
    double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0;
    for (std::size_t i = 0; i < test.abscissa.size(); ++i) {
        const double stretch = 1 + test.abscissa[i] / gauge, stress = test.ordinate[i] / area;
        if (!(stretch > 0)) {
            reject_field(record, "LCID",
                         fmt::format("the tension test shortens its gauge length of {} by {}", gauge,
                                     -test.abscissa[i]));
        }
        const double first = 2 * (stretch - 1 / (stretch * stretch)), second = first / stretch;
        aa += first * first;
        ab += first * second;
        bb += second * second;
        ra += first * stress;
        rb += second * stress;
    }
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-12 * aa * bb)) {
        reject_field(record, "LCID", "the tension test needs at least two different stretches besides 1");
    }
    rubber.a = (ra * bb - rb * ab) / determinant;
    rubber.b = (rb * aa - ra * ab) / determinant;
}

} // namespace

MooneyRivlin MooneyRivlin::from_record(const Record& record, const Model& model)
{
    MooneyRivlin rubber;
    rubber.density = positive(record, "RO", "mass density");
    rubber.poisson_ratio = poisson_ratio_of(record);
    rubber.a = record.real("A");
    rubber.b = record.real("B");
    if (record.real("REF") != 0) {
        reject_field(record, "REF", "a reference geometry is not supported; leave the field at 0");
    }
    if (record.integer("LCID") != 0) {
        if (rubber.a != 0 || rubber.b != 0) {
            reject_field(record, "LCID",
                         "the curve of a tension test is given besides A and B; leave one of them out");
        }
        fit_tension_test(record, curve_of(record, "LCID", model).curve, rubber);
    }
    if (!(rubber.shear_modulus() > 0)) {
        reject_field(record, "A", fmt::format("A + B = {} is no positive stiffness", rubber.a + rubber.b));
    }
    return rubber;
}

} // namespace plash
