#include "error_sources_mpi.hpp"

#include "failure_mpi.hpp"
#include "gather/lean_cells.hpp"
#include "gather_mpi.hpp"

#include <rrcb/method/bisection.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/quality.hpp>

#include <algorithm>
#include <cmath>

namespace comparisons {

namespace {

/// Moments of the cells of this rank's support mesh, as they reach the root.
std::vector<rrcb::CellMoments> cells_of(const SourceSetting& setting, const rrcb::Points& points) {
    if (points.count == 0) return {};
    const rrcb::SupportMesh mesh =
        rrcb::make_support_mesh(rrcb::bounding_box(points), points.dimension, setting.mesh);
    if (setting.source == Source::cells) return lean_cells(points, mesh);
    return rrcb::cell_moments(points, mesh);
}

/// The box of all cells, which is that of all points: its faces are those of the ranks' meshes.
rrcb::Box box_of(std::span<const rrcb::CellMoments> cells) {
    rrcb::Box box;
    for (const rrcb::CellMoments& cell : cells) {
        for (std::size_t a = 0; a < box.lower.size(); ++a) {
            box.lower[a] = std::min(box.lower[a], cell.box.lower[a]);
            box.upper[a] = std::max(box.upper[a], cell.box.upper[a]);
        }
    }
    return box;
}

/// Cuts the patches of box_domain off at the faces of a box each.
rrcb::StatisticalDomain clamped(rrcb::StatisticalDomain domain, std::span<const rrcb::Box> boxes) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        rrcb::Patch& patch = domain.patches[i];
        for (std::size_t a = 0; a < static_cast<std::size_t>(domain.dimension); ++a) {
            patch.lower[a] = std::clamp(patch.lower[a], boxes[i].lower[a], boxes[i].upper[a]);
            patch.upper[a] = std::clamp(patch.upper[a], boxes[i].lower[a], boxes[i].upper[a]);
        }
    }
    return domain;
}

rrcb::StatisticalDomain domain_of(const SourceSetting& setting,
                                  std::span<const rrcb::CellMoments> cells, int dimension) {
    if (setting.source == Source::cells)
        return rrcb::analytic_domain(cells, dimension, box_of(cells));
    if (setting.source == Source::boxes) return box_domain(cells, dimension, setting.k);
    std::vector<rrcb::Box> boxes(cells.size(), box_of(cells));
    if (setting.source == Source::in_cells)
        std::ranges::transform(cells, boxes.begin(), &rrcb::CellMoments::box);
    return clamped(box_domain(cells, dimension, setting.k), boxes);
}

rrcb::Cuts bisect(const SourceSetting& setting, std::span<const rrcb::CellMoments> cells,
                  int dimension, int num_parts) {
    if (setting.source != Source::sampled)
        return rrcb::bisect(domain_of(setting, cells, dimension), num_parts, {}).cuts;
    rrcb::PaperOptions options;
    options.sigma_multiplier = setting.k;
    options.sample_fraction = setting.fraction;
    options.seed = setting.seed;
    return rrcb::bisect_points(rrcb::sample_points(cells, dimension, options), dimension, num_parts,
                               {}, rrcb::CutRule::weighted_fraction)
        .cuts;
}

/// Cuts of the domain of everybody's cells, on every rank.
rrcb::Cuts cut_cells(const SourceSetting& setting, const rrcb::Points& points, MPI_Comm comm) {
    const int rank = rank_of(comm);
    const int num_parts = size_of(comm);
    const std::vector<rrcb::CellMoments> cells = gather_on_root(cells_of(setting, points), comm);
    rrcb::Cuts cuts{points.dimension, num_parts, {}};
    if (rank == 0) cuts = bisect(setting, cells, points.dimension, num_parts);
    cuts.tree.resize(static_cast<std::size_t>(num_parts) - 1);
    MPI_Bcast(cuts.tree.data(), static_cast<int>(cuts.tree.size() * sizeof(rrcb::Cut)), MPI_BYTE, 0,
              comm);
    return cuts;
}

std::string name_of(Source source) {
    const char* const names[] = {"points", "cells", "boxes", "in_cells", "in_all", "sampled"};
    return names[static_cast<int>(source)];
}

Row source_key(const Workload& workload, rrcb::GlobalCount num_points, int num_ranks,
               const SourceSetting& setting) {
    return Row()
        .add("workload", workload.name)
        .add("layout", workload.layout)
        .add("dim", workload.dimension)
        .add("points", num_points)
        .add("ranks", num_ranks)
        .add("domain", name_of(setting.source))
        .add("mesh", setting.mesh)
        .add("k", setting.k)
        .add("fraction", setting.fraction)
        .add("seed", setting.seed)
        .end_key();
}

Row source_row(Row key, std::span<const double> part_weights) {
    return key.add("imbalance", rrcb::imbalance(part_weights))
        .add("lu_max_percent", rrcb::worst_load_unbalance_percent(part_weights))
        .add_error("");
}

}  // namespace

std::vector<rrcb::CellMoments> lean_cells(const rrcb::Points& points,
                                          const rrcb::SupportMesh& mesh) {
    const std::vector<rrcb::CellMoments> cells = rrcb::cell_moments(points, mesh);
    const rrcb::LeanCells packed = rrcb::pack_cells(cells, mesh);
    std::vector<rrcb::CellMoments> lean;
    rrcb::unpack_cells(packed, packed.bytes, cells.size(), mesh, lean);
    return lean;
}

rrcb::StatisticalDomain box_domain(std::span<const rrcb::CellMoments> cells, int dimension,
                                   double k) {
    rrcb::StatisticalDomain domain{dimension, {}};
    for (const rrcb::CellMoments& cell : cells) {
        rrcb::Patch patch{{}, {}, cell.moments.weight};
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
            patch.lower[a] = cell.moments.mean[a] - k * cell.moments.deviation[a];
            patch.upper[a] = cell.moments.mean[a] + k * cell.moments.deviation[a];
        }
        domain.patches.push_back(patch);
    }
    return domain;
}

std::vector<double> source_part_weights(const SourceSetting& setting, const rrcb::Points& points,
                                        MPI_Comm comm) {
    const int num_parts = size_of(comm);
    std::vector<rrcb::Part> parts(points.count);
    if (setting.source == Source::points) {
        rrcb::PaperOptions options;
        options.domain = rrcb::PaperDomain::points;
        parts = rrcb::balance_as_in_paper(points, options, comm).parts;
    } else {
        rrcb::assign(cut_cells(setting, points, comm), points, parts);
    }
    return rrcb::part_weights(points, parts, num_parts, comm);
}

std::vector<SourceSetting> source_settings(bool quick) {
    // The fractions of the paper, and one so large that hardly any noise is left.
    const std::vector<double> fractions =
        quick ? std::vector<double>{1} : std::vector<double>{4, 1, 0.5, 0.25, 0.125};
    const std::vector<int> meshes = quick ? std::vector{4} : std::vector{2, 4, 6, 8, 10, 16, 32};
    constexpr double of_the_paper = 1.5;
    constexpr std::uint64_t num_seeds = 10;
    std::vector<SourceSetting> settings = {{}};
    for (const int mesh : meshes) {
        settings.push_back({Source::cells, mesh});
        for (const double k : {1.0, of_the_paper, std::sqrt(3.0), 2.0, 2.5}) {
            settings.push_back({Source::boxes, mesh, k});
        }
        settings.push_back({Source::in_cells, mesh, std::sqrt(3.0)});
        settings.push_back({Source::in_all, mesh, std::sqrt(3.0)});
        for (const double fraction : fractions) {
            for (std::uint64_t seed = 1; seed <= num_seeds; ++seed) {
                settings.push_back({Source::sampled, mesh, of_the_paper, fraction, seed});
            }
        }
    }
    return settings;
}

void find_error_sources(const Sweep& sweep) {
    // The sampled domain of a large fraction takes long, and noise hardly depends on the number.
    const rrcb::GlobalCount num_points = std::max<rrcb::GlobalCount>(1, sweep.arguments.points / 4);
    SavedRows rows(sweep.folder, "error_sources.csv", source_row(source_key({}, 0, 0, {}), {}));
    on_each_cloud(sweep, num_points, [&](const Workload& workload) {
        std::vector<SourceSetting> settings = source_settings(sweep.arguments.quick);
        const auto key = [&](const SourceSetting& setting) {
            return source_key(workload, num_points, sweep.num_ranks, setting);
        };
        std::erase_if(settings, [&](const SourceSetting& s) { return rows.has(key(s)); });
        if (settings.empty()) return true;
        sweep.progress.start(workload.name + ": sources", static_cast<int>(settings.size()));
        std::vector<Row> measured;
        for (const SourceSetting& setting : settings) {
            measured.push_back(source_row(
                key(setting), source_part_weights(setting, workload.points(), sweep.comm)));
            sweep.progress.advance();
        }
        rows.add(measured);
        return true;
    });
}

}  // namespace comparisons
