#pragma once

#include "contact/facing_test.h"
#include "contact/penalty_law.h"
#include "contact/segment_overlap.h"
#include "core/archive.h"

#include <span>

namespace plash {

/// Two segments that press on one another, with what they remember from cycle to cycle.
struct FacingTouch {
    Index first = none, second = none; ///< facets of the mesh, first < second
    Vec3 normal{};                     ///< unit, from the second to the first
    double penetration = 0;            ///< the deepest: gap less the distance along `normal` [length]
    double baseline = 0, rounding = 0; ///< as in Touch [length]
    double weight = 0;                 ///< facing_weight() at its onset
    double area = 0;                   ///< over which they press [area]
    double stiffness = 0;              ///< of that area [force/length]
    std::array<double, 4> first_share{}, second_share{}; ///< of the corners in the pressure
    std::array<Vec3, 4> on_first{}, on_second{};         ///< forces on the corners [force]
    double pressing = 0;                                 ///< normal force [force]
    Vec3 friction{};                                     ///< tangential force on the first [force]
    Vec3 force{};                                        ///< whole force on the first [force]
    double friction_loss = 0;                            ///< what friction took in the last step [energy]
    bool from_start = false; ///< its baseline is that of a penetration before the first cycle
};

/// Contact of segments with segments (SOFT = 2).
///
/// Pairs of facets that face one another press where their projections along a mean of their normals overlap
/// (SegmentOverlap). The normal of the facet that is farther from a rim or a sharp edge, and flatter, counts
/// more, with the fourth power of distance and flatness: a corner that is pushed into a plate is pushed back
/// along the plate's normal. Forces are the gradient of the pair's energy (docs/theory/contact.md),
/// MeanNormal adding what turns the direction: what slides, rolls or turns under load gives back what it
/// took.
///
/// Stiffness per area at the start, from LS-DYNA's formula for a pair (keyword manual, *CONTACT, optional
/// card A: SLSFAC SFS m1 m2 / (m1 + m2) / (2 dt^2) with segment masses, those of a shell or of half a solid)
/// for each of the two: SLSFAC SFS mu1 mu2 / (mu1 + mu2) / dt^2 with masses per area. LS-DYNA measures
/// penetration at nodes and divides the force over the pair; here the pressure is integrated, so that meshes
/// that do not match hand it on evenly.
class FacingSegments {
public:
    struct Options {
        std::array<double, 3> stiffness_scale{}; ///< SLSFAC SFS by sides that a facet belongs to (bits - 1)
        double damping = 0;                      ///< VDC [percent of critical]
        double friction_scale = 1;               ///< FSF
        bool two_sided = false;                  ///< one surface against another: no touches within one
        bool mixed_friction = false;             ///< FS = -1: mean of both parts' values
        double baseline_decay = 0;               ///< DPRFAC: share of a baseline that goes in a cycle
        double friction_stiffness_scale = 1;     ///< FRICSF
        std::vector<double> part_scale;          ///< SSF by part; empty: all 1
        bool larger_part_scale = false;          ///< SSFTYP = 1: the larger one counts, else their mean
    };

    FacingSegments(const ContactMesh& mesh, const Options& options, std::vector<Friction> frictions,
                   std::vector<double> area_mass);

    /// Finds all touches and their forces at n; step: that of the stiffness [time].
    /// Returns what friction took in the last step.
    double find(const ContactMotion& motion, double step);
    /// The next find() looks for pairs anew (surfaces have changed).
    void forget() { searched_at_.clear(); }
    void clear();

    const std::vector<FacingTouch>& touches() const { return now_; }
    /// Masses per area of all facets, once those of the nodes are known (PSTIFF).
    void set_area_mass(std::vector<double> area_mass) { area_mass_ = std::move(area_mass); }
    /// What a node gets of a touch's stiffness, for the stable step: the stiffer way, along the normal or
    /// across.
    double step_stiffness(const FacingTouch& touch) const
    {
        return std::max(1.0, options_.friction_stiffness_scale) * touch.stiffness;
    }
    const ContactMesh& mesh() const { return mesh_; }
    /// Nodes that may still touch segments by themselves, as rims and sharp corners do; changes with every
    /// search.
    const std::vector<std::uint8_t>& sharp_nodes() const { return sharp_; }
    /// Weight of a node's own touch from this direction.
    double node_weight(const ContactMotion& motion, Index node, const Vec3& normal) const;
    long searches() const { return searches_; }
    void serialise(Archive& archive);

private:
    /// What a chunk of the pairs leaves, in room that is used again from cycle to cycle.
    struct Chunk {
        struct Found {
            Index pair = none;
            FacingTouch touch;
        };
        std::vector<FacingCandidate> due, left;
        std::vector<std::size_t> looked_at; ///< blocks of pairs
        std::vector<Found> found;
    };
    const ContactMesh& mesh_;
    Options options_;
    std::vector<Friction> frictions_; ///< by part; the last: of facets without one
    std::vector<double> area_mass_;   ///< by facet [mass/area]
    double margin_ = 0;
    std::vector<FacingPair> pairs_;
    static constexpr std::size_t block_length = 16; ///< a part of chunk_length
    std::vector<double> block_due_; ///< path before which no pair of a block is due; 0: not known [length]
    std::vector<Vec3> searched_at_;
    double test_due_ = 0;
    std::vector<std::uint8_t> sharp_;
    /// By facet: fourth power of how far it is from the next rim or sharp edge over its bend [length^4].
    std::vector<double> standing_;
    std::vector<double> bend_; ///< by facet: the largest angle to one around it, but over sharp edges
    std::vector<FacingTouch> now_, before_; ///< in the order of pairs
    /// Touches of the last cycle by facet: those of f are of_facet_[facet_begin_[f]] ..
    /// of_facet_[facet_begin_[f + 1] - 1], in the order of pairs. Empty without touches.
    std::vector<Index> facet_begin_, of_facet_;
    std::vector<Chunk> chunks_;
    long searches_ = 0;

    bool holds(const ContactMotion& motion);
    void search(const ContactMotion& motion);
    bool may_meet(Index a, Index b) const;
    void find_sharp_nodes(const ContactMotion& motion);
    void find_standing(const ContactMotion& motion);
    void index_touches();
    void find_chunk(const ContactMotion& motion, double step, std::size_t begin, std::size_t end);
    double areal_stiffness(Index a, Index b, double step) const;
    double part_scale(Index a, Index b) const;
    static const FacingTouch* touch_between(const std::vector<FacingTouch>& touches, Index a, Index b);
    std::span<const Index> old_touches_of(Index facet) const
    {
        if (facet_begin_.empty()) return {};
        return {of_facet_.data() + facet_begin_[facet], of_facet_.data() + facet_begin_[facet + 1]};
    }
    /// tolerance  by how much the pair may be deeper than that touch [length]
    const FacingTouch* old_beside(Index a, Index b, const Vec3& direction, const SegmentOverlap& overlap,
                                  double tolerance, bool& turned) const;
    bool touch_of(const ContactMotion& motion, double step, const FacingCandidate& candidate,
                  FacingTouch& touch) const;
    void apply_law(const ContactMotion& motion, double stiffness, const SegmentOverlap& overlap,
                   const FacingCandidate& candidate, const SegmentOverlap::Corners& at_a,
                   const SegmentOverlap::Corners& at_b, FacingTouch& touch) const;
    double lateral_share(Index a, Index b, double along) const;
    Friction friction_of(Index a, Index b) const;
    Vec3 normal_of(const ContactMotion& motion, Index facet) const;
};

} // namespace plash
