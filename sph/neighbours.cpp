#include "sph/neighbours.h"

#include "core/run_error.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>

namespace plash {

namespace {

/// Particles around one cell in contiguous arrays, in sorted order, with room to read a batch past the end.
struct Candidates {
    std::vector<double> x, y, z, reach;
    std::vector<Index> place;
    std::vector<Index> number; ///< in the halo of the run; none: not asked for yet
    std::size_t count = 0;

    void clear() { count = 0; }
    /// Before some more are added.
    void make_room(std::size_t more)
    {
        const std::size_t room = count + more + lane_count;
        if (room <= place.size()) return;
        for (auto* values : {&x, &y, &z, &reach}) values->resize(2 * room);
        place.resize(2 * room);
        number.resize(2 * room);
    }
    void add(const SearchInput& input, Index p)
    {
        x[count] = input.motion[p].position.x;
        y[count] = input.motion[p].position.y;
        z[count] = input.motion[p].position.z;
        reach[count] = input.reach[p];
        place[count] = p;
        number[count++] = none;
    }
    void add(const Candidates& other, std::size_t i)
    {
        x[count] = other.x[i];
        y[count] = other.y[i];
        z[count] = other.z[i];
        reach[count] = other.reach[i];
        place[count] = other.place[i];
        number[count++] = none;
    }
    /// First candidate whose place is not below p.
    std::size_t first_from(Index p) const
    {
        return std::lower_bound(place.begin(), place.begin() + static_cast<std::ptrdiff_t>(count), p) -
               place.begin();
    }
};

/// Numbers places in the order in which they are first asked for.
class HaloNumbers {
public:
    void clear()
    {
        places_.clear();
        slots_.assign(slots_.empty() ? 4096 : slots_.size(), none);
    }
    const std::vector<Index>& places() const { return places_; }

    /// The number of a place, cut to 16 bits: meaningless once there are more.
    std::uint16_t number_of(Index place)
    {
        std::size_t slot = first_slot(place);
        while (slots_[slot] != none) {
            if (places_[slots_[slot]] == place) return static_cast<std::uint16_t>(slots_[slot]);
            slot = (slot + 1) & (slots_.size() - 1);
        }
        slots_[slot] = static_cast<Index>(places_.size());
        places_.push_back(place);
        const auto number = static_cast<std::uint16_t>(places_.size() - 1);
        if (2 * places_.size() > slots_.size()) grow();
        return number;
    }

private:
    std::vector<Index> places_;
    std::vector<Index> slots_; ///< open addressing over places_; none: free

    std::size_t first_slot(Index place) const
    {
        return (static_cast<std::size_t>(place) * 0x9e3779b97f4a7c15ULL >> 20) & (slots_.size() - 1);
    }
    void grow()
    {
        slots_.assign(2 * slots_.size(), none);
        for (std::size_t i = 0; i < places_.size(); ++i) {
            std::size_t slot = first_slot(places_[i]);
            while (slots_[slot] != none) slot = (slot + 1) & (slots_.size() - 1);
            slots_[slot] = static_cast<Index>(i);
        }
    }
};

/// Pairs of a run that wait for the second of their particles to be listed, with it.
class HandedOver {
public:
    void clear(Index particles)
    {
        last_.assign(particles, none);
        pairs_.clear();
    }
    void add(Index to, Index from)
    {
        pairs_.push_back({from, last_[to]});
        last_[to] = static_cast<Index>(pairs_.size()) - 1;
    }
    /// Calls take(from) for all that were handed over to a particle.
    template <class Take>
    void for_each(Index to, Take&& take) const
    {
        for (Index pair = last_[to]; pair != none; pair = pairs_[pair].before) take(pairs_[pair].from);
    }

private:
    struct Pair {
        Index from, before;
    };
    std::vector<Index> last_; ///< by particle of the run: the last pair handed over to it
    std::vector<Pair> pairs_;
};

/// What one thread works with.
struct Scratch {
    Candidates awake, others;           ///< others: images, and who is asleep
    Candidates cell_awake, cell_others; ///< the same of a whole cell, where these are of a part of it
    std::vector<std::uint32_t> found;   ///< numbers of candidates
    std::vector<std::uint16_t> inside;
    std::vector<std::uint16_t> outside;
    HaloNumbers halo;
    HandedOver handed_over;
};

Lanes load(const double* values)
{
    Lanes lanes;
    std::memcpy(&lanes, values, sizeof lanes);
    return lanes;
}

/// Bits of the lanes that are set.
unsigned bits_of(LaneMask mask)
{
#if defined(__AVX512DQ__)
    return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask));
#else
    unsigned bits = 0;
    for (int lane = 0; lane < lane_count; ++lane) bits |= static_cast<unsigned>(mask[lane] & 1) << lane;
    return bits;
#endif
}

/// Writes first + lane for the set lanes, one after another, and returns the new end.
std::uint32_t* append_set(unsigned bits, std::uint32_t first, std::uint32_t* end)
{
#if defined(__AVX512VL__)
    const __m256i all = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                                         _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    const auto mask = static_cast<__mmask8>(bits);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(end), _mm256_maskz_compress_epi32(mask, all));
    return end + std::popcount(bits);
#else
    for (; bits != 0; bits &= bits - 1) *end++ = first + static_cast<std::uint32_t>(std::countr_zero(bits));
    return end;
#endif
}

/// Appends to `found` those of the candidates first .. last - 1 that particle p reaches.
std::uint32_t* find_close(const Candidates& candidates, std::size_t first, std::size_t last,
                          const Vec3& position, double reach, std::uint32_t* found)
{
    for (std::size_t c = first; c < last; c += lane_count) {
        const Lanes x = load(&candidates.x[c]) - position.x;
        const Lanes y = load(&candidates.y[c]) - position.y;
        const Lanes z = load(&candidates.z[c]) - position.z;
        const Lanes limit = load(&candidates.reach[c]) + reach;
        unsigned bits = bits_of(x * x + y * y + z * z < limit * limit);
        if (last - c < lane_count) bits &= (1u << (last - c)) - 1;
        found = append_set(bits, static_cast<std::uint32_t>(c), found);
    }
    return found;
}

/// Those of `all` whose reach, with `reach`, comes to a box.
void take_near(const Candidates& all, const Vec3& lower, const Vec3& upper, double reach, Candidates& near)
{
    const auto beyond = [](const double* x, double low, double high) {
        const Lanes at = load(x);
        return max(max(low - at, at - high), Lanes{});
    };
    near.clear();
    near.make_room(all.count);
    for (std::size_t c = 0; c < all.count; c += lane_count) {
        const Lanes x = beyond(&all.x[c], lower.x, upper.x), y = beyond(&all.y[c], lower.y, upper.y),
                    z = beyond(&all.z[c], lower.z, upper.z);
        const Lanes limit = load(&all.reach[c]) + reach;
        unsigned bits = bits_of(x * x + y * y + z * z < limit * limit);
        if (all.count - c < lane_count) bits &= (1u << (all.count - c)) - 1;
        for (; bits != 0; bits &= bits - 1) near.add(all, c + std::countr_zero(bits));
    }
}

/// Takes the candidates that p's group does not see out of [begin, end); returns the new end.
std::uint32_t* drop_unseen(const SearchInput& input, Index p, const Candidates& candidates,
                           std::uint32_t* begin, std::uint32_t* end)
{
    if (input.sees.empty()) return end;
    const std::uint64_t seen = input.sees[input.group[p]];
    return std::remove_if(
        begin, end, [&](std::uint32_t other) { return !(seen >> input.group[candidates.place[other]] & 1); });
}

class RunBuilder {
public:
    RunBuilder(const ParticleCells& cells, const SearchInput& input, NeighbourRun& run, Scratch& scratch)
        : cells_(cells), input_(input), run_(run), scratch_(scratch)
    {}

    /// False when the halo has more places than it may have.
    bool build(std::size_t largest_halo)
    {
        run_.batches.assign(run_.length(), {});
        scratch_.inside.clear();
        scratch_.outside.clear();
        scratch_.halo.clear();
        scratch_.handed_over.clear(run_.length());
        for (Index cell = cells_.cell_of_place(run_.begin);
             cell < cells_.cell_count() && cells_.begin(cell) < run_.end; ++cell) {
            const Index first = std::max(run_.begin, cells_.begin(cell));
            const Index last = std::min(run_.end, cells_.end(cell));
            if (first >= last) continue; // images alone
            collect_candidates(cell);
            if (scratch_.awake.count + scratch_.others.count <= many_candidates) {
                list_all(first, last);
                continue;
            }
            std::swap(scratch_.awake, scratch_.cell_awake);
            std::swap(scratch_.others, scratch_.cell_others);
            for (Index begin = first; begin < last; begin += group_length) {
                const Index end = std::min(begin + group_length, last);
                narrow_candidates(begin, end);
                list_all(begin, end);
            }
        }
        // Exact sizes: the lists are most of what a particle costs in memory.
        run_.inside.assign(scratch_.inside.begin(), scratch_.inside.end());
        run_.outside.assign(scratch_.outside.begin(), scratch_.outside.end());
        run_.halo = scratch_.halo.places();
        return run_.halo.size() <= largest_halo;
    }

private:
    const ParticleCells& cells_;
    const SearchInput& input_;
    NeighbourRun& run_;
    Scratch& scratch_;
    /// Cells as wide as the largest kernel hold many particles of small ones: then candidates are looked
    /// through for groups of particles that stand side by side, and what is left for each of them.
    static constexpr std::size_t many_candidates = 3000;
    static constexpr Index group_length = 64;
    std::size_t run_first_ = 0, run_last_ = 0; ///< candidates awake that belong to the run

    void collect_candidates(Index cell)
    {
        scratch_.awake.clear();
        scratch_.others.clear();
        std::array<Index, 27> around;
        const int count = cells_.around(cell, around);
        for (int i = 0; i < count; ++i) {
            const Index cell_around = around[i];
            const std::size_t particles = cells_.end(cell_around) - cells_.begin(cell_around);
            scratch_.awake.make_room(particles);
            scratch_.others.make_room(particles + cells_.first_copy(cell_around + 1) -
                                      cells_.first_copy(cell_around));
            for (Index p = cells_.begin(cell_around); p < cells_.end(cell_around); ++p) {
                (input_.asleep[p] ? scratch_.others : scratch_.awake).add(input_, p);
            }
            for (Index p = cells_.first_copy(cell_around); p < cells_.first_copy(cell_around + 1); ++p) {
                scratch_.others.add(input_, p);
            }
        }
    }

    /// The candidates of a cell that particles begin .. end - 1 may reach.
    void narrow_candidates(Index begin, Index end)
    {
        Vec3 lower = input_.motion[begin].position, upper = lower;
        double reach = 0;
        for (Index p = begin; p < end; ++p) {
            const Vec3& x = input_.motion[p].position;
            lower = {std::min(lower.x, x.x), std::min(lower.y, x.y), std::min(lower.z, x.z)};
            upper = {std::max(upper.x, x.x), std::max(upper.y, x.y), std::max(upper.z, x.z)};
            reach = std::max<double>(reach, input_.reach[p]);
        }
        take_near(scratch_.cell_awake, lower, upper, reach, scratch_.awake);
        take_near(scratch_.cell_others, lower, upper, reach, scratch_.others);
    }

    /// Lists the neighbours of particles first .. last - 1 among the candidates.
    void list_all(Index first, Index last)
    {
        run_first_ = scratch_.awake.first_from(run_.begin);
        run_last_ = scratch_.awake.first_from(run_.end);
        scratch_.found.resize(std::max(scratch_.awake.count, scratch_.others.count) + 2 * lane_count);
        for (Index p = first; p < last; ++p) {
            if (!input_.asleep[p]) list(p);
        }
    }

    void list(Index p)
    {
        Candidates& awake = scratch_.awake;
        const Vec3& position = input_.motion[p].position;
        const double reach = input_.reach[p];
        std::uint32_t* const begin = scratch_.found.data();
        NeighbourRun::Batches& batches = run_.batches[p - run_.begin];

        std::uint32_t* end = find_close(awake, awake.first_from(p + 1), run_last_, position, reach, begin);
        end = drop_unseen(input_, p, awake, begin, end);
        batches.inside = list_inside(p - run_.begin, {begin, end});

        const std::size_t start = scratch_.outside.size();
        end = find_close(awake, 0, run_first_, position, reach, begin);
        end = find_close(awake, run_last_, awake.count, position, reach, end);
        list_outside(p, awake, begin, end);
        end = find_close(scratch_.others, 0, scratch_.others.count, position, reach, begin);
        list_outside(p, scratch_.others, begin, end);
        batches.outside = batch_count(static_cast<std::ptrdiff_t>(scratch_.outside.size() - start));
        while (scratch_.outside.size() % lane_count != 0) {
            scratch_.outside.push_back(scratch_.halo.number_of(p));
        }
    }

    /// A candidate is looked up in the halo once, not with every particle that it is close to.
    void list_outside(Index p, Candidates& candidates, std::uint32_t* begin, std::uint32_t* end)
    {
        end = drop_unseen(input_, p, candidates, begin, end);
        const std::size_t start = scratch_.outside.size();
        scratch_.outside.resize(start + (end - begin));
        std::uint16_t* listed = scratch_.outside.data() + start;
        for (const std::uint32_t* other = begin; other < end; ++other) {
            Index& number = candidates.number[*other];
            if (number == none) number = scratch_.halo.number_of(candidates.place[*other]);
            *listed++ = static_cast<std::uint16_t>(number);
        }
    }

    /// Lists pairs with particles that come later in the run, and those that earlier ones have handed over.
    /// What does not fill a pair of batches is handed on: lists without filling save an eighth of all pairs.
    std::uint16_t list_inside(Index own, std::span<const std::uint32_t> later)
    {
        const Index* place = scratch_.awake.place.data();
        std::vector<std::uint16_t>& inside = scratch_.inside;
        const std::size_t start = inside.size();
        scratch_.handed_over.for_each(own, [&](Index from) { inside.push_back(from); });
        const std::size_t waiting = inside.size(), all = waiting - start + later.size();
        const std::size_t left_over = std::min(all % pair_count, later.size());
        inside.resize(waiting + later.size() - left_over);
        std::uint16_t* listed = inside.data() + waiting;
        for (std::uint32_t other : later.first(later.size() - left_over)) {
            *listed++ = static_cast<std::uint16_t>(place[other] - run_.begin);
        }
        for (std::uint32_t other : later.last(left_over)) {
            scratch_.handed_over.add(place[other] - run_.begin, own);
        }
        while (inside.size() % pair_count != 0) inside.push_back(own);
        return batch_count(static_cast<std::ptrdiff_t>(inside.size() - start));
    }

    static std::uint16_t batch_count(std::ptrdiff_t neighbours)
    {
        return static_cast<std::uint16_t>((neighbours + lane_count - 1) / lane_count);
    }
};

/// Runs of a length that depends on the number of particles alone: long ones hold more pairs inside, but a
/// body must have enough of them to feed many threads.
void cut_runs(Index particles, std::vector<NeighbourRun>& runs)
{
    const Index length = std::clamp<Index>(particles / 32, 256, longest_run);
    runs.resize((particles + length - 1) / length);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        runs[i].begin = static_cast<Index>(i) * length;
        runs[i].end = std::min(particles, runs[i].begin + length);
    }
}

/// A run in two halves, and so on, until their halos fit.
void build_halves(const ParticleCells& cells, const SearchInput& input, const NeighbourRun& whole,
                  Scratch& scratch, std::size_t largest_halo, std::vector<NeighbourRun>& runs)
{
    if (whole.length() == 1) {
        throw RunError(fmt::format("a particle has more than {} neighbours", largest_halo));
    }
    const Index middle = whole.begin + whole.length() / 2;
    for (const auto& [begin, end] : {std::pair{whole.begin, middle}, std::pair{middle, whole.end}}) {
        NeighbourRun half;
        half.begin = begin;
        half.end = end;
        if (RunBuilder(cells, input, half, scratch).build(largest_halo)) {
            runs.push_back(std::move(half));
        } else {
            build_halves(cells, input, half, scratch, largest_halo, runs);
        }
    }
}

} // namespace

void build_neighbours(const ParticleCells& cells, const SearchInput& input, std::vector<NeighbourRun>& runs,
                      std::size_t largest_halo)
{
    cut_runs(static_cast<Index>(input.real_count()), runs);
    const auto count = static_cast<std::ptrdiff_t>(runs.size());
    std::vector<char> fits(runs.size());
#pragma omp parallel if (count > 1)
    {
        Scratch scratch;
#pragma omp for schedule(dynamic)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            fits[i] = RunBuilder(cells, input, runs[i], scratch).build(largest_halo);
        }
    }
    if (std::all_of(fits.begin(), fits.end(), [](char fit) { return fit; })) return;
    std::vector<NeighbourRun> all;
    Scratch scratch;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (fits[i]) {
            all.push_back(std::move(runs[i]));
        } else {
            build_halves(cells, input, runs[i], scratch, largest_halo, all);
        }
    }
    runs = std::move(all);
}

} // namespace plash
