#include "launchsafe/store/case_file.hpp"

#include "child_process.hpp"
#include "launchsafe/run/cost.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/store/file.hpp"
#include "same_case.hpp"
#include "sample_case.hpp"
#include "temporary_folder.hpp"

#include <hdf5.h>

#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;

class CaseFile : public TemporaryFolder {
 protected:
  std::filesystem::path path() const { return folder() / "case.h5"; }

  void write_sample() {
    const MaybeError error = write_case_file(path(), sample_scene(), sample_case(), sample_manifest());
    ASSERT_FALSE(error) << error->message;
  }

  void overwrite(std::string_view bytes) { std::ofstream(path(), std::ios::binary) << bytes; }
};

TEST_F(CaseFile, ReadsBackEveryBit) {
  write_sample();
  const Result<StoredCase> stored = read_case_file(path());
  ASSERT_TRUE(stored) << stored.error().message;
  EXPECT_EQ(stored->title, "155 mm shell");
  expect_same(sample_case(), stored->result);
}

TEST_F(CaseFile, KeepsTheManifest) {
  const Manifest manifest = sample_manifest();
  ASSERT_FALSE(write_case_file(path(), sample_scene(), sample_case(), manifest));
  const Result<Manifest> stored = read_manifest(path());
  ASSERT_TRUE(stored) << stored.error().message;
  EXPECT_EQ(*stored, manifest);
  EXPECT_EQ(stored->wall_time, 62.25);
}

TEST_F(CaseFile, AnEmptyResultIsKeptToo) {
  ASSERT_FALSE(write_case_file(path(), {}, {}, sample_manifest()));
  const Result<StoredCase> stored = read_case_file(path());
  ASSERT_TRUE(stored) << stored.error().message;
  EXPECT_EQ(stored->result.mechanics.trace.samples(), 0U);
  EXPECT_TRUE(stored->result.gaps.empty());
}

TEST_F(CaseFile, ASnapshotWithoutTheCellsOfItsParticlesIsAnErrorAndLeavesNothing) {
  run::CaseResult result = sample_case();
  result.mechanics.snapshots[0].half_length_r.clear();
  const MaybeError error = write_case_file(path(), sample_scene(), result, sample_manifest());
  ASSERT_TRUE(error);
  EXPECT_NE(error->message.find("half_length_r"), std::string::npos) << error->message;
  EXPECT_EQ(listing(), std::vector<std::string>{});
}

TEST_F(CaseFile, ATruncatedOrDamagedFileIsAnError) {
  write_sample();
  const std::string whole = *read_file(path());
  std::vector<std::string> damaged;
  for (const std::size_t length : {std::size_t{0}, std::size_t{20}, std::size_t{600}, whole.size() - 1})
    damaged.push_back(whole.substr(0, length));
  for (const std::size_t place : {std::size_t{30}, std::size_t{700}, whole.size() / 2}) {
    damaged.push_back(whole);
    damaged.back()[place] ^= 0x10;
  }
  for (const std::string& bytes : damaged) {
    overwrite(bytes);
    const Result<StoredCase> stored = read_case_file(path());
    ASSERT_FALSE(stored);
    EXPECT_EQ(stored.error().kind, Error::Kind::corrupt);
    EXPECT_NE(stored.error().message.find(path().string()), std::string::npos) << stored.error().message;
  }
}

TEST_F(CaseFile, WhatIsNoCaseFileIsAnErrorAndStays) {
  overwrite("somebody's notes");
  const MaybeError error = write_case_file(path(), sample_scene(), sample_case(), sample_manifest());
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, Error::Kind::conflict);
  EXPECT_EQ(*read_file(path()), "somebody's notes");
}

TEST_F(CaseFile, AMissingFileIsToldFromADamagedOne) {
  const Result<StoredCase> stored = read_case_file(path());
  ASSERT_FALSE(stored);
  EXPECT_EQ(stored.error().kind, Error::Kind::missing);
}

TEST_F(CaseFile, NeverReplacesTheResultOfAnotherInput) {
  write_sample();
  const std::string before = *read_file(path());
  const MaybeError error = write_case_file(path(), sample_scene(), sample_case(), sample_manifest("other"));
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, Error::Kind::conflict);
  EXPECT_EQ(*read_file(path()), before);
}

TEST_F(CaseFile, ReplacesTheResultOfTheSameInput) {
  write_sample();
  run::CaseResult result = sample_case();
  result.mechanics.wall_time = 1234;
  ASSERT_FALSE(write_case_file(path(), sample_scene(), result, sample_manifest()));
  EXPECT_EQ(read_case_file(path())->result.mechanics.wall_time, 1234);
}

TEST_F(CaseFile, AFolderThatMayNotBeWrittenIsAnError) {
  using std::filesystem::perms;
  std::filesystem::permissions(
      folder(), perms::owner_read | perms::owner_exec | perms::others_read | perms::others_exec);
  EXPECT_TRUE(holds_without_privileges([&] {
    const MaybeError error = write_case_file(path(), sample_scene(), sample_case(), sample_manifest());
    return error && error->kind == Error::Kind::write_failed;
  }));
  std::filesystem::permissions(folder(), perms::owner_all);
  EXPECT_EQ(listing(), std::vector<std::string>{});
}

// --- what other programs see ---

struct Visit {
  int datasets = 0;
  std::vector<std::string> without_units;
};

herr_t look_at(hid_t root, const char* name, const H5O_info_t* info, void* data) {
  auto& visit = *static_cast<Visit*>(data);
  if (info->type != H5O_TYPE_DATASET) return 0;
  ++visit.datasets;
  const auto has = [&](const char* attribute) {
    return H5Aexists_by_name(root, name, attribute, H5P_DEFAULT) > 0;
  };
  if (!has("units") || !has("description")) visit.without_units.emplace_back(name);
  return 0;
}

TEST_F(CaseFile, IsAnHdf5FileWithUnitsOnEveryDataset) {
  write_sample();
  const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  Visit visit;
  EXPECT_GE(H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, look_at, &visit, H5O_INFO_BASIC), 0);
  H5Fclose(file);
  EXPECT_GT(visit.datasets, 80);
  EXPECT_EQ(visit.without_units, std::vector<std::string>{});
}

TEST_F(CaseFile, SnapshotsComeWithADescriptionForParaview) {
  write_sample();
  const Result<std::string> description = read_file(folder() / "case.xdmf");
  ASSERT_TRUE(description);
  EXPECT_NE(description->find("<Time Value=\"0.002\"/>"), std::string::npos);
  EXPECT_NE(description->find(">case.h5:/snapshots/0001/corners<"), std::string::npos);
  EXPECT_EQ(description->find("crack_radius"), std::string::npos) << "the sample has none";
  EXPECT_EQ(description->find(folder().string()), std::string::npos) << "the folder can be moved";
}

run::CaseResult sample_with_flame() {
  run::CaseResult result = sample_case();
  result.mechanics.snapshots = {sample_snapshot_of_flame(0.001), sample_snapshot_of_flame(0.002)};
  return result;
}

/// With a gap that burns.
run::CaseResult sample_with_events() {
  run::CaseResult result = sample_case();
  result.mechanics.snapshots = {sample_snapshot_of_events(0.001), sample_snapshot_of_events(0.002)};
  result.gaps[1].combustion.emplace().snapshots = {sample_snapshot_of_events(0.0177)};
  return result;
}

TEST_F(CaseFile, KeepsEventsBottomsFacesAndWhatBurns) {
  const std::pair<const char*, run::CaseResult> samples[] = {{"flame.h5", sample_with_flame()},
                                                             {"events.h5", sample_with_events()}};
  for (const auto& [name, sample] : samples) {
    ASSERT_FALSE(write_case_file(folder() / name, sample_scene(), sample, sample_manifest()));
    const Result<StoredCase> stored = read_case_file(folder() / name);
    ASSERT_TRUE(stored) << stored.error().message;
    expect_same(sample, stored->result);
  }
}

/// Bytes of all datasets below a group, before compression.
double bytes_below(hid_t file, const std::string& group) {
  double bytes = 0;
  const auto add = [](hid_t at, const char* name, const H5O_info_t* info, void* sum) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    const hid_t set = H5Dopen2(at, name, H5P_DEFAULT), space = H5Dget_space(set), type = H5Dget_type(set);
    *static_cast<double*>(sum) +=
        static_cast<double>(H5Tget_size(type)) * static_cast<double>(H5Sget_simple_extent_npoints(space));
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(set);
    return 0;
  };
  const hid_t at = H5Gopen2(file, group.c_str(), H5P_DEFAULT);
  H5Ovisit2(at, H5_INDEX_NAME, H5_ITER_NATIVE, add, &bytes, H5O_INFO_BASIC);
  H5Gclose(at);
  return bytes;
}

// What is foreseen of a snapshot is what its file holds; the time and the like are some bytes more.
TEST_F(CaseFile, SnapshotsTakeAsManyBytesAsForeseen) {
  scene::Scene scene = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
  scene.numerics.cell_size = 10e-3;
  scene.load.duration = 1e-4;
  scene.interfaces.clear();
  scene.output.snapshot_times = {0.0, 1e-4};
  ASSERT_FALSE(write_case_file(path(), scene, run::run_case(scene), sample_manifest()));
  const run::SnapshotSize size = run::snapshot_size(scene);
  EXPECT_EQ(size.of_launch, 2U);
  EXPECT_EQ(size.of_combustion, 0U);
  const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const double bytes = bytes_below(file, "/snapshots/0001");
  H5Fclose(file);
  EXPECT_GE(bytes, size.bytes_each);
  EXPECT_LT(bytes - size.bytes_each, 100.0);
}

TEST_F(CaseFile, OfWhatSnapshotsDoNotKnowNothingIsStored) {
  write_sample();
  const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  for (const char* name : {"burnt_share", "bottom", "faces"})
    EXPECT_FALSE(H5Lexists(file, (std::string("/snapshots/0000/") + name).c_str(), H5P_DEFAULT) > 0) << name;
  H5Fclose(file);
}

/// A dataset that a description for ParaView names.
struct NamedData {
  std::string address;          ///< in the case file
  std::vector<hsize_t> extent;  ///< as the description says
};

std::vector<NamedData> data_named_in(const std::string& description) {
  const std::regex pattern(R"re(<DataItem [^>]*Dimensions="([\d ]+)">case\.h5:([^<]+)</DataItem>)re");
  std::vector<NamedData> all;
  for (auto match = std::sregex_iterator(description.begin(), description.end(), pattern);
       match != std::sregex_iterator(); ++match) {
    NamedData data{(*match)[2], {}};
    std::istringstream numbers((*match)[1]);
    for (hsize_t number = 0; numbers >> number;) data.extent.push_back(number);
    all.push_back(data);
  }
  return all;
}

std::vector<hsize_t> extent_in(hid_t file, const std::string& address) {
  const hid_t set = H5Dopen2(file, address.c_str(), H5P_DEFAULT);
  if (set < 0) return {};
  const hid_t space = H5Dget_space(set);
  std::vector<hsize_t> extent(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  H5Sclose(space);
  H5Dclose(set);
  return extent;
}

TEST_F(CaseFile, ParaviewSeesEventsBottomsFacesAndWhatBurns) {
  ASSERT_FALSE(write_case_file(path(), sample_scene(), sample_with_events(), sample_manifest()));
  const std::string description = *read_file(folder() / "case.xdmf");
  for (const char* part :
       {"<Grid Name=\"particles: peak-pressure, ignition\"", "Value=\"peak-pressure, ignition\"",
        "<Grid Name=\"bottom of the charge\"", "<Grid Name=\"face 1 towards wall\"",
        "<Grid Name=\"launch, burning, gap 0.04 cm\"", "Name=\"skin temperature, gap 0.04 cm\"",
        "Name=\"contact_pressure\" AttributeType=\"Scalar\" Center=\"Node\"",
        "NodesPerElement=\"2\" NumberOfElements=\"2\""})
    EXPECT_NE(description.find(part), std::string::npos) << part;
  const std::vector<NamedData> named = data_named_in(description);
  // In three snapshots those of the particles, four of the bottom, and six of the face.
  EXPECT_EQ(named.size(), 3U * (16U + 4U + 6U));
  const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  for (const NamedData& data : named) EXPECT_EQ(extent_in(file, data.address), data.extent) << data.address;
  H5Fclose(file);
}

TEST_F(CaseFile, ParaviewSeesEveryParticleAsACellWithValuesOnIt) {
  ASSERT_FALSE(write_case_file(path(), sample_scene(), sample_with_flame(), sample_manifest()));
  const std::string description = *read_file(folder() / "case.xdmf");
  for (const char* part :
       {"CollectionType=\"Temporal\"", "TopologyType=\"Quadrilateral\" NumberOfElements=\"3\"",
        "<Attribute Name=\"body\" AttributeType=\"Scalar\" Center=\"Cell\">",
        "<Attribute Name=\"burnt_share\" AttributeType=\"Scalar\" Center=\"Cell\">"})
    EXPECT_NE(description.find(part), std::string::npos) << part;
  EXPECT_EQ(description.find("Center=\"Node\""), std::string::npos);
  const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = H5Dopen2(file, "/snapshots/0001/corners", H5P_DEFAULT);
  std::vector<double> corners(24);
  EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, corners.data()), 0);
  H5Dclose(set);
  H5Fclose(file);
  // Of the second particle, at (0.2, 0.02) with half lengths of 0.025 and 0.0025, against the clock's hands.
  const std::vector<double> expected{0.175, 0.0175, 0.225, 0.0175, 0.225, 0.0225, 0.175, 0.0225};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_DOUBLE_EQ(corners[8 + i], expected[i]) << i;
}

TEST_F(CaseFile, ComesWithItsSceneWhereTheInputIsOne) {
  const scene::Scene scene =
      scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
  ASSERT_FALSE(write_case_file(path(), scene, sample_case(), sample_manifest(scene::to_toml(scene))));
  const Result<CaseWithScene> read = read_case_with_scene(path());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(scene::to_toml(read->scene), scene::to_toml(scene));
  expect_same(sample_case(), read->stored.result);
}

TEST_F(CaseFile, WithoutASceneForAnInputItIsAnErrorToAskForOne) {
  write_sample();
  const Result<CaseWithScene> read = read_case_with_scene(path());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, Error::Kind::corrupt);
  EXPECT_NE(read.error().message.find("no scene to this program"), std::string::npos) << read.error().message;
}

TEST_F(CaseFile, WithoutSnapshotsThereIsNoDescription) {
  run::CaseResult result = sample_case();
  result.mechanics.snapshots.clear();
  ASSERT_FALSE(write_case_file(path(), sample_scene(), result, sample_manifest()));
  EXPECT_EQ(listing(), std::vector<std::string>{"case.h5"});
}

}  // namespace
}  // namespace launchsafe::store
