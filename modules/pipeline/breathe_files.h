#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/piece_files.h"
#include "pipeline/breathe.h"

namespace pneuma {

/// The part that a chest wall has in a collection.
inline constexpr int ChestWallPart = 2;

/// What writeBreath() writes for "breath.pvd": breath.csv, breath.json, breath.vtp.series and a VTP
/// for every frame, beside it: breath_0000.vtp and, with a tree, breath_tree_0000.vtp, with a chest
/// wall breath_chest_wall_0000.vtp. What would be larger than that is in pieces (piece_files.h), as
/// breath_0000/breath_0000_0.vtp, and the collection names breath_0000.vtm, which names them. If
/// surfaces are in pieces, there is no .vtp.series.
std::vector<std::filesystem::path> breathOutputs(const std::filesystem::path& pvd,
                                                 const BreathingLungs& lungs,
                                                 std::uint64_t largestFileBytes = LargestFileBytes);

/// The same of what breathe() is given, as far as it can be told before: a chest wall counts as one
/// file, and surfaces of a lung that is not whole count.
std::vector<std::filesystem::path> breathOutputs(const std::filesystem::path& pvd,
                                                 const LungModel& model,
                                                 const BreatheOptions& options,
                                                 std::uint64_t largestFileBytes = LargestFileBytes);

/// @param outputs breathOutputs()
/// @throws OutputFailed if a .vtp.series of an earlier breath would stay beside this one
void requireNoOtherSeries(const std::filesystem::path& pvd,
                          const std::vector<std::filesystem::path>& outputs);

/// Writes a breath for ParaView. Points really move, triangles are the same in every frame; the
/// collection ends with the first frame again, one period later. Arrays of points: `displacement`
/// (mm, from rest), `F` (mm, its length at s = 1), `volume_change` (local volume by that at rest)
/// and `strain` (its cube root less 1); of triangles: `lobe`. The chest wall has
/// `displacement` alone. The table has time, pressure, flow, volumes.
/// @throws OutputFailed, Cancelled: what was written before stays
void writeBreath(const std::filesystem::path& pvd, const BreathingLungs& lungs, const Json& report,
                 const Progress& progress = {}, std::uint64_t largestFileBytes = LargestFileBytes);

}  // namespace pneuma
