#pragma once

#include "pipeline/detail/project_parts.h"

// The same of the steps of the work: lungs in a CT, growth, breathing, and of the project itself.
namespace pneuma {

/// Of a folder, too, whose path ends in a slash.
std::string fileName(const std::filesystem::path& path);

template <class Archive, class T>
requires Is<T, LungFinding>

void describe(Archive& archive, T& lung) {
  archive("volume_ml", lung.volumeMl);
  archive("volume_with_airways_ml", lung.volumeWithAirwaysMl);
  archive("air_ml", lung.airMl);
  archive("mean_hu", lung.meanHu);
  archive("dense_share", lung.denseShare);
  archive("dropped_ml", lung.droppedMl);
  archive("border_mm2", lung.borderMm2);
  archive("lowest_slice_mm2", lung.lowestSliceMm2);
  archive("highest_slice_mm2", lung.highestSliceMm2);
}

template <class Archive, class T>
requires Is<T, AirwayFinding>

void describe(Archive& archive, T& airways) {
  archive("found", airways.found);
  archive("trachea_length_mm", airways.tracheaLengthMm);
  archive("base_threshold_hu", airways.baseThresholdHu);
  archive("base_ml", airways.baseMl);
  archive("volume_ml", airways.volumeMl);
  archive("leaks_undone", airways.leaksUndone);
  archive("walls_missed", airways.wallsMissed);
  archive("steps_followed", airways.stepsFollowed);
  archive("largest_step_ml", airways.largestStepMl);
}

template <class Archive, class T>
requires Is<T, BronchusNames>

void describe(Archive& archive, T& names) {
  archive("carina", names.carina);
  archive("trachea", names.trachea);
  archive("right_main", names.rightMain);
  archive("left_main", names.leftMain);
  archive("intermedius", names.intermedius);
  archive("right_upper", names.rightUpper);
  archive("right_middle", names.rightMiddle);
  archive("right_lower", names.rightLower);
  archive("left_upper", names.leftUpper);
  archive("left_lower", names.leftLower);
}

template <class Archive, class T>
requires Is<T, Handedness>

void describe(Archive& archive, T& hands) {
  archive("heart", hands.heart);
  archive("volume", hands.volume);
  archive("dome", hands.dome);
}

template <class Archive, class T>
requires Is<T, SegmentationCheck>

void describe(Archive& archive, T& check) {
  archive("id", check.id);
  archive("what", check.what);
  archive("value", check.value);
  archive("low", check.low);
  archive("high", check.high);
  archive("unit", check.unit);
  archive("advice", check.advice);
}

template <class Archive, class T>
requires Is<T, LungSegmentation>

void describe(Archive& archive, T& lungs) {
  archive("labels", lungs.labels);
  archive("right", lungs.right);
  archive("left", lungs.left);
  archive("airways", lungs.airways);
  archive("central", lungs.central);
  archive("names", lungs.names);
  if constexpr (Archive::Reading) {
    const BronchusNames& names = lungs.names;
    for (const auto& branch :
         {names.trachea, names.rightMain, names.leftMain, names.intermedius, names.rightUpper,
          names.rightMiddle, names.rightLower, names.leftUpper, names.leftLower}) {
      if (branch && *branch >= lungs.central.size()) archive.fail("names a branch too many");
    }
  }
  archive("separated", lungs.separated);
  archive("bridge_mm", lungs.bridgeMm);
  archive("gas_removed_ml", lungs.gasRemovedMl);
  archive("air_elsewhere_ml", lungs.airElsewhereMl);
  archive("hands", lungs.hands);
  archive("checks", lungs.checks);
}

template <class Archive, class T>
requires Is<T, LungEdit>

void describe(Archive& archive, T& edit) {
  archive("tool", edit.tool);
  archive("lung", edit.side);
  archive("shape", edit.shape);
  archive("radius_mm", edit.radiusMm);
  archive("points", edit.points);
  archive("below_hu", edit.belowHu);
}

template <class Archive, class T>
requires Is<T, LungCorrections>

void describe(Archive& archive, T& corrections) {
  archive("found", corrections.found);
  archive("read", corrections.read);
  archive("edits", corrections.edits);
  if constexpr (Archive::Reading) {
    if (!corrections.found && !corrections.read) archive.fail("corrects no labels");
  }
}

template <class Archive, class T>
requires Is<T, GrowthOptions>

void describe(Archive& archive, T& options) {
  std::string method(growthMethod(options).name);
  archive("method", method);
  if constexpr (Archive::Reading) {
    try {
      options = growthMethod(method).defaults;
    } catch (const InvalidOption&) {
      archive.fail("names a method of growth that this version does not have");
    }
  }
  std::visit([&](auto& chosen) { archive("options", chosen); }, options);
}

template <class Archive, class T>
requires Is<T, Outside>

void describe(Archive& archive, T& outside) {
  archive("ends", outside.ends);
  archive("segments", outside.segments);
}

template <class Archive, class T>
requires Is<T, EfficiencyCubes>

void describe(Archive& archive, T& cubes) {
  archive("edge_mm", cubes.edgeMm);
  archive("node", cubes.node);
  archive("least_inside", cubes.leastInside);
}

template <class Archive, class T>
requires Is<T, EfficiencyFunctions>

void describe(Archive& archive, T& functions) {
  archive("cn", functions.cn);
  archive("vr", functions.vr);
  archive("el", functions.el);
  archive("pi", functions.pi);
  archive("cubes", functions.cubes);
  archive("cube_count", functions.cubeCount);
  archive("lung_volume_ml", functions.lungVolumeMl);
}

template <class Archive, class T>
requires Is<T, Efficiency>

void describe(Archive& archive, T& efficiency) {
  archive("branches", efficiency.branches);
  archive("terminals", efficiency.terminals);
  archive("failed", efficiency.failed);
  archive("qf", efficiency.qf);
  archive("ca", efficiency.ca);
  archive("airway_volume_ml", efficiency.airwayVolumeMl);
  archive("paper", efficiency.paper);
  archive("today", efficiency.today);
}

/// The points of an aggregate as a PLY without triangles.
std::string textOfAggregate(const std::vector<AggregatePoint>& points);

/// @param name for messages @throws InvalidInput
std::vector<AggregatePoint> aggregateOfText(const std::string& text, const std::string& name);

template <class Archive, class T>
requires Is<T, GrowthResult>

void describe(Archive& archive, T& result) {
  archive("tree", result.tree);
  archive("figures", result.figures);
  archive("warnings", result.warnings);
  std::size_t points = result.aggregate.size();
  archive("aggregate_points", points);
  if (points > 0) {
    if constexpr (Archive::Reading) {
      result.aggregate = aggregateOfText(archive.file("aggregate"), archive.where());
    } else {
      archive.file("aggregate", "trees", ".ply", textOfAggregate(result.aggregate));
    }
  }
  archive("ends_contained", result.endsContained);
  archive("branches_contained", result.branchesContained);
}

template <class Archive, class T>
requires Is<T, Growth>

void describe(Archive& archive, T& growth) {
  archive("options", growth.options);
  archive("result", growth.result);
  archive("outside", growth.outside);
  archive("efficiency", growth.efficiency);
  archive("domain_s", growth.domainSeconds);
  archive("grow_s", growth.growSeconds);
}

template <class Archive, class T>
requires Is<T, StiffnessRegion>

void describe(Archive& archive, T& region) {
  archive("lobe", region.lobe);
  archive("centre", region.centre);
  archive("radius_mm", region.radiusMm);
  archive("factor", region.factor);
}

template <class Archive, class T>
requires Is<T, BreathSample>

void describe(Archive& archive, T& sample) {
  archive("s", sample.seconds);
  archive("pressure", sample.pressure);
  archive("volume", sample.volume);
  archive("flow", sample.flow);
}

template <class Archive, class T>
requires Is<T, BreathCycle>

void describe(Archive& archive, T& cycle) {
  archive("samples", cycle.samples);
  archive("tidal", cycle.tidal);
  archive("trapped", cycle.trapped);
  archive("peak_inspiratory", cycle.peakInspiratory);
  archive("peak_expiratory", cycle.peakExpiratory);
  archive("closure", cycle.closure);
}

template <class Archive, class T>
requires Is<T, BreathFit>

void describe(Archive& archive, T& fit) {
  archive("resistance", fit.resistance);
  archive("compliance", fit.compliance);
  archive("offset", fit.offset);
  archive("inertance", fit.inertance);
  archive("period", fit.period);
  archive("tidal", fit.tidal);
  archive("rms", fit.rms);
  archive("simulations", fit.simulations);
  archive("cycle", fit.cycle);
}

template <class Archive, class T>
requires Is<T, PersonMotion>

void describe(Archive& archive, T& person) {
  // Of the path in quotation marks, folders may carry names of people.
  std::string file = fileName(person.name);
  std::erase(file, '\'');
  archive("file", file);
  archive("kind", person.kind);
  std::vector<double> constants;
  if constexpr (!Archive::Reading) constants = constantsOf(person.form, person.kind);
  archive("constants", constants);
  archive("landmarks", person.landmarks);
  archive("held_out", person.heldOut);
  archive("error_mm", person.errorMm);
  archive("still_mm", person.stillMm);
  archive("strain", person.strain);
  archive("rest_ml", person.restMl);
  if constexpr (Archive::Reading) {
    person.name = "'";
    person.name.append(file).append("'");
    if (constants.size() != constantCount(person.kind)) archive.fail("has too few constants");
    person.form = formOf(person.kind, constants);
  }
}

template <class Archive, class T>
requires Is<T, BreatheOptions>

void describe(Archive& archive, T& options) {
  forEachField<BreatheOptions>([&](const auto& field) {
    archive(std::string(field.name).c_str(), options.*(field.member));
  });
  archive("fit", options.fit);
  archive("person", options.person);
  archive("regions", options.regions);
}

template <class Archive, class T>
requires Is<T, InputFile>

void describe(Archive& archive, T& input) {
  // Folders may carry names of people; where the CT is stands elsewhere.
  std::string name = fileName(input.path);
  archive("name", name);
  if constexpr (Archive::Reading) input.path = name;
  archive("sha256", input.sha256);
}

/// The CT stands beside the states: here is only whether there is one.
template <class Archive, class T>
requires Is<T, LungModel>

void describe(Archive& archive, T& model) {
  bool hasCt = model.ct || model.ctSource;
  archive("has_ct", hasCt);
  archive("lungs", model.lungs);
  bool labelsOfLungs = model.lungs && model.labels.get() == &model.lungs->labels;
  bool centralOfLungs = model.lungs && model.central.get() == &model.lungs->central;
  archive("labels_of_lungs", labelsOfLungs);
  archive("central_of_lungs", centralOfLungs);
  if constexpr (Archive::Reading) {
    if (hasCt) model.ctSource = std::make_shared<const CtSource>();
    if ((labelsOfLungs || centralOfLungs) && !model.lungs) archive.fail("has no lungs");
    if (labelsOfLungs) model.labels = {model.lungs, &model.lungs->labels};
    if (centralOfLungs) model.central = {model.lungs, &model.lungs->central};
  }
  if (!labelsOfLungs) archive("labels", model.labels);
  archive("corrections", model.corrections);
  archive("surfaces", model.surfaces);
  archive("whole_lungs", model.wholeLungs);
  archive("lobes", model.lobes);
  archive("organ", model.organ);
  if (!centralOfLungs) archive("central", model.central);
  archive("growth", model.growth);
  archive("opened", model.opened);
  archive("cubes", model.cubes);
  archive("inputs", model.inputs);
  archive("warnings", model.warnings);
  archive("read_s", model.readSeconds);
}

template <class Archive, class T>
requires Is<T, ProjectState>

void describe(Archive& archive, T& state) {
  archive("name", state.name);
  archive("model", state.model);
  archive("lungs_found_with", state.lungOptions);
  archive("lungs_follow", state.lungsFollow);
  archive("lobe_edits", state.lobeEdits);
  archive("lobes_split_with", state.splitEdits);
  archive("reviews", state.reviews);
  archive("grown_in", state.grownIn);
  archive("breath", state.breath);
}

template <class Archive, class T>
requires Is<T, ProjectStep>

void describe(Archive& archive, T& step) {
  archive("name", step.name);
  archive("state", step.state);
}

template <class Archive, class T>
requires Is<T, NextOptions>

void describe(Archive& archive, T& next) {
  archive("method", next.method);
  archive("growth", next.growth);
  archive("lungs", next.lungs);
  archive("breathe", next.breathe);
}

}  // namespace pneuma
