// What an accuracy study found out about settings, kept for the studies that use them: what the reference
// meshes tend to, the launch that was computed, and whether it says something of another one.
#pragma once

#include "launchsafe/math/statistics.hpp"
#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::study {

/// Values of the reference meshes, finest first, and what they tend to.
struct ReferenceValue {
  std::vector<double> values;  ///< none where a mesh has none
  math::Extrapolation limit;
  /// In the unit of the values: by how much the limit itself may be off, as the meshes share numerics that
  /// are not exact (see `inexactness_of`); NaN where nothing tells.
  double inexactness = 0;
};

/// Of values on cells of the given sizes (m), finest first; of no values where one is not finite.
ReferenceValue reference_value(std::vector<double> values, const std::vector<double>& sizes);
/// `value` minus the limit; NaN where there is none.
double error_against(const ReferenceValue& reference, double value);
/// The larger of two; NaN, which is no bound, wins.
double larger_bound(double a, double b);

/// What numerical errors depend on besides shell and setting, and the scene's own numbers. Every run of an
/// accuracy study that its record keeps has the same launch, so these are values and no ranges.
struct RecordedLaunch {
  double peak_pressure = 0;   ///< Pa, largest over the duration
  double duration = 0;        ///< s
  std::vector<double> shape;  ///< pressure over its peak at `shape_instants` even instants of the duration
  double rise_time = 0;       ///< s, > 0: the peak over the largest rate of rise, at most the duration
  /// K/(s m), per metre of gap: the rate at which air compressed by the peak pressure heats the cold skin.
  double air_heating = 0;
};

/// Instants at which the shape of a load is recorded, the first at 0, the last at the end.
inline constexpr std::size_t shape_instants = 65;

RecordedLaunch launch_of(const scene::Scene& scene);

/// What a record of one launch says of another.
struct Coverage {
  std::string reason;  ///< why it says nothing, a clause; empty where it holds
  /// >= 1, by which the errors of the record grow. An extrapolation never makes them smaller.
  double growth = 1.0;
  /// m, up to which it holds: the air of no wider gap heats the skin three times as fast as that of the
  /// widest recorded one. Judged gap by gap, so that a verdict does not depend on what else a study lists.
  double largest_gap = 0;
};

/// Whether an input belongs to a setting: it makes a computation finer or coarser, and nothing else.
bool belongs_to_setting(const scene::KeyDescription& key);
/// The scene keys of a setting with their values.
using Setting = std::map<std::string, scene::Value>;
Setting setting_of(const scene::Scene& scene);
/// Equal but for the round-off of units.
bool same_setting(const Setting& a, const Setting& b);

/// One setting that ran soundly: its outcome, how good it thus is, and what it costs.
struct RecordedSetting {
  std::string label;
  Setting setting;
  bool reference = false;                    ///< one of the reference meshes
  double cell = 0;                           ///< m, sqrt(dx dr) of the fitted grid
  std::vector<double> temperature;           ///< K, T max for every gap of the launch, as compared
  double critical_gap = math::not_a_number;  ///< m; NaN where there is none
  double processor_time = 0;                 ///< s

  // found by `find_bounds`
  /// K, of T max, the largest over the gaps; NaN where it is not known.
  double temperature_bound = math::not_a_number;
  /// m, likewise; NaN also where there is no critical gap.
  double critical_gap_bound = math::not_a_number;
};

/// A recorded accuracy study: its launch, and what every sound setting gave. All bounds follow from that.
struct AccuracyRecord {
  std::string title;                      ///< of the accuracy study
  scene::Scene scene;                     ///< with the gaps at which T max was compared
  std::vector<RecordedSetting> settings;  ///< the reference meshes first, finest first

  // found by `find_bounds`
  RecordedLaunch launch;  ///< of the scene
  /// Keys at which the reference meshes are not exact and of which no setting tells what that changes: no
  /// error of this record is known.
  std::vector<std::string> unvaried;
  double rise = 0;  ///< K, of T max above the initial temperature, for which the bounds were found
};

/// Those that a study names: of a scene the first counts that is of its shell and model.
using AccuracyRecords = std::vector<AccuracyRecord>;

/// Finds launch, bounds, rise and unvaried keys of a record from what its settings gave. A setting is
/// compared with the limit of the reference meshes, which differ in the cell size alone and share all other
/// keys with the scene of the accuracy study. So the comparison tells the error of whatever the setting has
/// otherwise than the meshes: its cell, a scaling of 16 beside their 1. It tells nothing of what the meshes
/// themselves have wrong (see keys::Exactness). Where they have a key at another value than the exact one,
/// the limit is off by what that changes, and so is every bound. That is known where two settings differ in
/// this key alone, one having the meshes' value and one the exact one, or a finer one where none is exact: it
/// counts as three times the largest such difference, as for any limit that two values point to (see
/// math::Extrapolation). Otherwise the key is unvaried and no bound is known. Needs at least three reference
/// meshes, each setting with as many temperatures as there are gaps.
void find_bounds(AccuracyRecord& record);

/// The reference of a record, which its meshes tend to.
struct RecordedReference {
  std::vector<ReferenceValue> temperature;  ///< K, for every gap
  ReferenceValue critical_gap;              ///< m; without values where a mesh has none
};
RecordedReference reference_of(const AccuracyRecord& record);
/// Finds the bounds of one setting, also of one that is not in the record.
void find_bounds(const RecordedReference& reference, RecordedSetting& setting);

/// K; skins of explosives stay below. A setting that gives more is not recorded.
inline constexpr double highest_recorded_temperature = 5000.0;

/// A record as text.
std::string to_json_text(const AccuracyRecord& record);
/// A record from text; `file` is named in errors. Refused are a record of another model version, missing
/// keys, values of another type or beyond any launch, and settings that no scene may have.
scene::Expected<AccuracyRecord> parse_accuracy_record(const std::string& text, const std::string& file);

/// Why a record says nothing of a scene, whatever its setting and launch; empty where it may. At another
/// initial temperature, say, the shell is the same.
std::string why_foreign(const AccuracyRecord& record, const scene::Scene& scene);
/// How far a record is carried to a scene. Errors are those of the friction heat, which goes with p^2 and
/// with the localisation, and of the pressure that heats the air. Below the recorded launch they keep their
/// size, in kelvin. Above it they grow with p^2, with the root of the crack radius (as does the stress
/// intensity that drives crack growth) and with the localisation; what a wider gap adds is left to the rise
/// of T max (see StudyCase::rise_of_uncertainty). A record says nothing beyond 1.25 times the peak pressure,
/// as the recorded wall may just not have yielded; beyond three times the crack radius, in metres or in flaw
/// sizes, the localisation, or the rate at which the air of the widest gap heats the skin; and of a load that
/// lasts longer, rises faster or differs in shape by more than what accuracy_record.cpp allows.
///
/// Another initial temperature moves T max rigidly, as the heat of friction does not depend on it and air
/// heats by its density times its rise, which does not either. The mechanics knows it by the steel alone,
/// which yields at the same stress below room temperature and at 3 % less at 345 K: the rise of the 155 mm
/// shell without a gap is 116.3 K from 219 to 344 K, to 0.1 K. So errors keep their size on a colder launch,
/// and on a hotter one grow with the square of the ratio of the absolute temperatures (1.32 at 345 K for a
/// record of 300 K), which is more than they can. A record says nothing of a launch that is hotter by more
/// than a fifth.
Coverage coverage_of(const AccuracyRecord& record, const scene::Scene& scene);
/// The recorded setting of a scene, or nullptr.
const RecordedSetting* recorded_setting(const AccuracyRecord& record, const scene::Scene& scene);
/// The cheapest setting whose T max is known to `tolerance` (K), or nullptr.
const RecordedSetting* cheapest_within(const AccuracyRecord& record, double tolerance);
/// The setting with the smallest bound, or nullptr where none has one.
const RecordedSetting* most_accurate(const AccuracyRecord& record);

}  // namespace launchsafe::study
