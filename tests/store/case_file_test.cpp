#include "launchsafe/store/case_file.hpp"

#include "child_process.hpp"
#include "launchsafe/run/cost.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/store/file.hpp"
#include "same_case.hpp"
#include "store_fixture.hpp"

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
  void write_sample() const { write_case_file(path(), sample_stored()); }
};

TEST_F(CaseFile, ReadsBackEveryBit) {
  const StoredCase sample = sample_stored();
  write_case_file(path(), sample);
  const StoredCase stored = read_case_file(path());
  EXPECT_EQ(stored.manifest, sample.manifest);
  expect_same(sample.result, stored.result);
  write_case_file(folder() / "empty.h5", {make_manifest(""), {}});
  EXPECT_TRUE(read_case_file(folder() / "empty.h5").result.gaps.empty());
}

TEST_F(CaseFile, ASnapshotWithoutTheCellsOfItsParticlesIsAnErrorAndLeavesNothing) {
  run::CaseResult result = sample_case();
  result.mechanics.snapshots[0].half_length_r.clear();
  EXPECT_EQ(kind_of([&] { write_case_file(path(), sample_stored(result)); }), Error::Kind::failed);
  EXPECT_EQ(listing(), std::vector<std::string>{});
}

TEST_F(CaseFile, ATruncatedOrDamagedFileIsAnError) {
  write_sample();
  const std::string whole = read_file(path());
  std::vector<std::string> damaged;
  for (const std::size_t length : {std::size_t{0}, std::size_t{20}, std::size_t{600}, whole.size() - 1})
    damaged.push_back(whole.substr(0, length));
  for (const std::size_t place : {std::size_t{30}, std::size_t{700}, whole.size() / 2}) {
    damaged.push_back(whole);
    damaged.back()[place] ^= 0x10;
  }
  for (const std::string& bytes : damaged) {
    std::ofstream(path(), std::ios::binary) << bytes;
    EXPECT_EQ(kind_of([&] { read_case_file(path()); }), Error::Kind::corrupt);
  }
  std::filesystem::remove(path());
  EXPECT_EQ(kind_of([&] { read_case_file(path()); }), Error::Kind::missing);
}

TEST_F(CaseFile, OverwritesNothing) {
  for (const char* name : {"case.h5", "case.xdmf"}) {
    std::ofstream(folder() / name) << "mine";
    EXPECT_EQ(kind_of([&] { write_sample(); }), Error::Kind::conflict);
    EXPECT_EQ(read_file(folder() / name), "mine");
    std::filesystem::remove(path());
  }
}

TEST_F(CaseFile, AFolderThatMayNotBeWrittenIsAnError) {
  std::filesystem::permissions(folder(), std::filesystem::perms(0555));
  EXPECT_TRUE(holds_without_privileges(
      [&] { return kind_of([&] { write_sample(); }) == Error::Kind::write_failed; }));
  std::filesystem::permissions(folder(), std::filesystem::perms::owner_all);
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
  if (H5Aexists_by_name(root, name, "units", H5P_DEFAULT) <= 0) visit.without_units.emplace_back(name);
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
  for (const run::CaseResult& sample : {sample_with_flame(), sample_with_events()}) {
    write_case_file(path(), sample_stored(sample));
    expect_same(sample, read_case_file(path()).result);
    std::filesystem::remove(path());
    std::filesystem::remove(sidecar_of(path()));
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
  scene::Scene scene = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").scene;
  scene.numerics.cell_size = 10e-3;
  scene.load.duration = 1e-4;
  scene.interfaces.clear();
  scene.output.snapshot_times = {0.0, 1e-4};
  write_case_file(path(), sample_stored(run::run_case(scene)));
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
  for (const char* name : {"burnt_share", "skins", "faces"})
    EXPECT_FALSE(H5Lexists(file, (std::string("/snapshots/0000/") + name).c_str(), H5P_DEFAULT) > 0) << name;
  H5Fclose(file);
}

TEST_F(CaseFile, ParaviewFindsTheDataOfEverySnapshot) {
  write_case_file(path(), sample_stored(sample_with_events()));
  const std::string description = read_file(folder() / "case.xdmf");
  for (const char* part :
       {"<Grid Name=\"particles: peak-pressure, ignition\"", "<Grid Name=\"launch, burning, gap 0.04 cm\"",
        "<Time Value=\"0.002\"/>", ">case.h5:/snapshots/0001/corners<"})
    EXPECT_NE(description.find(part), std::string::npos) << part;
  EXPECT_EQ(description.find(folder().string()), std::string::npos) << "the folder can be moved";
  const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const std::regex pattern(R"re(Dimensions="(\d+)[ 2]*">case\.h5:([^<]+)</DataItem>)re");
  int named = 0;
  for (std::sregex_iterator match(description.begin(), description.end(), pattern), end; match != end;
       ++match) {
    const hid_t set = H5Dopen2(file, (*match)[2].str().c_str(), H5P_DEFAULT), space = H5Dget_space(set);
    hsize_t extent[2] = {};
    H5Sget_simple_extent_dims(space, extent, nullptr);
    EXPECT_EQ(std::to_string(extent[0]), (*match)[1]) << (*match)[2];
    H5Sclose(space);
    H5Dclose(set);
    ++named;
  }
  H5Fclose(file);
  EXPECT_EQ(named, 3 * 16);
}

TEST_F(CaseFile, ParaviewSeesEveryParticleAsACellWithValuesOnIt) {
  write_case_file(path(), sample_stored(sample_with_flame()));
  const std::string description = read_file(folder() / "case.xdmf");
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

TEST_F(CaseFile, WithoutSnapshotsThereIsNoDescription) {
  run::CaseResult result = sample_case();
  result.mechanics.snapshots.clear();
  write_case_file(path(), sample_stored(result));
  EXPECT_EQ(listing(), std::vector<std::string>{"case.h5"});
}

}  // namespace
}  // namespace launchsafe::store
